#pragma once

#include <filesystem>
#include <vector>

#include "isolux/calc/plan.h"
#include "isolux/calc/results.h"
#include "isolux/viz/map_scale.h"

class vtkActor;
class vtkProp;
class vtkRenderer;

/// What the viewer's window shows. Every function adds things to a renderer, which owns them.
namespace isolux {

/// Things that are switched together.
using Props = std::vector<vtkProp*>;

/// Faces of the room that look at the eye, and its edges, from room.vtp.
/// @throws InputError  where the file is missing or no room
[[nodiscard]] Props add_room(vtkRenderer& renderer, const std::filesystem::path& room_vtp);

/// Bodies and arrows towards C0.
[[nodiscard]] Props add_luminaires(vtkRenderer& renderer, const Plan& plan);

/// Photometric solids, all to one scale: the brightest reaches `reach` metres.
/// @throws InputError  where the file of web_export.h is missing or something else
[[nodiscard]] Props add_webs(vtkRenderer& renderer,
                             const std::filesystem::path& webs_vtp,
                             const Plan& plan,
                             double reach);

/// One calculation surface in the colours of a scale, with its isolux lines; dots where it has
/// no grid. The colours go first.
struct SurfaceProps {
    vtkActor* colours = nullptr;
    vtkActor* lines = nullptr; ///< none without a grid
};

/// @param layer  surfaces that lie in one plane are told apart by it
[[nodiscard]] SurfaceProps add_surface(vtkRenderer& renderer,
                                       const SurfaceResult& result,
                                       const MapScale& scale,
                                       std::size_t layer);

/// Breaks and colours that all surfaces share, so that colours can be compared.
[[nodiscard]] MapScale make_common_scale(const Results& results);

/// The scale at the right rim: coloured boxes, breaks in lx between them.
[[nodiscard]] Props add_legend(vtkRenderer& renderer, const MapScale& scale);

} // namespace isolux
