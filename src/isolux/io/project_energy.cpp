#include <cmath>

#include "isolux/io/project_reader.h"

namespace isolux {

namespace {

double floor_area(const Room& room) {
    double area = std::abs(signed_area(room.footprint));
    for (const Column& column : room.columns)
        area -= std::abs(signed_area(column.outline));
    return area;
}

/// The first horizontal surface of illuminance in the room that is off its floor and ceiling.
std::optional<std::size_t> work_surface(const Room& room, const Project& project) {
    constexpr double upright = 1.0 - 1e-9;
    constexpr double off = 0.05; // m
    for (std::size_t s = 0; s < project.surfaces.size(); ++s) {
        const CalculationSurface& surface = project.surfaces[s];
        const Receiver& r = surface.receivers.front();
        if (surface.kind == IlluminanceKind::planar && surface.grid && r.axis.z() >= upright
            && contains(room, r.point) && r.point.z > room.floor_level + off)
            return s;
    }
    return std::nullopt;
}

} // namespace

void read_energy(const JsonObject& project, ProjectReader& reader) {
    for (const Room& room : reader.project.scene.rooms) {
        EnergyZone zone{room.name, floor_area(room), {}, work_surface(room, reader.project)};
        const std::vector<LuminairePlacement>& luminaires = reader.project.scene.luminaires;
        for (std::size_t l = 0; l < luminaires.size(); ++l)
            if (contains(room, luminaires[l].world_from_luminaire.origin))
                zone.luminaires.push_back(l);
        reader.project.energy_zones.push_back(std::move(zone));
    }
    const std::optional<JsonNode> node = project.find("energy");
    if (!node)
        return;
    const JsonObject object(*node,
                            "energy",
                            {"day_hours",
                             "night_hours",
                             "constant_illuminance",
                             "occupancy",
                             "daylight",
                             "parasitic"});
    constexpr NumberRange any_hours{0.0, 8784.0, false, " h"};
    EnergyUse use;
    use.day_hours = object.number("day_hours", any_hours, use.day_hours);
    use.night_hours = object.number("night_hours", any_hours, use.night_hours);
    use.constant_illuminance =
        object.number("constant_illuminance", any_share, use.constant_illuminance);
    use.occupancy = object.number("occupancy", any_share, use.occupancy);
    use.daylight = object.number("daylight", any_share, use.daylight);
    use.parasitic = object.number("parasitic", {0.0, 1e4, false, " kWh/(m2 a)"}, use.parasitic);
    reader.project.energy_use = use;
}

} // namespace isolux
