#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isolux/calc/results.h"

namespace isolux {

/// Sums of one calculation: every value indexed by replicate and point, added in a fixed order.
/// Points of all surfaces stand one after the other; a tile is up to 16 neighbours of one
/// surface. Holds 2 x 8 bytes a replicate and point.
class Accumulator {
public:
    struct Tile {
        std::size_t surface = 0;
        std::size_t first = 0; ///< point, counted over all surfaces
        std::size_t points = 0;
        std::size_t units = 0; ///< complete units of work behind the sums
        bool is_active = true; ///< still refined
    };

    Accumulator(std::span<const CalculationSurface> surfaces, std::size_t replicates);

    [[nodiscard]] std::vector<Tile>& tiles() noexcept { return tiles_; }

    [[nodiscard]] const std::vector<Tile>& tiles() const noexcept { return tiles_; }

    [[nodiscard]] std::size_t points() const noexcept { return points_; }

    [[nodiscard]] std::size_t replicates() const noexcept { return replicates_; }

    /// Adds one unit of a tile. Values are [replicate * tile.points + point], lx.
    void add_unit(Tile& tile, std::span<const double> direct, std::span<const double> indirect);

    /// Drops the replicates from `kept` on; used when the work was cut short inside a unit.
    void keep_replicates(std::size_t kept) noexcept { replicates_ = kept; }

    /// Replicate values of one point of a tile, averaged over its units.
    void replicate_values(const Tile& tile,
                          std::size_t point_in_tile,
                          std::span<double> direct,
                          std::span<double> indirect,
                          std::span<double> total) const;

    [[nodiscard]] Estimate total(const Tile& tile, std::size_t point_in_tile) const;

    /// Everything about one surface: points, flags by value, replicate table and summary.
    [[nodiscard]] SurfaceResult surface_result(const CalculationSurface& surface,
                                               std::size_t index) const;

private:
    std::vector<Tile> tiles_;
    std::vector<double> direct_; ///< sums over units, [replicate][point]
    std::vector<double> indirect_;
    std::size_t points_ = 0;
    std::size_t replicates_ = 0;
};

} // namespace isolux
