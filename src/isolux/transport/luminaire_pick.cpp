#include "isolux/transport/luminaire_pick.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/base/check.h"
#include "isolux/base/wide_vectors.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Share of its mean intensity that a luminaire is picked with in every direction: whatever the
/// size of its opening, no light is left out.
constexpr double least_share = 0.1;

/// m2, so that no luminaire counts endlessly.
constexpr double least_spread = 1e-4;

/// Band of LightBounds that holds the direction with a cosine to the axis of -1 + 2 i/cells.
std::size_t band_at(std::size_t i) {
    static const auto bands = [] {
        std::array<std::size_t, GlowTables::cells + 1> of;
        for (std::size_t k = 0; k < of.size(); ++k) {
            const double cosine = -1.0 + 2.0 * static_cast<double>(k) / GlowTables::cells;
            const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
            of[k] = std::min(LightBounds::bands - 1,
                             static_cast<std::size_t>(angle / pi * LightBounds::bands));
        }
        return of;
    }();
    return bands[i];
}

/// The first `count`, a multiple of `wide`.
ISOLUX_WIDE_VECTORS void weigh_all(const LuminairePick::Lights& lights,
                                   const float* __restrict glow,
                                   int count,
                                   float x,
                                   float y,
                                   float z,
                                   float* __restrict weights) noexcept {
    constexpr float half = 0.5F * static_cast<float>(GlowTables::cells);
    for (int i = 0; i < count; ++i) {
        const float dx = x - lights.x[i];
        const float dy = y - lights.y[i];
        const float dz = z - lights.z[i];
        const float d2 = dx * dx + dy * dy + dz * dz;
        const float along =
            lights.axis_x[i] * dx + lights.axis_y[i] * dy + lights.axis_z[i] * dz;
        const float place = half + half * along / std::sqrt(d2 + 1e-30F);
        const float cell = std::min(std::max(place, 0.0F), 2.0F * half - 1.0F);
        weights[i] = glow[lights.glow[i] + static_cast<int>(cell)] / (d2 + lights.spread[i]);
    }
}

} // namespace

GlowTables::GlowTables() { add({}); }

int GlowTables::add(const LightBounds& bounds) {
    const double least = least_share * bounds.flux / (4.0 * pi);
    Table table;
    for (std::size_t i = 0; i < cells; ++i)
        table[i] =
            static_cast<float>(least
                               + *std::max_element(bounds.largest.begin() + band_at(i + 1),
                                                   bounds.largest.begin() + band_at(i) + 1));
    const auto [known, is_new] = known_.emplace(table, static_cast<int>(values_.size()));
    if (is_new)
        values_.insert(values_.end(), table.begin(), table.end());
    return known->second;
}

void LuminairePick::add(int glow,
                        const UnitVector3& axis,
                        const Point3& centre,
                        double largest_dimension) {
    ISOLUX_EXPECT(count_ < most);
    if (count_ == wide * blocks_) { // places without a luminaire weigh nothing
        std::fill_n(lights_.spread.begin() + static_cast<std::ptrdiff_t>(count_), wide, 1.0F);
        ++blocks_;
    }
    if (count_ == 0)
        first_ = centre;
    const Vector3 from_first = centre - first_;
    lights_.x[count_] = static_cast<float>(from_first.x);
    lights_.y[count_] = static_cast<float>(from_first.y);
    lights_.z[count_] = static_cast<float>(from_first.z);
    lights_.axis_x[count_] = static_cast<float>(axis.x());
    lights_.axis_y[count_] = static_cast<float>(axis.y());
    lights_.axis_z[count_] = static_cast<float>(axis.z());
    lights_.spread[count_] =
        static_cast<float>(0.25 * largest_dimension * largest_dimension + least_spread);
    lights_.glow[count_] = glow;
    ++count_;
}

LuminairePick::Weights LuminairePick::weigh(const Point3& place) const noexcept {
    Weights w;
    const Vector3 p = place - first_;
    weigh_all(lights_,
              tables_->values(),
              static_cast<int>(wide * blocks_),
              static_cast<float>(p.x),
              static_cast<float>(p.y),
              static_cast<float>(p.z),
              w.of.data());
    for (std::size_t b = 0; b < blocks_; ++b) {
        std::array<double, 4> sums{};
        for (std::size_t k = 0; k < wide; ++k)
            sums[k % 4] += static_cast<double>(w.of[wide * b + k]);
        w.of_block[b] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
        w.sum += w.of_block[b];
    }
    return w;
}

LuminairePick::Pick LuminairePick::pick(const Point3& place, double u) const noexcept {
    const Weights w = weigh(place);
    double rest = u * w.sum;
    std::size_t block = 0;
    while (block + 1 < blocks_ && rest >= w.of_block[block])
        rest -= w.of_block[block++];
    Pick chosen{wide * block};
    for (std::size_t i = chosen.entry; i < wide * (block + 1); ++i) {
        const auto weight = static_cast<double>(w.of[i]);
        if (weight <= 0.0)
            continue;
        chosen = {i, weight / w.sum, std::clamp(rest / weight, 0.0, 1.0 - 1e-16)};
        if (rest < weight)
            break;
        rest -= weight;
    }
    return chosen;
}

double LuminairePick::probability(const Point3& place, std::size_t entry) const noexcept {
    const Weights w = weigh(place);
    return w.sum > 0.0 ? static_cast<double>(w.of[entry]) / w.sum : 0.0;
}

} // namespace isolux
