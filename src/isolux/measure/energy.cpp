#include "isolux/measure/energy.h"

namespace isolux {

double lighting_energy(double watts, double floor_area, const EnergyUse& use) noexcept {
    const double hours =
        use.constant_illuminance
        * (use.day_hours * use.occupancy * use.daylight + use.night_hours * use.occupancy);
    return watts * hours / (1000.0 * floor_area) + use.parasitic; // METHODS eq. (113)
}

} // namespace isolux
