#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "isolux/calc/selftest.h"

/// How the cases are put together.
namespace isolux {

/// Settings for known answers: the tolerance keeps standard errors well below 0.5 %, however
/// dark the point.
[[nodiscard]] Settings selftest_settings();

/// A single measurement point as a surface of its own, so that each one is brought to the
/// tolerance whatever the others are.
[[nodiscard]] CalculationSurface make_point_surface(std::string name, const Receiver& receiver);

enum class Part { total, direct, indirect };

/// Adds a point and what is known about it, lx.
void add_point(SelftestCase& selftest,
               std::string name,
               const Receiver& receiver,
               Part part,
               Lux reference,
               double allowance = 0.0);

/// Adds: the surfaces absorb what the luminaires emit, lm.
void add_flux_balance(SelftestCase& selftest, Lumen emitted);

} // namespace isolux
