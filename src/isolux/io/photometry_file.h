#pragma once

#include <filesystem>

#include "isolux/photometry/read_photometry.h"

namespace isolux {

/// Reads a luminaire file of any supported format. Files that it refers to (TILT=file) are
/// looked for in its own folder only.
/// @param options  `sibling` is replaced by that look into the folder
/// @throws InputError  no such file, too large, or not readable as photometry
[[nodiscard]] Parsed<LuminairePhotometry>
read_photometry(const std::filesystem::path& path, const PhotometryOptions& options = {});

} // namespace isolux
