#include "isolux/calc/accumulator.h"

#include <algorithm>
#include <utility>

#include "isolux/measure/replicate_flags.h"

namespace isolux {

namespace {

constexpr std::size_t tile_size = 16;

} // namespace

Accumulator::Accumulator(std::span<const CalculationSurface> surfaces, std::size_t replicates)
    : replicates_(replicates) {
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const std::size_t n = surfaces[s].receivers.size();
        for (std::size_t p = 0; p < n; p += tile_size)
            tiles_.push_back({s, points_ + p, std::min(tile_size, n - p)});
        points_ += n;
    }
    direct_.assign(replicates_ * points_, 0.0);
    indirect_.assign(replicates_ * points_, 0.0);
    direct_units_.assign(points_, 0);
    indirect_units_.assign(points_, 0);
    direct_is_open_.assign(points_, 1);
    indirect_is_open_.assign(points_, 1);
}

bool Accumulator::is_open(const Tile& tile) const noexcept {
    for (std::size_t p = tile.first; p < tile.first + tile.points; ++p)
        if (is_open(p))
            return true;
    return false;
}

std::size_t Accumulator::open_points() const noexcept {
    std::size_t count = 0;
    for (std::size_t p = 0; p < points_; ++p)
        count += is_open(p) ? 1 : 0;
    return count;
}

void Accumulator::add_unit(const Tile& tile,
                           std::span<const double> direct,
                           std::span<const double> indirect) {
    for (std::size_t p = 0; p < tile.points; ++p) {
        const std::size_t point = tile.first + p;
        for (std::size_t r = 0; r < replicates_; ++r) {
            const std::size_t at = r * points_ + point;
            if (direct_is_open(point))
                direct_[at] += direct[r * tile.points + p];
            if (indirect_is_open(point))
                indirect_[at] += indirect[r * tile.points + p];
        }
        direct_units_[point] += direct_is_open_[point];
        indirect_units_[point] += indirect_is_open_[point];
    }
}

void Accumulator::change_estimator(std::size_t point) {
    Parked& other = parked_[point];
    other.sums.resize(replicates_);
    for (std::size_t r = 0; r < replicates_; ++r)
        std::swap(other.sums[r], indirect_[r * points_ + point]);
    std::swap(other.units, indirect_units_[point]);
}

std::size_t Accumulator::parked_units(std::size_t point) const noexcept {
    const auto found = parked_.find(point);
    return found == parked_.end() ? 0 : found->second.units;
}

Estimate Accumulator::parked(std::size_t point) const {
    const Parked& other = parked_.at(point);
    std::vector<double> values;
    for (std::size_t r = 0; r < replicates_; ++r)
        values.push_back(other.sums[r] / static_cast<double>(other.units));
    return estimate_from_replicates(values);
}

void Accumulator::replicate_values(const Tile& tile,
                                   std::size_t point_in_tile,
                                   std::span<double> direct,
                                   std::span<double> indirect,
                                   std::span<double> total) const {
    const std::size_t point = tile.first + point_in_tile;
    const auto share_of = [](std::uint32_t units) {
        return units > 0 ? 1.0 / static_cast<double>(units) : 0.0;
    };
    const double direct_share = share_of(direct_units_[point]);
    const double indirect_share = share_of(indirect_units_[point]);
    for (std::size_t r = 0; r < replicates_; ++r) {
        const std::size_t at = r * points_ + point;
        direct[r] = direct_share * direct_[at];
        indirect[r] = indirect_share * indirect_[at];
        total[r] = direct[r] + indirect[r];
    }
}

Accumulator::PointEstimates Accumulator::estimates(const Tile& tile,
                                                   std::size_t point_in_tile) const {
    std::vector<double> d(replicates_), i(replicates_), t(replicates_);
    replicate_values(tile, point_in_tile, d, i, t);
    return {
        estimate_from_replicates(d), estimate_from_replicates(i), estimate_from_replicates(t)};
}

ReplicateFlags Accumulator::flags(const Tile& tile, std::size_t point_in_tile) const {
    std::vector<double> d(replicates_), i(replicates_), t(replicates_);
    replicate_values(tile, point_in_tile, d, i, t);
    return flag_replicates(t);
}

SurfaceResult Accumulator::surface_result(const CalculationSurface& surface,
                                          std::size_t index) const {
    SurfaceResult result;
    result.surface = surface;
    const std::size_t n = surface.receivers.size();
    result.points.resize(n);
    result.replicates = {replicates_, n, std::vector<double>(replicates_ * n)};
    result.direct = result.replicates;
    std::vector<double> d(replicates_), i(replicates_), t(replicates_);
    std::size_t point = 0;
    for (const Tile& tile : tiles_) {
        if (tile.surface != index)
            continue;
        for (std::size_t p = 0; p < tile.points; ++p, ++point) {
            replicate_values(tile, p, d, i, t);
            PointResult& out = result.points[point];
            out.total = estimate_from_replicates(t);
            out.direct = estimate_from_replicates(d);
            out.indirect = estimate_from_replicates(i);
            const ReplicateFlags flags = flag_replicates(t);
            out.suspicious_replicate = flags.suspicious_replicate;
            out.heavy_tail = flags.heavy_tail;
            for (std::size_t r = 0; r < replicates_; ++r) {
                result.replicates.values[r * n + point] = t[r];
                result.direct.values[r * n + point] = d[r];
            }
        }
    }
    if (n > 0 && replicates_ > 0)
        result.summary = summarise(result.replicates);
    return result;
}

} // namespace isolux
