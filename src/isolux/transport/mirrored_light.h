#pragma once

#include <array>
#include <cstdint>

#include "isolux/transport/image_light.h"

namespace isolux {

/// Direct light that reaches seen surfaces by the mirrors and panes that `images` covers, by a
/// few random chains: what pictures take, where reported numbers take them all. Refers to its
/// arguments.
class MirroredLight {
public:
    MirroredLight(const Scene& scene, const Emission& emission, const MirrorImages& images);

    /// Whether any mirror reflects more than a pane does: then its light has edges that a
    /// filter must not touch.
    [[nodiscard]] bool is_strong() const noexcept { return is_strong_; }

    /// Illuminance, lx by channel; unbiased. METHODS eq. (92)
    [[nodiscard]] Rgb estimate(const Point3& at,
                               const UnitVector3& normal,
                               const std::array<double, 4>& numbers,
                               std::uint64_t& rays) const noexcept;

private:
    const Scene* scene_;
    const Emission* emission_;
    const MirrorImages* images_;
    bool is_strong_ = false;
};

} // namespace isolux
