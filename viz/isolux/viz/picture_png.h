#pragma once

#include <filesystem>
#include <string>

#include "isolux/viz/tone_mapping.h"

/// Rendered views as PNG files: for the eye, and as false colours to read values from.
namespace isolux {

/// What a false-colour picture shows.
enum class PictureQuantity {
    luminance,  ///< cd/m2, towards the eye
    illuminance ///< lx on the visible surfaces, with isolux lines
};

/// As a camera with this exposure would see it: one pixel for each of the picture.
void write_tone_mapped(const std::filesystem::path& path,
                       const ViewPicture& picture,
                       const Exposure& exposure);

/// Bands of colour with their legend beside them. Surfaces without a value (illuminance of what
/// is a luminaire or nothing at all) are grey.
/// @param title  above the legend
void write_false_colours(const std::filesystem::path& path,
                         const ViewPicture& picture,
                         PictureQuantity quantity,
                         const std::string& title);

} // namespace isolux
