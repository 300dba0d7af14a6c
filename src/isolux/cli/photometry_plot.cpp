#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/base/error.h"
#include "isolux/cli/console.h"
#include "isolux/cli/photometry_verbs.h"
#include "isolux/cli/suggest.h"
#include "isolux/viz/photometric_page.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

struct PlotOptions {
    std::string file;
    std::string output;
    std::string kind = "all";
    std::string unit = "cd";
    LuminaireFileOptions reading;
};

const std::array<std::string, 4> kinds{"all", "polar", "cartesian", "web"};
const std::array<std::string, 2> units{"cd", "cd/klm"};

/// Place of `word` among `known`. @throws InputError
std::size_t
choose(const char* option, const std::string& word, std::span<const std::string> known) {
    for (std::size_t k = 0; k < known.size(); ++k)
        if (known[k] == word)
            return k;
    const auto similar = find_similar(word, known);
    throw InputError(option,
                     fmt::format("'{}' is not known", word),
                     similar ? fmt::format("Did you mean {}?", *similar)
                             : fmt::format("Choose one of {}", fmt::join(known, ", ")));
}

PhotometricPageOptions to_page_options(const PlotOptions& o) {
    PhotometricPageOptions page;
    if (const std::size_t kind = choose("--kind", o.kind, kinds); kind > 0)
        page.kind = static_cast<DiagramKind>(kind - 1);
    page.unit = static_cast<IntensityUnit>(choose("--scale", o.unit, units));
    return page;
}

ExitCode plot(const PlotOptions& o) {
    const PhotometricPageOptions page = to_page_options(o);
    Parsed<LuminairePhotometry> parsed = read_luminaire_file(o.file, o.reading);
    LuminaireType type;
    type.name = fs::path(o.file).filename().string();
    type.file = o.file;
    type.opening = parsed.value.opening;
    type.source = std::move(parsed.value);
    const fs::path output = o.output.empty()
                                ? fs::path(o.file).filename().replace_extension(".svg")
                                : fs::path(o.output);
    write_drawing_file(output, draw_photometric_page(type, type.name, page));
    print(fmt::format("{}\n", output.string()));
    for (const Message& notice : parsed.notices)
        report_notice(notice);
    return ExitCode::success;
}

} // namespace

Action add_photometry_plot(CLI::App& verb) {
    verb.description("Draw a luminaire's light: polar, Cartesian, photometric solid");
    verb.footer(R"(
The plane C0-C180 is solid, C90-C270 dashed; gamma 0 points down. The solid shows the body with
its long axis and an arrow towards C0, as they lie before the luminaire is turned in a room:
LM-63 lays the length along C0-C180, EULUMDAT along C90-C270.

Examples:
  isolux photometry plot desk.ldt -o desk.svg
  isolux photometry plot desk.ies -o desk.pdf --scale cd/klm
  isolux photometry plot desk.ies -o polar.png --kind polar)");
    const auto options = std::make_shared<PlotOptions>();
    verb.add_option("FILE", options->file, "Luminaire file")->required();
    verb.add_option("-o,--output",
                    options->output,
                    "Picture: .svg, .png or .pdf (default the file's name with .svg)")
        ->type_name("PICTURE");
    verb.add_option("--kind", options->kind, "all, polar, cartesian or web")
        ->capture_default_str();
    verb.add_option("--scale",
                    options->unit,
                    "cd, or cd/klm: per 1000 lm of the lamps (of the luminaire where its "
                    "photometry is absolute)")
        ->capture_default_str();
    add_luminaire_file_options(verb, options->reading);
    return [options] { return plot(*options); };
}

} // namespace isolux
