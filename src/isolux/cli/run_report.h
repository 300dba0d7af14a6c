#pragma once

#include <string>
#include <vector>

#include "isolux/calc/project.h"
#include "isolux/calc/results.h"

namespace isolux {

/// "512.3 +-2.1": the value and half the width of its interval, to two digits of the latter; a
/// value without doubt has four digits.
[[nodiscard]] std::string format_estimate(const Estimate& e, double confidence);

/// The table of all surfaces: points, Em, Emin, Emax, U0, Ud with their intervals. An asterisk
/// marks surfaces with flagged error bars.
[[nodiscard]] std::string to_summary_table(const Results& results);

/// What the asterisk at error bars says. Empty if there is nothing to tell.
[[nodiscard]] std::string to_statistics_notes(const Results& results);

/// "values are maintained ones: maintenance factor 0.8", or that they are initial ones.
[[nodiscard]] std::string to_maintenance_line(const std::vector<ScheduleEntry>& schedule);

/// One line a light scene: the mean illuminance of each surface and the verdict.
[[nodiscard]] std::string to_scene_lines(const Results& results);

/// Flux balance, time, rays and paths, one line each.
[[nodiscard]] std::string to_run_facts(const Results& results);

} // namespace isolux
