#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/calc/picture.h"

/// Pictures as OpenEXR files: linear light, 32-bit floats, many layers in one part, so that any
/// program that reads OpenEXR shows the picture and finds the rest by name.
///
/// | channels | what |
/// |---|---|
/// | `R G B` | the picture, filtered where a filter was used; cd/m2, Rec. 709 primaries |
/// | `luminance.Y` | its luminance, cd/m2 |
/// | `raw.R raw.G raw.B raw.Y` | unfiltered |
/// | `filtered.R ... filtered.Y` | filtered; only with a filter |
/// | `error.Y` | standard error of `raw.Y`; `error.filtered` root mean square error, filtered |
/// | `emission direct indirect` | `.R .G .B`; parts of `raw` |
/// | `albedo.R .G .B` | diffuse reflectance |
/// | `normal.X .Y .Z`, `position.X .Y .Z` | of the most frequent surface; m, world |
/// | `Z` | depth along the ray, m |
/// | `object.id` | number of the surface (unsigned), 0 for none; names in `objectNames` |
/// | `illuminance.E` | lx on that surface, as shown |
/// | `filter.width` | pixels |
/// | `samples.N` | rays through the pixel |
///
/// The attribute `whiteLuminance` is 1: RGB (1, 1, 1) is 1 cd/m2.
namespace isolux {

/// Writes a picture, under a temporary name first. @throws WriteError, DeviceError
void write_exr(const std::filesystem::path& path, const ViewPicture& picture);

struct ExrChannel {
    std::string name;
    Plane values; ///< row by row from the top left
};

/// All channels of the first part of a file, as floats.
struct ExrImage {
    PictureSize size;
    std::vector<ExrChannel> channels; ///< in the file's order: sorted by name

    [[nodiscard]] const Plane* find(std::string_view name) const noexcept;
};

/// @throws InputError  no such file, not OpenEXR, damaged, larger than 16384 pixels a side
[[nodiscard]] ExrImage read_exr(const std::filesystem::path& path);

} // namespace isolux
