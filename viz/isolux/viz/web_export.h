#pragma once

#include <filesystem>
#include <string>

#include "isolux/scene/scene.h"

namespace isolux {

/// Name of the file in a results folder, without extension.
inline constexpr const char* webs_stem = "photometric-webs";

/// The photometric solids of a scene's luminaire types as VTK XML poly data, each in its
/// luminaire's own frame (nadir -z, C0 +x): a point lies as many metres from the origin as its
/// intensity is of the type's largest.
///
/// Cell array `type` (int: number of the type in the scene); point array `intensity` (double,
/// cd, before dimming and maintenance).
[[nodiscard]] std::string to_webs_vtp(const Scene& scene);

/// Write under a temporary name beside `path`, then rename. @throws WriteError
void write_webs_vtp(const std::filesystem::path& path, const Scene& scene);

} // namespace isolux
