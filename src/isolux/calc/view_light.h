#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "isolux/calc/view_render.h"

namespace isolux {

/// Which of the two surfaces that the pilot found a ray shows.
enum class Shown : std::uint8_t { first, second, elsewhere };

/// Direct light in one sample of one pixel.
class PixelLight {
public:
    /// @param unit  number of the sample in its replicate
    PixelLight(const ViewSetup& setup,
               const PilotPlanes& pilot,
               const PixelBuffers& buffers,
               std::size_t column,
               std::size_t row,
               std::uint32_t replicate,
               std::uint32_t unit)
        : setup_(setup), pilot_(pilot), buffers_(buffers), column_(column), row_(row),
          pixel_(row * setup.size.columns + column), probed_(setup.probed_by(pixel_)),
          replicate_(replicate), unit_(unit) {}

    /// The pixel whose pilot looked for occluders and edges: previews probe every fourth, the
    /// neighbour's finding steers as well.
    [[nodiscard]] std::size_t probed() const noexcept { return probed_; }

    /// Direct light on one of the pixel's two surfaces, lx; keeps what is visible of each
    /// layer.
    /// @param faint  takes the light of the luminaires that have no shadow of their own here
    Rgb in_layers(const SeenSurface& seen, Shown shown, Rgb& faint);

    /// Of each layer, after in_layers.
    [[nodiscard]] std::span<const double> visible() const noexcept {
        return std::span(visible_).first(buffers_.lights.size());
    }

    /// Direct light on a surface that is none of the pixel's two: every luminaire.
    Rgb on(const SeenSurface& seen);

    /// Direct light on a surface in a mirror or behind a second pane: every luminaire if it
    /// matters, one of them if it is faint.
    Rgb elsewhere(const SeenSurface& seen, NumberSequence& numbers);

    /// Straight light that comes by imaged mirrors; previews ask every sixteenth ray.
    [[nodiscard]] Rgb mirrored(const SeenSurface& seen);

private:
    /// One luminaire to be looked at: what is wanted is the share of it that is visible,
    /// METHODS eq. (89).
    struct Look {
        std::size_t luminaire = 0;
        double unshadowed = 0.0; ///< lx
        double chance = 1.0;     ///< of looking at all
        double expected = 1.0;   ///< what the pilot found; it steers only
        std::uint32_t block = 0; ///< of the random numbers
    };

    std::array<double, packet_size> look_at(const SeenSurface& seen,
                                            std::span<const Look> looks);
    [[nodiscard]] LightAim aim_at(const Look& look,
                                  const SeenSurface& seen,
                                  const std::array<std::uint32_t, 4>& words) const;
    [[nodiscard]] bool is_left_out(const RandomStream& stream, const Look& look);
    [[nodiscard]] double expected_of(const LightLayer& layer) const noexcept;
    [[nodiscard]] bool is_wide_footprint() const noexcept;
    [[nodiscard]] double chance_of(double e, double total) const noexcept;
    double faint_look(const SeenSurface& seen,
                      Shown shown,
                      std::array<Look, packet_size>& looks,
                      std::size_t& count) const;
    [[nodiscard]] Look merged_look(const SeenSurface& seen, double e) const;

    const ViewSetup& setup_;
    const PilotPlanes& pilot_;
    const PixelBuffers& buffers_;
    std::size_t column_, row_, pixel_, probed_;
    std::uint32_t replicate_, unit_;
    std::array<double, most_layers> visible_{};
    std::array<double, packet_size> arrived_{}; ///< of each look, nothing expected
    std::uint32_t turns_of_ = ~0U;              ///< the four random numbers that turns_ holds
    std::array<double, 4> turns_{};
    std::uint64_t rays_ = 0;
};

} // namespace isolux
