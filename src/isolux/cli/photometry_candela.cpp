#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/cli/console.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/photometry_verbs.h"
#include "isolux/photometry/quantities.h"

namespace isolux {

namespace {

constexpr const char* place = "isolux photometry candela";

struct Options {
    std::string file;
    std::vector<std::string> angles;
    LuminaireFileOptions reading;
};

double read_angle(const std::string& text, const char* what) {
    const double value = parse_finite_number(text);
    if (std::isnan(value))
        throw InputError(place, fmt::format("'{}' is not a number (expected: {})", text, what));
    return value;
}

double read_gamma(const std::string& text) {
    const double gamma = read_angle(text, "gamma");
    if (gamma < 0.0 || gamma > 180.0)
        throw InputError(place,
                         fmt::format("gamma {} is not between 0 (down) and 180 (up)", text),
                         "Directions are given as C GAMMA");
    return gamma;
}

/// One line a direction: C, gamma and candela, as asked for.
ExitCode print_candela(const Options& o) {
    if (o.angles.size() % 2 != 0)
        throw InputError(place,
                         fmt::format("C {} has no gamma", o.angles.back()),
                         "Directions are given as C GAMMA [C GAMMA]...");
    const auto parsed = read_luminaire_file(o.file, o.reading);
    for (const Message& notice : parsed.notices)
        report_notice(notice);
    std::string text;
    for (std::size_t i = 0; i < o.angles.size(); i += 2) {
        const Angle c = degrees(read_angle(o.angles[i], "C"));
        const Angle gamma = degrees(read_gamma(o.angles[i + 1]));
        text += fmt::format("{} {} {:.10g}\n",
                            o.angles[i],
                            o.angles[i + 1],
                            intensity_towards(parsed.value, c, gamma).value());
    }
    print(text);
    return ExitCode::success;
}

} // namespace

Action add_photometry_candela(CLI::App& verb) {
    verb.description("Luminous intensity in directions of your choice");
    verb.footer(R"(
C is the azimuth from the luminaire's +x towards +y, GAMMA the angle from straight down; degrees,
the same frame for every format and photometric type. A line "C GAMMA candela" each.

Examples:
  isolux photometry candela desk.ldt 0 0
  isolux photometry candela street.ies 0 65 90 65 270 65)");
    const auto o = std::make_shared<Options>();
    verb.add_option("FILE", o->file, "A luminaire file")->required()->type_name("");
    verb.add_option("ANGLES", o->angles, "Pairs of C and gamma, degrees")
        ->required()
        ->type_name("");
    add_luminaire_file_options(verb, o->reading);
    return [o] { return print_candela(*o); };
}

} // namespace isolux
