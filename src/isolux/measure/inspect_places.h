#pragma once

#include <span>
#include <vector>

#include "isolux/measure/camera.h"
#include "isolux/measure/glare.h"
#include "isolux/measure/surface_grid.h"
#include "isolux/scene/scene_space.h"

namespace isolux {

/// What is measured at places that no light reaches, in silence an illuminance of 0: points,
/// observers and cameras outside every room or inside closed objects, and surfaces in a wall,
/// floor or ceiling that face away from the room. One message for each surface and kind.
[[nodiscard]] std::vector<Message> inspect_places(const SceneDescription& description,
                                                  std::span<const CalculationSurface> surfaces,
                                                  std::span<const ObserverGroup> observers,
                                                  std::span<const View> views);

} // namespace isolux
