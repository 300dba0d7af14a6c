#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/calc/plan.h"
#include "isolux/calc/project.h"
#include "isolux/calc/results.h"

namespace isolux {

/// results.json: what was found, and everything needed to find it again.
struct ResultsDocument {
    std::string version; ///< of isolux; `isolux_version()` for a new document
    std::string project_name;
    InputFile project;
    std::vector<InputFile> inputs; ///< all other files, in the order of reading
    std::uint64_t seed = 1;
    double tolerance = 0.01;
    double confidence = 0.95; ///< as asked for; results.confidence is that of each interval
    Results results;
    std::string description{};             ///< of the project; may be empty
    double absolute_tolerance = 1e-4;      ///< lx, asked for
    std::string date{};                    ///< ISO 8601, UTC; empty where nobody said
    Plan plan{};                           ///< luminaires, rooms and objects; may be empty
    std::vector<ScheduleEntry> schedule{}; ///< luminaires by type
};

/// Version of this library, "0.1.0".
[[nodiscard]] std::string_view isolux_version() noexcept;

/// A document for the results of a project calculated with `settings` (the command line may
/// have changed the project's own). The project's notices come before those of the calculation;
/// its scene is not looked at and may be gone.
[[nodiscard]] ResultsDocument
make_results_document(const Project& project, const Settings& settings, Results results);

/// The document as JSON text, schema/results.schema.json. One point a line; numbers are the
/// shortest that read back exactly, so equal results are equal texts. Everything that differs
/// from run to run is in the last member, "time".
[[nodiscard]] std::string to_results_json(const ResultsDocument& document);

/// The document as written by to_results_json, without the replicate tables.
/// @throws InputError  `source:line:column: ...` for what is no JSON, `source#/pointer: ...`
/// for what are no results
[[nodiscard]] ResultsDocument parse_results_json(std::string_view text,
                                                 std::string_view source);

/// The same from a file. @throws InputError  also for a file that is missing or too large
[[nodiscard]] ResultsDocument read_results_json(const std::filesystem::path& path);

/// Writes `folder`/results.json, one CSV a surface, named by file_stems() of the surfaces'
/// names, and the contributions where the results have them (io/contributions_file.h); those of
/// an earlier run are removed. Makes the folder where it is missing. @throws WriteError
void write_results(const std::filesystem::path& folder, const ResultsDocument& document);

} // namespace isolux
