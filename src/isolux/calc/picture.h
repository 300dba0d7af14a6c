#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "isolux/filter/pixel_buffers.h"

namespace isolux {

/// A rendered view. Luminances are cd/m2, colours linear with Rec. 709 primaries; planes as in
/// filter/pixel_buffers.h. Planes that were not asked for are empty.
struct ViewPicture {
    std::string view;
    PictureSize size;

    Planes3 raw;          ///< unfiltered: the mean of the samples
    Plane standard_error; ///< of the raw luminance Y, METHODS eq. (90)
    Planes3 filtered;     ///< empty without a filter
    Plane
        filtered_error; ///< root of the measured mean square error of `filtered`; may be empty
    Plane filter_width; ///< pixels, of the indirect light's filter; may be empty

    Planes3 emission; ///< part of raw: luminaires seen straight, through panes, in mirrors
    Planes3 direct;   ///< part of raw: light straight from luminaires, reflected once
    Planes3 indirect; ///< part of raw: light reflected before

    Planes3 albedo;                    ///< diffuse reflectance seen
    Planes3 normal;                    ///< of the most frequent surface, towards the eye
    Planes3 position;                  ///< m, world
    Plane depth;                       ///< m along the ray; 0 where nothing was hit
    std::vector<std::uint32_t> object; ///< 1 + number in object_names; 0: nothing
    std::vector<std::string> object_names;
    Plane illuminance; ///< lx on that surface, raw; 0 where nothing was hit
    Plane filtered_illuminance;
    Plane samples; ///< rays through the pixel

    std::string filter; ///< "axis-aligned", "oidn" or empty
    bool is_preview = false;
    bool interrupted = false;
    double error = 0.0; ///< of the raw picture: METHODS eq. (91)
    double wall_seconds = 0.0;
    double cpu_seconds = 0.0;        ///< of the whole process
    double filter_cpu_seconds = 0.0; ///< of these, for the filter
    std::size_t bytes_a_pixel = 0;   ///< held while rendering
    std::uint64_t rays = 0;

    /// What is shown: filtered where there is a filter, else raw.
    [[nodiscard]] const Planes3& shown() const noexcept {
        return filtered.x.empty() ? raw : filtered;
    }

    /// Luminance Y of a pixel as shown, cd/m2.
    [[nodiscard]] double luminance(std::size_t pixel) const noexcept {
        return luminance_sum(shown().colour(pixel));
    }
};

} // namespace isolux
