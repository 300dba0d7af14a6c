#include <cmath>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "isolux/calc/long_side.h"
#include "isolux/cli/calculation_options.h"
#include "isolux/cli/console.h"
#include "isolux/cli/verbs.h"

namespace isolux {

namespace {

std::string count(std::size_t n, const char* thing) {
    return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

/// Floor area of all rooms without their columns, m2.
double floor_area(const SceneDescription& scene) {
    double area = 0.0;
    for (const Room& room : scene.rooms) {
        area += std::abs(signed_area(room.footprint));
        for (const Column& column : room.columns)
            area -= std::abs(signed_area(column.outline));
    }
    return area;
}

std::string to_summary(const Project& project) {
    const SceneDescription& scene = project.scene;
    std::size_t points = 0;
    for (const CalculationSurface& s : project.surfaces)
        points += s.receivers.size();
    double flux = 0.0;
    for (const LuminairePlacement& p : scene.luminaires)
        flux += p.scale * in_lumen(luminous_flux(scene.luminaire_types[p.type.index()]));
    std::string text = fmt::format("{}: {}, {}, {}, {} with {}; {:.0f} lm",
                                   project.name,
                                   count(scene.rooms.size(), "room"),
                                   count(scene.objects.size(), "object"),
                                   count(scene.luminaires.size(), "luminaire"),
                                   count(project.surfaces.size(), "calculation surface"),
                                   count(points, "point"),
                                   flux);
    const double area = floor_area(scene);
    if (area > 0.0)
        text += fmt::format(" over {:.4g} m2 of floor, {:.4g} lm/m2", area, flux / area);
    return text + "\n";
}

ExitCode check_project(const std::string& argument) {
    const Project project = load_project(argument);
    std::string text = to_summary(project);
    for (const std::string& line :
         describe_luminaires(project.scene.luminaire_types, project.scene.luminaires))
        text += "luminaires: " + line + "\n";
    for (const CalculationSurface& s : project.surfaces) {
        text += fmt::format("surface: {}, {}", s.name, count(s.receivers.size(), "point"));
        if (s.grid)
            text += fmt::format(
                " in a grid of {} x {}", s.grid->counts.columns, s.grid->counts.rows);
        text += "\n";
    }
    for (const Message& notice : project.notices)
        text += "notice: " + to_string(notice) + "\n";
    text += project.notices.empty()
                ? "no errors, nothing odd\n"
                : fmt::format("no errors, {}\n", count(project.notices.size(), "notice"));
    print(text);
    return ExitCode::success;
}

} // namespace

Action add_check(CLI::App& verb) {
    verb.description("List everything wrong or odd in a project without calculating");
    verb.footer(R"(
Examples:
  isolux check projects/open-office
  isolux check office.json && isolux run office.json

Exit status: 0 it can be calculated (there may be notices); 2 it has errors.)");
    const auto project = std::make_shared<std::string>();
    verb.add_option("PROJECT", *project, "A project file, or a folder with project.json")
        ->required()
        ->type_name("");
    return [project] { return check_project(*project); };
}

} // namespace isolux
