#pragma once

#include <cstdint>
#include <vector>

#include "isolux/transport/emission.h"

namespace isolux {

/// The planar mirrors of a scene (panes included: they reflect too) and the rule which chains
/// of mirror reflections between a luminaire and a receiver are evaluated by image points,
/// exactly and without noise, in the direct part. All other chains from luminous openings are
/// found by gather rays; from point sources they are left out, and METHODS "Planar mirrors"
/// bounds them.
class MirrorImages {
public:
    explicit MirrorImages(const Scene& scene);

    struct Mirror {
        Point3 point;
        UnitVector3 normal;
        Point3 lower; ///< box around its triangles
        Point3 upper;
        double strength = 0.0; ///< about what it reflects at most
    };

    [[nodiscard]] const std::vector<Mirror>& mirrors() const noexcept { return mirrors_; }

    /// Longest chain that is evaluated by images; 0 if there are too many mirrors for images.
    [[nodiscard]] std::size_t order() const noexcept { return order_; }

    /// Which mirror a triangle belongs to; mirrors().size() if to none.
    [[nodiscard]] std::size_t mirror_of(TriangleId triangle) const noexcept {
        return mirror_of_triangle_[triangle.index()];
    }

    [[nodiscard]] bool scene_has_mirrors() const noexcept { return !mirrors_.empty(); }

    /// Whether a chain of `reflections` mirror reflections is the images' business.
    [[nodiscard]] bool covers(std::size_t reflections) const noexcept {
        return reflections <= order_;
    }

    /// The mirrors' sequences of 1 to order() reflections, nearest to the receiver first.
    [[nodiscard]] const std::vector<std::vector<std::uint32_t>>& chains() const noexcept {
        return chains_;
    }

    /// Product of the strengths of a chain's mirrors.
    [[nodiscard]] double strength(std::size_t chain) const noexcept {
        return strengths_[chain];
    }

    /// A chain for one sample, or none; strong ones are drawn more often, METHODS eq. (125).
    struct DrawnChain {
        const std::vector<std::uint32_t>* chain = nullptr; ///< null: none
        double probability = 0.0;
    };

    [[nodiscard]] DrawnChain draw_chain(double u) const noexcept;

    /// How often draw_chain finds one, 0..1.
    [[nodiscard]] double draws() const noexcept {
        return cumulative_.empty() ? 0.0 : cumulative_.back();
    }

private:
    std::vector<double> strengths_;  ///< of the chains
    std::vector<double> cumulative_; ///< probabilities of the chains; the last is at most 1
    std::vector<Mirror> mirrors_;
    std::vector<std::size_t> mirror_of_triangle_;
    std::vector<std::vector<std::uint32_t>> chains_;
    std::size_t order_ = 0;
};

/// Light of one emission point that reaches a place over a chain of mirrors.
struct ImageLight {
    UnitVector3 arrival; ///< from the place towards where the light comes from
    double strength =
        0.0; ///< intensity per area of opening times reflectances over squared path length
    TowardsSample sample;
};

/// The place as the luminaires see it in the mirrors of `chain` (nearest to the place first).
[[nodiscard]] Point3 image_of(const MirrorImages& images,
                              const std::vector<std::uint32_t>& chain,
                              const Point3& place) noexcept;

/// Follows the light of an emission point to a place over a chain of mirrors; every segment is
/// traced, panes that only pass the light dim it.
/// @param sample  drawn for image_of(place)
[[nodiscard]] ImageLight trace_image(const Scene& scene,
                                     const Emission& emission,
                                     const MirrorImages& images,
                                     const std::vector<std::uint32_t>& chain,
                                     const Point3& place,
                                     const TowardsSample& sample,
                                     std::uint64_t& rays) noexcept;

} // namespace isolux
