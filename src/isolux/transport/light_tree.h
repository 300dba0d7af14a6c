#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/base/receiver.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// What is known of the light of one or more luminaires together: METHODS eq. (14).
struct LightBounds {
    static constexpr std::size_t bands = 16;

    Point3 lower; ///< box around the openings
    Point3 upper;
    UnitVector3 axis;    ///< of the cone that holds the members' own axes
    double spread = 0.0; ///< half angle of that cone, rad
    double reach = 0.0;  ///< no member shines farther from its own axis than this, rad
    double count = 0.0;  ///< luminaires
    double flux = 0.0;   ///< lm
    double facets = 1.0; ///< of the solid opening with most of them, else 1
    std::array<double, bands>
        largest{}; ///< cd, by angle from the own axis, in steps of pi/bands
};

/// How the light of a luminaire type is spread about its own axis.
struct TypeLight {
    UnitVector3 axis;                                 ///< in the luminaire's frame
    std::array<double, LightBounds::bands> largest{}; ///< cd, for a placement's scale of 1
};

[[nodiscard]] TypeLight describe_type(const LuminaireType& type);

/// Bounds of a single luminaire of a type.
[[nodiscard]] LightBounds bound_luminaire(const Luminaire& luminaire, const TypeLight& type);

/// The most that the luminaires of `b` can give to a receiver, lx, if nothing stands in the
/// way: METHODS eq. (14), valid as long as no member is nearer than 1 mm. 0 only where no light
/// can come.
[[nodiscard]] double upper_bound(const LightBounds& b, const Receiver& receiver) noexcept;

/// What of the bounds a walk down the tree weighs them by, small and ready: it happens twenty
/// times for every light path in a hall of a thousand luminaires.
struct LightGlow {
    Point3 middle;       ///< of the box
    float radius = 0.0F; ///< of the ball around it, m
    float spread = 0.0F; ///< as in LightBounds, and wider by what rounding may hide
    float reach = 0.0F;  ///< likewise
    float count = 0.0F;  ///< luminaires
    float most = 0.0F;   ///< of `largest`
    std::array<float, 3> axis{};
    std::array<float, LightBounds::bands> largest{};
};

[[nodiscard]] LightGlow glow_of(const LightBounds& b) noexcept;

/// A weight to draw luminaires by, for a place whose orientation does not count: positive
/// wherever light can come.
[[nodiscard]] float importance(const LightGlow& g, const Point3& place) noexcept;

/// The luminaires of a scene in a binary tree of bounds, for picking one out of many.
class LightTree {
public:
    explicit LightTree(const Scene& scene);

    struct Node {
        LightBounds bounds;
        std::uint32_t left = 0; ///< the right child is left + 1; 0: a leaf
        std::uint32_t parent = 0;
        std::uint32_t luminaire = 0;  ///< of a leaf
        std::uint32_t first_leaf = 0; ///< leaves before those below it

        [[nodiscard]] bool is_leaf() const noexcept { return left == 0; }
    };

    struct Pick {
        std::size_t luminaire = 0;
        double probability = 0.0; ///< 0: no luminaire can light the place
    };

    /// Root first. Empty without luminaires that shine.
    [[nodiscard]] std::span<const Node> nodes() const noexcept { return nodes_; }

    /// Those of a node.
    [[nodiscard]] std::span<const std::uint32_t>
    luminaires_below(std::uint32_t node) const noexcept {
        return std::span(luminaires_)
            .subspan(nodes_[node].first_leaf,
                     static_cast<std::size_t>(nodes_[node].bounds.count));
    }

    /// A luminaire below `node`, drawn with one number in [0, 1): at every fork in proportion
    /// to the bounds.
    [[nodiscard]] Pick
    pick(std::uint32_t node, const Receiver& receiver, double u) const noexcept;

    /// The same for a place whose orientation does not count.
    [[nodiscard]] Pick pick(std::uint32_t node, const Point3& place, double u) const noexcept;

    /// Probability with which pick(node, place, u) draws a luminaire. @pre  it is below the
    /// node
    [[nodiscard]] double
    probability(std::uint32_t node, const Point3& place, std::size_t luminaire) const noexcept;

    static constexpr std::uint32_t no_node = 0xffffffffU;

    /// Node of a luminaire; no_node: it does not shine.
    [[nodiscard]] std::uint32_t leaf_of(std::size_t luminaire) const noexcept {
        return leaf_of_[luminaire];
    }

private:
    void build(std::uint32_t node, std::span<std::uint32_t> members, std::uint32_t first_leaf);
    [[nodiscard]] std::size_t split(std::span<std::uint32_t> members) const;

    std::vector<LightBounds> leaves_; ///< only while the tree is built
    std::vector<Node> nodes_;
    std::vector<LightGlow> glows_; ///< of the nodes
    std::vector<std::uint32_t> leaf_of_;
    std::vector<std::uint32_t> luminaires_; ///< in the order of the leaves
};

} // namespace isolux
