#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/transport/emission.h"

namespace isolux {

/// The mirrors that a light path met on its way from the luminaire, as long as no chain of
/// images could be longer.
class MirrorsMet {
public:
    static constexpr std::size_t most = 4;

    void add(std::size_t mirror) noexcept {
        if (count_ < most)
            met_[count_] = static_cast<std::uint32_t>(mirror);
        ++count_;
    }

    [[nodiscard]] bool are_too_many() const noexcept { return count_ > most; }

    /// The first one met stands first. @pre not too many
    [[nodiscard]] std::span<const std::uint32_t> list() const noexcept {
        return {met_.data(), count_};
    }

private:
    std::array<std::uint32_t, most> met_{};
    std::size_t count_ = 0;
};

/// The planar mirrors of a scene (panes included: they reflect too) and which chains of mirror
/// reflections between a luminaire and a receiver are evaluated by image points, exactly and
/// without noise, in the direct part: those that may bring most, METHODS "Planar mirrors". All
/// other chains from luminous openings are found by gather rays, where there are any; from
/// point sources they are left out.
class MirrorImages {
public:
    explicit MirrorImages(const Scene& scene);

    struct Mirror {
        Point3 point;
        UnitVector3 normal;
        Point3 lower; ///< box around its triangles
        Point3 upper;
        double strength = 0.0; ///< about what it reflects at most
        double area = 0.0;     ///< m2

        /// Whether the box, grown by `slack` m on all sides, holds a point.
        [[nodiscard]] bool box_holds(const Point3& p, double slack) const noexcept;
    };

    [[nodiscard]] const std::vector<Mirror>& mirrors() const noexcept { return mirrors_; }

    /// Which mirror a triangle belongs to; mirrors().size() if to none.
    [[nodiscard]] std::size_t mirror_of(TriangleId triangle) const noexcept {
        return mirror_of_triangle_[triangle.index()];
    }

    [[nodiscard]] bool scene_has_mirrors() const noexcept { return !mirrors_.empty(); }

    /// A ray from a receiver that has met no mirror yet, and one whose chain has no image.
    static constexpr std::uint32_t no_mirror = 0;
    static constexpr std::uint32_t no_image = ~std::uint32_t{0};

    /// What a ray's chain becomes by a reflection at a triangle. @param chain  no_mirror or
    /// what this function gave
    [[nodiscard]] std::uint32_t follow(std::uint32_t chain, TriangleId triangle) const noexcept;

    /// Whether a ray's chain is the images' business.
    [[nodiscard]] static bool covers(std::uint32_t chain) noexcept {
        return chain != no_image && chain != no_mirror;
    }

    /// Whether the chain of mirrors that a light path met has an image.
    [[nodiscard]] bool covers(const MirrorsMet& mirrors) const noexcept;

    /// The imaged sequences of mirrors, nearest to the receiver first.
    [[nodiscard]] const std::vector<std::vector<std::uint32_t>>& chains() const noexcept {
        return chains_;
    }

    /// Product of the strengths of a chain's mirrors.
    [[nodiscard]] double strength(std::size_t chain) const noexcept {
        return strengths_[chain];
    }

    /// s_m of METHODS eq. (125) of the strongest mirror, with an image or without.
    [[nodiscard]] double strongest() const noexcept { return strongest_; }

    /// The most that chains without an image can bring, as a share of the light that meets
    /// mirrors, METHODS eq. (143); panes as they reflect light that falls nearly straight.
    [[nodiscard]] double share_without_image() const noexcept { return share_without_image_; }

    /// What they may bring where light is spread evenly: small mirrors meet little of it.
    [[nodiscard]] double expected_without_image() const noexcept {
        return expected_without_image_;
    }

    /// A chain for one sample, or none; those that may bring more are drawn more often, METHODS
    /// eq. (125).
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
    [[nodiscard]] std::uint32_t lengthen(std::uint32_t chain,
                                         std::size_t mirror) const noexcept {
        return chain == no_image || mirror >= mirrors_.size()
                   ? no_image
                   : next_[chain * mirrors_.size() + mirror];
    }

    /// Mirrors that have no images.
    struct Rest {
        double light = 0.0;    ///< sum of strength times area, m2
        double strength = 0.0; ///< of the strongest

        void add(double of_one, double area) noexcept {
            light += of_one * area;
            strength = std::max(strength, of_one);
        }
    };

    Rest find_mirrors(const Scene& scene);
    void choose_chains(const Scene& scene, const Rest& untold);
    void number_chains();

    std::vector<double> strengths_;  ///< of the chains
    std::vector<double> cumulative_; ///< probabilities of the chains; the last is at most 1
    std::vector<Mirror> mirrors_;
    std::vector<std::size_t> mirror_of_triangle_;
    std::vector<std::vector<std::uint32_t>> chains_;
    std::vector<std::uint32_t> next_; ///< [no_mirror or 1 + chain][mirror]: 1 + longer chain
    double strongest_ = 0.0;
    double share_without_image_ = 0.0;
    double expected_without_image_ = 0.0;
};

} // namespace isolux
