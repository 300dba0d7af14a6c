#pragma once

#include <optional>
#include <vector>

#include "isolux/io/project_reader.h"

namespace isolux {

/// Reads the project's "observers". @pre rooms and surfaces have been read
void read_observers(const JsonNode& node, ProjectReader& reader);

/// Eyes in a grid over a room, off its edge zone and columns; what is wrong is told at `node`.
[[nodiscard]] std::vector<Point3> make_observer_grid(const JsonNode& node,
                                                     const Room& room,
                                                     double height,
                                                     double spacing,
                                                     std::optional<double> edge,
                                                     ProjectReader& reader);

/// The observers of a room for which the project names none: seated, 2 m apart, each looking
/// along +x, +y, -x and -y.
[[nodiscard]] ObserverGroup
make_room_observers(const JsonNode& node, const Room& room, ProjectReader& reader);

} // namespace isolux
