#pragma once

#include <filesystem>
#include <string>

#include "isolux/calc/results.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// A calculation surface as VTK XML poly data (`.vtp`), text: one quad for every measured grid
/// cell, or one vertex for every single point. Lengths in m, world coordinates.
///
/// Cell arrays (double): `illuminance standard_error lower upper direct indirect`, lx, and
/// `normal`, the receiver's axis (3 components). Field arrays: `surface` (its name), `unit`
/// ("lx") and `confidence` (of lower and upper, two-sided).
///
/// Appended base64 data without compression: every bit of a double survives, any XML reader can
/// open the file.
/// @param confidence  two-sided, in (0, 1): of `lower` and `upper`
/// @pre  result.points.size() == result.surface.receivers.size()
[[nodiscard]] std::string to_surface_vtp(const SurfaceResult& result, double confidence);

/// The geometry as light meets it, as VTK XML poly data: all triangles of the scene, then the
/// facets of the luminaires' openings; a vertex for a point-like luminaire.
///
/// Cell arrays: `kind` (int: 0 surface, 1 luminaire), `material_id` (int, -1 for luminaires),
/// `material` and `surface` (strings; a luminaire gives its type and its own name),
/// `reflectance` (3 doubles, diffuse R G B, 0..1), `mirror_reflectance` and `transmittance`
/// (double; of a pane at normal incidence).
[[nodiscard]] std::string to_room_vtp(const Scene& scene);

/// Write under a temporary name beside `path`, then rename. @throws WriteError
void write_surface_vtp(const std::filesystem::path& path,
                       const SurfaceResult& result,
                       double confidence);
void write_room_vtp(const std::filesystem::path& path, const Scene& scene);

} // namespace isolux
