#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "isolux/transport/luminaire_pick.h"

namespace isolux {

/// Many luminaires, and which of them light a part of the scene: METHODS "Many luminaires".
/// Every cell of a grid around the luminaires has a cut through the light tree, the finer the
/// nearer its nodes are, all of them weighed; below the one that is drawn the tree decides.
class LightGrid {
public:
    explicit LightGrid(const Scene& scene);

    [[nodiscard]] const LightTree& tree() const noexcept { return tree_; }

    /// A luminaire for the light that falls on a place, drawn with one number in [0, 1).
    [[nodiscard]] LightTree::Pick pick(const Point3& place, double u) const noexcept;

    /// Probability with which pick(place, u) draws a luminaire.
    [[nodiscard]] double probability(const Point3& place, std::size_t luminaire) const noexcept;

private:
    /// Entries by their first leaf in the tree's order.
    struct Cell {
        LuminairePick cut;
        std::array<std::uint32_t, LuminairePick::most> nodes{};
        std::array<std::uint32_t, LuminairePick::most> first_leaf{};
    };

    [[nodiscard]] Cell make_cell(const Bounds& box) const;
    [[nodiscard]] const Cell& cell_of(const Point3& place) const noexcept;

    LightTree tree_;
    std::shared_ptr<const GlowTables> tables_;
    std::vector<int> glow_; ///< of the tree's nodes: where their table begins
    Bounds bounds_;
    std::array<std::size_t, 3> counts_{1, 1, 1}; ///< of cells along x, y and z
    std::vector<Cell> cells_;
};

} // namespace isolux
