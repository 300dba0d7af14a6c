#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "isolux/calc/render.h"
#include "isolux/calc/view_bands.h"
#include "isolux/calc/view_sums.h"
#include "isolux/transport/double_local_estimator.h"
#include "isolux/transport/mirrored_light.h"
#include "isolux/transport/seen_light.h"

/// The parts of the renderer: what they share, the pilot, one pass over the picture.
namespace isolux {

/// Layers of luminaires' light.
inline constexpr std::size_t most_layers = 16;

/// Pixels of a side of the tiles that are worked on at a time.
inline constexpr std::size_t tile_side = 16;

/// Work at a surface that a ray shows.
inline constexpr SeenEffort effort_of_a_sample{4, 1, 4};
inline constexpr SeenEffort effort_of_a_preview{4, 1, 8};

/// Pilot rays a pixel; previews make do with fewer, along which they take their first samples.
inline constexpr std::size_t rays_of_preview = 2;

[[nodiscard]] inline std::size_t pilot_sight_lines(const RenderSettings& settings) noexcept {
    return settings.is_preview ? rays_of_preview : 4;
}

/// What every part of the renderer knows; nothing of it changes while a picture is made.
struct ViewSetup {
    /// @param rows  of the view's picture that are rendered: all, or a band of them
    ViewSetup(const Scene& scene,
              const View& view,
              const RenderSettings& settings,
              const PictureRows& rows);

    const Scene& scene;
    const RenderSettings& settings;
    PictureSize whole;         ///< the view's picture
    PictureSize size;          ///< what is rendered of it
    std::size_t first_row = 0; ///< of it, in the picture: a multiple of tile_side
    CameraRays camera;
    Emission emission;
    MirrorImages images;
    SeenLight light;
    MirroredLight mirrored;
    DoubleLocalEstimator estimator;
    OpeningDetail detail = OpeningDetail::fine;

    /// Luminaires with a layer of their own, and those that share the last one.
    std::vector<std::size_t> single;
    std::vector<std::size_t> merged;

    std::size_t slices_a_side = 8; ///< the picture's pixels take turns with so many slices^2
    std::size_t paths_a_slice = 128;
    EffectiveCounts counts;
    double edge = 0.0; ///< m, METHODS 11.3

    /// Number of a pixel in the whole picture: its random numbers are the same in every band.
    [[nodiscard]] std::uint64_t number(std::size_t pixel) const noexcept {
        return std::uint64_t{pixel} + first_row * size.columns;
    }

    /// The pixel whose pilot looked for occluders and edges on behalf of this one: previews
    /// probe every fourth, the first of a block of two by two.
    [[nodiscard]] std::size_t probed_by(std::size_t pixel) const noexcept {
        if (!settings.is_preview)
            return pixel;
        const std::size_t row = pixel / size.columns;
        const std::size_t column = pixel % size.columns;
        return (row & ~std::size_t{1}) * size.columns + (column & ~std::size_t{1});
    }

    [[nodiscard]] std::size_t layers() const noexcept {
        return single.size() + (merged.empty() ? 0 : 1);
    }
};

/// The buffers with their lights, nothing in them yet.
[[nodiscard]] PixelBuffers make_view_buffers(const ViewSetup& setup);

/// What the pilot found beside the buffers' own planes.
struct PilotPlanes {
    std::vector<std::uint8_t> is_near_edge; ///< the majority surface is traced
    /// Luminaires whose light is too faint to be worth a shadow of its own: bit k stands for
    /// layer k on the first surface, bit 16 + k for the second.
    std::vector<std::uint32_t> faint;
    std::vector<std::uint8_t> has_more;      ///< a ray showed something behind, or in a mirror
    std::vector<std::uint8_t> has_luminaire; ///< rays that showed a luminaire
    Plane reflected;                         ///< rho/pi of the majority surface, 1/sr, as seen
};

/// How often each pixel is sampled, in blocks of picture_replicates passes that come again and
/// again, cycle after cycle. METHODS "Sample counts".
struct SamplePlan {
    std::vector<std::uint8_t> blocks; ///< of a cycle, for each pixel; empty: all have one
    std::vector<std::size_t> active;  ///< pixels that take part in block 0, 1, ...

    [[nodiscard]] bool takes(std::size_t pixel, std::size_t block) const noexcept {
        return blocks.empty() || block < blocks[pixel];
    }
};

/// What the pilot's rays through the pixels of a tile showed. The first samples of a preview
/// look along the same rays, so that every ray's surface is one that the pilot knows.
struct SeenTile {
    std::size_t first_column = 0;
    std::size_t first_row = 0;
    std::vector<EyePath> paths; ///< pixel by pixel, the rays of one after the other

    [[nodiscard]] std::size_t
    index(std::size_t column, std::size_t row, std::size_t ray) const noexcept {
        return ((row - first_row) * tile_side + column - first_column) * rays_of_preview + ray;
    }
};

/// The pilot of the pixels of one tile: surfaces, geometry, unshadowed light, occluders,
/// distances. METHODS "Pictures".
/// @param seen  takes what the rays showed, if given
void run_pilot(const ViewSetup& setup,
               std::size_t first_column,
               std::size_t first_row,
               PixelBuffers& buffers,
               PilotPlanes& pilot,
               SeenTile* seen);

/// Counts from the pilot alone, so that they tell nothing about the picture's own samples.
/// @param mean  samples a pixel and cycle
/// @param buffers  as the pilot left them; takes the variance of reflected light
[[nodiscard]] SamplePlan plan_samples(const ViewSetup& setup,
                                      const PilotPlanes& pilot,
                                      PixelBuffers& buffers,
                                      double mean);

/// Light vertices of one pass, slice by slice.
[[nodiscard]] std::vector<VertexCache>
build_caches(const ViewSetup& setup, std::uint32_t replicate, std::uint64_t unit);

/// One ray through every pixel of one tile that takes part, added to the sums.
/// @param block   of the plan's cycle
/// @param caches  the slices of this pass
/// @param seen    what ray `pass` of the pilot showed is taken instead of rays of its own
void add_samples(const ViewSetup& setup,
                 std::uint32_t pass,
                 const SamplePlan& plan,
                 std::size_t block,
                 std::span<const VertexCache> caches,
                 std::size_t first_column,
                 std::size_t first_row,
                 const PilotPlanes& pilot,
                 PixelBuffers& buffers,
                 PictureSums& sums,
                 const SeenTile* seen);

/// A ray through a pixel, spending a sample's first four numbers: two in the pixel, two on the
/// lens. Nothing outside a fisheye's circle.
[[nodiscard]] std::optional<SightLine> sight_line_of(const ViewSetup& setup,
                                                     std::size_t column,
                                                     std::size_t row,
                                                     NumberSequence& numbers) noexcept;

/// The surface an eye's path shows first, mirrors left out; nothing where there is none.
[[nodiscard]] const SeenSurface* primary_of(const EyePath& path) noexcept;

/// Number that buffers hold for a surface.
[[nodiscard]] inline std::uint32_t object_of(const Scene& scene,
                                             const SeenSurface& seen) noexcept {
    return static_cast<std::uint32_t>(scene.triangle(seen.triangle).surface.index()) + 1U;
}

/// Normals of one surface differ by no more than 10 degrees: its cosine.
inline constexpr double same_normal = 0.984807753012208;

/// Places of one surface see each other no more than 10 degrees above the surface: a step
/// between parallel faces of one object parts them.
/// @param d  from one to the other
[[nodiscard]] inline bool is_level(const UnitVector3& normal, const Vector3& d) noexcept {
    constexpr double sine = 0.173648177666930;
    constexpr double rounding = 1e-4; ///< m
    return std::abs(dot(normal, d)) <= sine * length(d) + rounding;
}

} // namespace isolux
