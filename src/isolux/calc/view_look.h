#pragma once

#include <array>
#include <optional>
#include <span>

#include "isolux/calc/view_render.h"

namespace isolux {

inline constexpr std::size_t most_pilot_samples = 4;

/// A place of a surface that a pixel shows.
struct SeenPlace {
    Point3 at;
    UnitVector3 normal;
};

/// A ray of the pilot: where it looks, and what it meets first.
struct PilotRay {
    NumberSequence numbers; ///< for what comes next
    std::optional<SightLine> line;
    std::optional<SurfaceHit> hit;
};

/// The pilot's rays through a block of up to two by two pixels, cast together.
class BlockRays {
public:
    /// @param column, row  of the block's first pixel
    BlockRays(const ViewSetup& setup, std::size_t column, std::size_t row);
    BlockRays(const BlockRays&) = delete;
    BlockRays& operator=(const BlockRays&) = delete;

    /// Those of one pixel. @param x, y  0 or 1
    [[nodiscard]] std::span<const PilotRay> of(std::size_t x, std::size_t y) const noexcept {
        return std::span(rays_).subspan((2 * y + x) * rays_a_pixel_, rays_a_pixel_);
    }

private:
    void cast(const RayCaster& caster);

    std::size_t rays_a_pixel_;
    std::array<PointRandomness, 4> random_;
    std::array<PilotRay, 4 * most_pilot_samples> rays_;
};

/// The pilot's rays through one pixel and the two surfaces that most of them meet.
class PilotLook {
public:
    /// @param keep  takes what the rays showed, if given
    PilotLook(const ViewSetup& setup, std::size_t column, std::size_t row, SeenTile* keep)
        : setup_(setup), keep_(keep), column_(column), row_(row),
          pixel_(row * setup.size.columns + column),
          random_(setup.settings.seed, StreamPurpose::pilot, 0, setup.number(pixel_)) {}

    void look(std::span<const PilotRay> rays);

    [[nodiscard]] std::size_t pixel() const noexcept { return pixel_; }

    /// The pixel's random numbers for the pilot.
    [[nodiscard]] const PointRandomness& random() const noexcept { return random_; }

    /// No ray met a surface.
    [[nodiscard]] bool is_empty() const noexcept { return clusters_used_ == 0; }

    [[nodiscard]] bool has_second() const noexcept { return second_ < clusters_used_; }

    /// What the rays on the majority surface met.
    [[nodiscard]] std::span<const SeenSurface> on_first() const noexcept {
        return std::span(on_first_).first(on_first_used_);
    }

    /// The middle of what the pixel shows of its majority surface: where all of it is that
    /// surface, the place its middle looks at, else the mean of the samples.
    [[nodiscard]] SeenPlace first_place() const noexcept;

    /// The mean of the samples. @pre has_second()
    [[nodiscard]] SeenPlace second_place() const noexcept { return place_of(second_); }

    void write_geometry(PixelBuffers& buffers) const;

    /// What the plan of samples has to know.
    void write_plan(PilotPlanes& pilot) const;

private:
    /// Rays that met one surface.
    struct Cluster {
        std::uint32_t object = 0;
        UnitVector3 first_normal;
        Point3 first_place;
        std::size_t count = 0;
        Vector3 normal;
        Vector3 position;
        double depth = 0.0;
    };

    /// One ray's surface.
    struct Sample {
        SeenSurface seen;
        std::uint32_t object = 0;
        double depth_on_axis = 0.0;
        std::size_t cluster = 0;
    };

    std::size_t join(const Sample& s);
    std::size_t add(std::size_t c, const Sample& s);
    void pick_two();
    [[nodiscard]] SeenPlace place_of(std::size_t c) const noexcept;
    [[nodiscard]] std::optional<Point3>
    on_plane(const SeenPlace& p, double x, double y) const noexcept;
    void write_steps(PixelGeometry& g) const;

    const ViewSetup& setup_;
    SeenTile* keep_;
    std::size_t column_, row_, pixel_;
    PointRandomness random_;
    std::uint64_t rays_ = 0;
    std::array<Sample, most_pilot_samples> samples_;
    std::array<Cluster, most_pilot_samples> clusters_;
    std::array<SeenSurface, most_pilot_samples> on_first_;
    std::size_t used_ = 0;
    std::size_t asked_ = 0;
    std::size_t clusters_used_ = 0;
    std::size_t on_first_used_ = 0;
    std::size_t first_ = most_pilot_samples;
    std::size_t second_ = most_pilot_samples;
    bool has_more_ = false;
    std::uint8_t on_luminaire_ = 0;
};

} // namespace isolux
