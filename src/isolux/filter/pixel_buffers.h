#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isolux/base/colour.h"
#include "isolux/base/vec.h"

/// What a renderer leaves for the filter, METHODS "Pixel buffers": planes of
/// floats, one value a pixel, row by row from the top left. Every plane has
/// size().pixels() values.
///
/// Lengths are metres, illuminances lx, luminances cd/m2. A and B are two
/// independent halves of the picture: different replicates, nothing shared.
/// Positions are relative to `origin`, so that a float is fine enough.
namespace isolux {

using Plane = std::vector<float>;

struct PictureSize {
    std::size_t columns = 0;
    std::size_t rows = 0;

    [[nodiscard]] constexpr std::size_t pixels() const noexcept { return columns * rows; }

    friend constexpr bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// Three planes: x, y, z or r, g, b.
struct Planes3 {
    Plane x, y, z;

    void assign(std::size_t pixels, float value) {
        x.assign(pixels, value);
        y.assign(pixels, value);
        z.assign(pixels, value);
    }

    void set(std::size_t pixel, const Vector3& v) noexcept {
        x[pixel] = static_cast<float>(v.x);
        y[pixel] = static_cast<float>(v.y);
        z[pixel] = static_cast<float>(v.z);
    }

    void set(std::size_t pixel, const Rgb& c) noexcept { set(pixel, Vector3{c.r, c.g, c.b}); }

    [[nodiscard]] Vector3 vector(std::size_t pixel) const noexcept {
        return {x[pixel], y[pixel], z[pixel]};
    }

    [[nodiscard]] Rgb colour(std::size_t pixel) const noexcept {
        return {x[pixel], y[pixel], z[pixel]};
    }
};

/// One of the two most frequent surfaces of a pixel: one object, normals within
/// 10 degrees of each other. The first is the majority surface.
struct PixelSurface {
    std::vector<std::uint32_t> object; ///< 0: none (background, a luminaire, nothing hit)
    Planes3 normal;                    ///< towards the eye
    /// (1/n) sum of rho/pi over all n samples of half A of the pixel, those
    /// elsewhere counting 0: the c_s <k>_s of METHODS eq. (99), 1/sr. Only the
    /// diffuse part of a material; its mirror and gloss go to the remainder.
    Planes3 reflected_a;
    Planes3 reflected_b; ///< the same of half B
};

/// Where the pixels look. Averages are over the samples on the majority surface
/// only.
struct PixelGeometry {
    Point3 origin;        ///< world position of the planes' zero
    PixelSurface first;   ///< the majority surface
    PixelSurface second;  ///< the next
    Planes3 position;     ///< of the majority surface
    Planes3 column_step;  ///< to where the next pixel of the row would look, on
                          ///< its tangent plane
    Planes3 row_step;     ///< to where the next pixel of the column would look
    Plane depth;          ///< m along the ray
    Plane coverage;       ///< share of the pixel's samples on the majority surface
    Plane lens_shift_min; ///< smallest |r(z)| of the pilot, pixels; 0 for a pinhole
    Plane samples_a;      ///< samples of half A on the majority surface; 0: none
    Plane samples_b;      ///< the same of half B
};

/// A luminaire's opening as the filter sees it: a rectangle of the same extent.
/// A merged layer (several small luminaires in one) has sides 0 and gives its
/// width itself.
struct LightLayer {
    Point3 centre;             ///< world
    Basis frame;               ///< t, b along the sides, n the light's normal
    double side_t = 0.0;       ///< m
    double side_b = 0.0;       ///< m
    Rgb colour{1.0, 1.0, 1.0}; ///< luminance_sum == 1
    bool merged = false;

    // The pilot: shadow rays of samples on the majority surface, METHODS eq.
    // (93), (94).
    Plane slope_min;    ///< smallest d1/d2 - 1 (occluder next to the receiver); < 0:
                        ///< no occluder
    Plane occluded;     ///< (occluded + 1/2)/(n0 + 1) of n0 shadow rays
    Plane merged_width; ///< m, smallest width of what is merged; only for a
                        ///< merged layer

    /// Unshadowed illuminance, averaged with the weight rho over the samples on
    /// the first and on the second surface: <k E_u>_s/<k>_s. Analytic or densely
    /// sampled, free of noise.
    Plane unshadowed_first;
    Plane unshadowed_second;

    Plane visible_a; ///< E/E_u over the samples of half A on the majority
                     ///< surface, 0 to 1
    Plane visible_b; ///< the same of half B
};

/// Reflected light on the majority surface: irradiance before it meets the
/// surface's own reflectance.
struct IndirectLayer {
    Planes3 a; ///< lx by colour channel, half A
    Planes3 b; ///< half B

    // The pilot: hit distances along cosine-distributed directions, cos(theta) >=
    // 0.22.
    Plane z_min;    ///< m; infinite: nothing hit
    Plane variance; ///< of one sample's luminance_sum, lx^2; < 0: unknown
};

/// All a renderer leaves. What is in no layer is in the remainder and passes
/// unfiltered.
struct PixelBuffers {
    PictureSize size;
    PixelGeometry geometry;
    std::vector<LightLayer> lights;
    IndirectLayer indirect;
    Planes3 remainder_a; ///< cd/m2 by channel: luminaires, mirrors, gloss,
                         ///< further surfaces
    Planes3 remainder_b;
};

/// All planes at their sizes: no surface, no light, no occluder, z infinite,
/// visibility 1.
/// @param lights  centre, frame and sides of each; their planes are allocated
/// here
[[nodiscard]] PixelBuffers make_pixel_buffers(PictureSize size, std::vector<LightLayer> lights);

/// Memory of the buffers, bytes a pixel: 192 and 24 more for every light (28 if
/// merged).
[[nodiscard]] std::size_t bytes_a_pixel(const PixelBuffers& buffers) noexcept;

} // namespace isolux
