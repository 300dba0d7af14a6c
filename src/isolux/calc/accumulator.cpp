#include "isolux/calc/accumulator.h"

#include <algorithm>

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
            tiles_.push_back({s, points_ + p, std::min(tile_size, n - p), 0, true});
        points_ += n;
    }
    direct_.assign(replicates_ * points_, 0.0);
    indirect_.assign(replicates_ * points_, 0.0);
}

void Accumulator::add_unit(Tile& tile,
                           std::span<const double> direct,
                           std::span<const double> indirect) {
    for (std::size_t r = 0; r < replicates_; ++r)
        for (std::size_t p = 0; p < tile.points; ++p) {
            direct_[r * points_ + tile.first + p] += direct[r * tile.points + p];
            indirect_[r * points_ + tile.first + p] += indirect[r * tile.points + p];
        }
    ++tile.units;
}

void Accumulator::replicate_values(const Tile& tile,
                                   std::size_t point_in_tile,
                                   std::span<double> direct,
                                   std::span<double> indirect,
                                   std::span<double> total) const {
    const double share = tile.units > 0 ? 1.0 / static_cast<double>(tile.units) : 0.0;
    for (std::size_t r = 0; r < replicates_; ++r) {
        const std::size_t at = r * points_ + tile.first + point_in_tile;
        direct[r] = share * direct_[at];
        indirect[r] = share * indirect_[at];
        total[r] = direct[r] + indirect[r];
    }
}

Estimate Accumulator::total(const Tile& tile, std::size_t point_in_tile) const {
    std::vector<double> d(replicates_), i(replicates_), t(replicates_);
    replicate_values(tile, point_in_tile, d, i, t);
    return estimate_from_replicates(t);
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
