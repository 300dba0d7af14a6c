#include <string>
#include <utility>
#include <vector>

#include "isolux/io/contributions_file.h"
#include "isolux/io/csv.h"
#include "isolux/io/file_name.h"
#include "isolux/io/results_json.h"
#include "isolux/io/safe_file.h"

namespace isolux {

std::string_view isolux_version() noexcept { return ISOLUX_VERSION; }

ResultsDocument
make_results_document(const Project& project, const Settings& settings, Results results) {
    results.notices.insert(
        results.notices.begin(), project.notices.begin(), project.notices.end());
    ResultsDocument document{std::string(isolux_version()),
                             project.name,
                             project.file,
                             project.inputs,
                             settings.seed,
                             settings.tolerance,
                             settings.confidence,
                             std::move(results)};
    document.description = project.description;
    document.absolute_tolerance = settings.absolute_tolerance;
    document.schedule = project.schedule;
    return document;
}

void write_results(const std::filesystem::path& folder, const ResultsDocument& document) {
    make_folder(folder);
    std::vector<std::string> names{"sensitivities"}; // a surface must not take its name
    for (const SurfaceResult& s : document.results.surfaces)
        names.push_back(s.surface.name);
    const std::vector<std::string> stems = file_stems(names);
    for (std::size_t i = 1; i < stems.size(); ++i)
        write_file_safely(
            folder / (stems[i] + ".csv"),
            to_csv(document.results.surfaces[i - 1], document.results.confidence));
    // Those of an earlier run would speak of other lights.
    remove_contributions(folder);
    remove_file(folder / sensitivities_table);
    if (document.results.contributions)
        write_contributions(folder, document.results);
    if (document.results.sensitivities)
        write_file_safely(folder / sensitivities_table, to_sensitivities_csv(document.results));
    write_file_safely(folder / "results.json", to_results_json(document));
}

} // namespace isolux
