#pragma once

#include <string>

#include "isolux/calc/plan.h"
#include "isolux/io/results_node.h"

namespace isolux {

/// The member "installation" of results.json: luminaire types with their diagrams, luminaires
/// as they hang, outlines of rooms and objects. What a report needs besides the values.
[[nodiscard]] std::string to_installation_json(const Plan& plan);

/// What to_installation_json wrote. @throws InputError
[[nodiscard]] Plan parse_installation(const ResultsNode& node);

} // namespace isolux
