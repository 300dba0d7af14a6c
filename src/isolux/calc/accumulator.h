#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "isolux/calc/results.h"
#include "isolux/measure/replicate_flags.h"

namespace isolux {

/// Sums of one calculation: every value indexed by replicate and point, added in a fixed order.
/// Points of all surfaces stand one after the other; a tile is up to 16 neighbours of one
/// surface, but every point is refined as long as it needs. Holds 2 x 8 bytes a replicate and
/// point.
class Accumulator {
public:
    struct Tile {
        std::size_t surface = 0;
        std::size_t first = 0; ///< point, counted over all surfaces
        std::size_t points = 0;
    };

    Accumulator(std::span<const CalculationSurface> surfaces, std::size_t replicates);

    [[nodiscard]] const std::vector<Tile>& tiles() const noexcept { return tiles_; }

    [[nodiscard]] std::size_t points() const noexcept { return points_; }

    [[nodiscard]] std::size_t replicates() const noexcept { return replicates_; }

    /// Which parts of a point's light the next units refine. None: it is closed.
    void refine(std::size_t point, bool direct, bool indirect) noexcept {
        direct_is_open_[point] = direct ? 1 : 0;
        indirect_is_open_[point] = indirect ? 1 : 0;
    }

    [[nodiscard]] bool direct_is_open(std::size_t point) const noexcept {
        return direct_is_open_[point] != 0;
    }

    [[nodiscard]] bool indirect_is_open(std::size_t point) const noexcept {
        return indirect_is_open_[point] != 0;
    }

    /// By point of a tile; 0: no more.
    [[nodiscard]] std::span<const std::uint8_t> open_indirect(const Tile& tile) const noexcept {
        return std::span(indirect_is_open_).subspan(tile.first, tile.points);
    }

    [[nodiscard]] bool is_open(std::size_t point) const noexcept {
        return direct_is_open(point) || indirect_is_open(point);
    }

    [[nodiscard]] bool is_open(const Tile& tile) const noexcept;
    [[nodiscard]] std::size_t open_points() const noexcept;

    /// Another estimator takes over the indirect light of a point: its sums are parked, and
    /// those of the estimator before come back.
    void change_estimator(std::size_t point);

    /// Complete units of work behind the sums of a point.
    [[nodiscard]] std::size_t direct_units(std::size_t point) const noexcept {
        return direct_units_[point];
    }

    [[nodiscard]] std::size_t indirect_units(std::size_t point) const noexcept {
        return indirect_units_[point];
    }

    /// Of the estimator that does not serve the point now.
    [[nodiscard]] std::size_t parked_units(std::size_t point) const noexcept;
    [[nodiscard]] Estimate parked(std::size_t point) const;

    /// Adds one unit of a tile to what is open of its points. Values are [replicate *
    /// tile.points + point], lx.
    void add_unit(const Tile& tile,
                  std::span<const double> direct,
                  std::span<const double> indirect);

    /// Drops the replicates from `kept` on; used when the work was cut short inside a unit.
    void keep_replicates(std::size_t kept) noexcept { replicates_ = kept; }

    /// Replicate values of one point of a tile, averaged over its units.
    void replicate_values(const Tile& tile,
                          std::size_t point_in_tile,
                          std::span<double> direct,
                          std::span<double> indirect,
                          std::span<double> total) const;

    /// What the replicates say of one point.
    struct PointEstimates {
        Estimate direct;
        Estimate indirect;
        Estimate total;
    };

    [[nodiscard]] PointEstimates estimates(const Tile& tile, std::size_t point_in_tile) const;

    /// Of the total.
    [[nodiscard]] ReplicateFlags flags(const Tile& tile, std::size_t point_in_tile) const;

    /// Everything about one surface: points, flags by value, replicate table and summary.
    [[nodiscard]] SurfaceResult surface_result(const CalculationSurface& surface,
                                               std::size_t index) const;

private:
    struct Parked {
        std::vector<double> sums; ///< by replicate
        std::uint32_t units = 0;
    };

    std::vector<Tile> tiles_;
    std::map<std::size_t, Parked> parked_; ///< by point
    std::vector<double> direct_;           ///< sums over units, [replicate][point]
    std::vector<double> indirect_;
    std::vector<std::uint32_t> direct_units_; ///< by point
    std::vector<std::uint32_t> indirect_units_;
    std::vector<std::uint8_t> direct_is_open_;
    std::vector<std::uint8_t> indirect_is_open_;
    std::size_t points_ = 0;
    std::size_t replicates_ = 0;
};

} // namespace isolux
