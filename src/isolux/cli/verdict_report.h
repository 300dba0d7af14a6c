#pragma once

#include <string>

#include "isolux/calc/results.h"

namespace isolux {

/// The overall verdict, the table of all of them with margins, failures first, and the rows of
/// the standards; empty where nothing was required.
[[nodiscard]] std::string to_verdict_table(const Results& results);

/// One line a group of observers: the worst rating, where and which way; empty without groups.
[[nodiscard]] std::string to_observer_table(const Results& results);

/// One line a room with a known power; empty where none is known.
[[nodiscard]] std::string to_energy_table(const Results& results);

} // namespace isolux
