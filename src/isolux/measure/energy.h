#pragma once

#include <optional>
#include <string>
#include <vector>

#include "isolux/base/estimate.h"

namespace isolux {

/// How a building is used, EN 15193-1. Factors are 1 where nothing saves energy.
struct EnergyUse {
    double day_hours = 2250.0;         ///< t_D, h/a
    double night_hours = 250.0;        ///< t_N, h/a
    double constant_illuminance = 1.0; ///< F_C
    double occupancy = 1.0;            ///< F_O
    double daylight = 1.0;             ///< F_D
    double parasitic = 0.0;            ///< W_P: standby and emergency charging, kWh/(m2 a)
};

/// Power of one room and what it costs.
struct EnergyResult {
    std::string room;
    double floor_area = 0.0;      ///< m2
    std::optional<double> watts;  ///< installed, all luminaires of the room at full power
    std::string reason;           ///< why there is no power
    double density = 0.0;         ///< LPD, W/m2
    std::string surface;          ///< whose mean illuminance the next one uses; may be empty
    Estimate density_per_100_lux; ///< W/(m2 100 lx)
    std::optional<double> leni;   ///< kWh/(m2 a)
};

/// LENI = P (F_C (t_D F_O F_D + t_N F_O))/(1000 A) + W_P, METHODS eq. (113), kWh/(m2 a).
[[nodiscard]] double
lighting_energy(double watts, double floor_area, const EnergyUse& use) noexcept;

} // namespace isolux
