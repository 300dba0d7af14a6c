#include "isolux/calc/energy_of.h"

#include <algorithm>

namespace isolux {

std::vector<EnergyResult>
energy_of(const Project& project, const Scene& scene, const Results& results) {
    std::vector<EnergyResult> all;
    for (const EnergyZone& zone : project.energy_zones) {
        EnergyResult e;
        e.room = zone.room;
        e.floor_area = zone.floor_area;
        double watts = 0.0;
        for (const std::size_t l : zone.luminaires) {
            const ScheduleEntry& entry =
                project.schedule[scene.luminaires[l].placement.type.index()];
            if (!entry.watts && e.reason.empty())
                e.reason = "the power of luminaire type " + entry.type + " is not stated";
            watts += entry.watts.value_or(0.0);
        }
        if (zone.luminaires.empty())
            e.reason = "no luminaire hangs in it";
        if (e.reason.empty()) {
            e.watts = watts;
            e.density = watts / zone.floor_area;
            if (zone.work_surface && *zone.work_surface < results.surfaces.size()) {
                const SurfaceResult& s = results.surfaces[*zone.work_surface];
                const Estimate& em = s.summary.mean;
                e.surface = s.surface.name;
                if (em.mean > 0.0) // METHODS eq. (112)
                    e.density_per_100_lux = {100.0 * e.density / em.mean,
                                             100.0 * e.density * em.standard_error
                                                 / (em.mean * em.mean),
                                             em.samples};
            }
            if (project.energy_use)
                e.leni = lighting_energy(watts, zone.floor_area, *project.energy_use);
        }
        all.push_back(std::move(e));
    }
    return all;
}

} // namespace isolux
