#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/base/error.h"
#include "isolux/cli/console.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/text_table.h"
#include "isolux/cli/verbs.h"
#include "isolux/validate/integrating_sphere.h"
#include "isolux/validate/sobolev.h"

namespace isolux {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* sobolev_place = "isolux reference sobolev";

/// Beyond this many separations the values are below a billionth of those in the middle.
constexpr double farthest = 1000.0;

struct SobolevOptions {
    std::string rho1;
    std::string rho2;
    std::string h1;
    std::string separation = "1";
    std::string flux = "1000";
    std::string radii = "0,0.25,0.5,1,2,3,5";
    bool as_json = false;
};

struct SphereOptions {
    std::string radius = "1";
    std::string rho;
    std::string flux = "1000";
    std::string offset = "0";
    std::string angles = "0,30,60,90,120,150,180";
    bool as_json = false;
};

double read_number(const std::string& option, std::string_view text) {
    const double value = parse_finite_number(text);
    if (std::isnan(value))
        throw InputError(option, fmt::format("'{}' is not a number", text));
    return value;
}

double read_positive(const std::string& option, const std::string& text, const char* unit) {
    const double value = read_number(option, text);
    if (value <= 0.0)
        throw InputError(option, fmt::format("{} {} is not above zero", text, unit));
    return value;
}

double read_reflectance(const std::string& option, const std::string& text, bool below_one) {
    const double value = read_number(option, text);
    if (value < 0.0 || value > 1.0)
        throw InputError(option,
                         fmt::format("{} is not a reflectance (0 to 1)", text),
                         value > 1.0 && value <= 100.0
                             ? fmt::format("Did you mean {:.6g}?", value / 100.0)
                             : "");
    if (below_one && value == 1.0)
        throw InputError(
            option, "1 leaves no absorption (the light never ends)", "Give less than 1");
    return value;
}

std::vector<double> read_list(const std::string& option, std::string_view text) {
    std::vector<double> values;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        values.push_back(read_number(option, text.substr(begin, end - begin)));
        begin = end + 1;
    }
    return values;
}

std::string six(double value) { return fmt::format("{:.6g}", value); }

std::string nine(double value) { return fmt::format("{:#.9g}", value); }

SobolevProblem read_problem(const SobolevOptions& o) {
    const SobolevProblem p{read_reflectance("--rho1", o.rho1, false),
                           read_reflectance("--rho2", o.rho2, false),
                           Metre(read_positive("--separation", o.separation, "m")),
                           Metre(read_positive("--h1", o.h1, "m")),
                           Lumen(read_positive("--flux", o.flux, "lm"))};
    if (p.source_height >= p.separation)
        throw InputError("--h1",
                         fmt::format("{} m is not between the planes (they are {} m apart)",
                                     o.h1,
                                     six(in_metre(p.separation))),
                         "Lower it, or give --separation");
    if (p.reflectance_1 * p.reflectance_2 == 1.0)
        throw InputError(sobolev_place,
                         "both planes reflect everything (the light never ends)",
                         "Lower --rho1 or --rho2");
    return p;
}

std::vector<double> read_radii(const SobolevOptions& o, const SobolevProblem& p) {
    const std::vector<double> radii = read_list("--r", o.radii);
    for (const double r : radii) {
        if (r < 0.0)
            throw InputError("--r", fmt::format("{} m is below zero", six(r)));
        if (r > farthest * in_metre(p.separation))
            throw InputError("--r",
                             fmt::format("{} m is too far (more than {} separations)",
                                         six(r),
                                         six(farthest)));
    }
    return radii;
}

ExitCode print_sobolev(const SobolevOptions& o) {
    const SobolevProblem p = read_problem(o);
    const std::vector<double> radii = read_radii(o, p);
    TextTable table({{"r/m", Align::right},
                     {"E1/lx", Align::right},
                     {"direct", Align::right},
                     {"E2/lx", Align::right},
                     {"direct", Align::right}});
    Json points = Json::array();
    for (const double r : radii) {
        const Metre at(r);
        const double direct1 = in_lux(sobolev_direct(p, SobolevPlane::one, at));
        const double direct2 = in_lux(sobolev_direct(p, SobolevPlane::two, at));
        const double e1 = direct1 + in_lux(sobolev_indirect(p, SobolevPlane::one, at));
        const double e2 = direct2 + in_lux(sobolev_indirect(p, SobolevPlane::two, at));
        table.add_row({six(r), nine(e1), nine(direct1), nine(e2), nine(direct2)});
        points.push_back({{"r_m", r},
                          {"E1_lx", e1},
                          {"E1_direct_lx", direct1},
                          {"E2_lx", e2},
                          {"E2_direct_lx", direct2}});
    }
    if (o.as_json) {
        const Json document{{"problem", "sobolev"},
                            {"rho1", p.reflectance_1},
                            {"rho2", p.reflectance_2},
                            {"h1_m", in_metre(p.source_height)},
                            {"separation_m", in_metre(p.separation)},
                            {"flux_lm", in_lumen(p.flux)},
                            {"points", std::move(points)}};
        print(document.dump(2) + "\n");
        return ExitCode::success;
    }
    print(fmt::format("Two infinite planes {} m apart, reflectances {} (1) and {} (2); {} lm, "
                      "isotropic, {} m from plane 1\n\n",
                      six(in_metre(p.separation)),
                      six(p.reflectance_1),
                      six(p.reflectance_2),
                      six(in_lumen(p.flux)),
                      six(in_metre(p.source_height))));
    print(table.text());
    return ExitCode::success;
}

ExitCode print_sphere(const SphereOptions& o) {
    const Metre radius(read_positive("--radius", o.radius, "m"));
    const double rho = read_reflectance("--rho", o.rho, true);
    const Lumen flux(read_positive("--flux", o.flux, "lm"));
    const Metre offset(read_number("--source-offset", o.offset));
    if (offset.value() < 0.0 || offset >= radius)
        throw InputError(
            "--source-offset",
            fmt::format("{} m is not inside the sphere (0 to {} m)", o.offset, o.radius));
    const std::vector<double> angles = read_list("--angles", o.angles);
    const double indirect = in_lux(sphere_indirect(radius, rho, flux));
    TextTable table(
        {{"angle/deg", Align::right}, {"E/lx", Align::right}, {"direct", Align::right}});
    Json points = Json::array();
    for (const double angle : angles) {
        const double direct = in_lux(sphere_direct(radius, flux, offset, degrees(angle)));
        table.add_row({six(angle), nine(direct + indirect), nine(direct)});
        points.push_back(
            {{"angle_deg", angle}, {"E_lx", direct + indirect}, {"E_direct_lx", direct}});
    }
    if (o.as_json) {
        const Json document{{"problem", "sphere"},
                            {"radius_m", in_metre(radius)},
                            {"rho", rho},
                            {"flux_lm", in_lumen(flux)},
                            {"source_offset_m", in_metre(offset)},
                            {"E_indirect_lx", indirect},
                            {"points", std::move(points)}};
        print(document.dump(2) + "\n");
        return ExitCode::success;
    }
    print(fmt::format("Sphere of radius {} m, reflectance {}; {} lm, isotropic, {} m from the "
                      "centre\nReflected light everywhere: {} lx\n\n",
                      six(in_metre(radius)),
                      six(rho),
                      six(in_lumen(flux)),
                      six(in_metre(offset)),
                      nine(indirect)));
    print(table.text());
    return ExitCode::success;
}

std::shared_ptr<SobolevOptions> add_sobolev(CLI::App& problem) {
    problem.description("Isotropic point source between two infinite diffuse planes");
    problem.footer(R"(
Examples:
  isolux reference sobolev --rho1 0.5 --rho2 0.5 --h1 0.5
  isolux reference sobolev --rho1 0.3 --rho2 0.6 --h1 0.8 --separation 2 --r 0,1,2,4 --json)");
    const auto o = std::make_shared<SobolevOptions>();
    problem.add_option("--rho1", o->rho1, "Reflectance of plane 1")->required();
    problem.add_option("--rho2", o->rho2, "Reflectance of plane 2")->required();
    problem.add_option("--h1", o->h1, "Distance of the source from plane 1, m")->required();
    problem.add_option("--separation", o->separation, "Distance of the planes, m")
        ->capture_default_str();
    problem.add_option("--flux", o->flux, "Flux of the source, lm")->capture_default_str();
    problem.add_option("--r", o->radii, "Distances from the foot of the source, m")
        ->capture_default_str();
    problem.add_flag("--json", o->as_json, "Print JSON with all digits");
    return o;
}

std::shared_ptr<SphereOptions> add_sphere(CLI::App& problem) {
    problem.description("Isotropic point source inside a diffuse sphere");
    problem.footer(R"(
Examples:
  isolux reference sphere --rho 0.8
  isolux reference sphere --radius 2 --rho 0.8 --flux 500 --source-offset 0.5 --angles 0,90,180)");
    const auto o = std::make_shared<SphereOptions>();
    problem.add_option("--radius", o->radius, "Radius of the sphere, m")->capture_default_str();
    problem.add_option("--rho", o->rho, "Reflectance of the wall")->required();
    problem.add_option("--flux", o->flux, "Flux of the source, lm")->capture_default_str();
    problem
        .add_option("--source-offset", o->offset, "Distance of the source from the centre, m")
        ->capture_default_str();
    problem
        .add_option(
            "--angles", o->angles, "Places on the wall: angles from the source's side, degrees")
        ->capture_default_str();
    problem.add_flag("--json", o->as_json, "Print JSON with all digits");
    return o;
}

} // namespace

Action add_reference(CLI::App& verb) {
    verb.description("Print the exact answer of a problem that has one");
    verb.formatter(std::make_shared<CLI::Formatter>()); // the program's own says VERB
    verb.get_formatter()->label("SUBCOMMAND", "PROBLEM");
    CLI::App* const sobolev = verb.add_subcommand("sobolev")->group("Problems");
    CLI::App* const sphere = verb.add_subcommand("sphere")->group("Problems");
    verb.require_subcommand(0, 1);
    const auto sobolev_options = add_sobolev(*sobolev);
    const auto sphere_options = add_sphere(*sphere);
    verb.footer(R"(
Examples:
  isolux reference sobolev --rho1 0.5 --rho2 0.5 --h1 0.5
  isolux reference sphere --rho 0.8 --source-offset 0.5
  isolux reference sobolev --help         options and examples of a problem)");
    return [=] {
        if (sobolev->parsed())
            return print_sobolev(*sobolev_options);
        if (sphere->parsed())
            return print_sphere(*sphere_options);
        throw InputError("isolux reference",
                         "no problem is named",
                         "Known are sobolev and sphere: `isolux reference --help`");
    };
}

} // namespace isolux
