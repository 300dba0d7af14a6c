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

/// Largest intensity of directions with a cosine to the axis in cell `i`.
double largest_in_cell(const LightBounds& b, std::size_t i) {
    const auto band = [](double cosine) {
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
        return std::min(
            LightBounds::bands - 1,
            static_cast<std::size_t>(angle / pi * static_cast<double>(LightBounds::bands)));
    };
    constexpr double step = 2.0 / static_cast<double>(LuminairePick::cells);
    const double cosine = -1.0 + step * static_cast<double>(i);
    return *std::max_element(b.largest.begin() + band(cosine + step),
                             b.largest.begin() + band(cosine) + 1);
}

/// The first `count`, a multiple of `wide`.
ISOLUX_WIDE_VECTORS void weigh_all(const LuminairePick::Lights& lights,
                                   int count,
                                   float x,
                                   float y,
                                   float z,
                                   float* __restrict weights) noexcept {
    constexpr float half = 0.5F * static_cast<float>(LuminairePick::cells);
    const float* const glow = lights.glow.data();
    for (int i = 0; i < count; ++i) {
        const float dx = x - lights.x[i];
        const float dy = y - lights.y[i];
        const float dz = z - lights.z[i];
        const float d2 = dx * dx + dy * dy + dz * dz;
        const float along =
            lights.axis_x[i] * dx + lights.axis_y[i] * dy + lights.axis_z[i] * dz;
        const float place = half + half * along / std::sqrt(d2 + 1e-30F);
        const float cell = std::min(std::max(place, 0.0F), 2.0F * half - 1.0F);
        const int at = static_cast<int>(LuminairePick::cells) * i + static_cast<int>(cell);
        weights[i] = glow[at] / (d2 + lights.spread[i]);
    }
}

} // namespace

void LuminairePick::add(const LightBounds& bounds,
                        const Point3& centre,
                        double largest_dimension) {
    ISOLUX_EXPECT(count_ < most);
    if (count_ == wide * blocks_) { // places without a luminaire weigh nothing
        const auto next = static_cast<std::ptrdiff_t>(count_);
        std::fill_n(lights_.spread.begin() + next, wide, 1.0F);
        lights_.glow.resize(cells * wide * ++blocks_, 0.0F);
    }
    if (count_ == 0)
        first_ = centre;
    const Vector3 from_first = centre - first_;
    lights_.x[count_] = static_cast<float>(from_first.x);
    lights_.y[count_] = static_cast<float>(from_first.y);
    lights_.z[count_] = static_cast<float>(from_first.z);
    lights_.axis_x[count_] = static_cast<float>(bounds.axis.x());
    lights_.axis_y[count_] = static_cast<float>(bounds.axis.y());
    lights_.axis_z[count_] = static_cast<float>(bounds.axis.z());
    lights_.spread[count_] =
        static_cast<float>(0.25 * largest_dimension * largest_dimension + least_spread);
    const double least = least_share * bounds.flux / (4.0 * pi);
    for (std::size_t i = 0; i < cells; ++i)
        lights_.glow[cells * count_ + i] =
            static_cast<float>(least + largest_in_cell(bounds, i));
    ++count_;
}

LuminairePick::Weights LuminairePick::weigh(const Point3& place) const noexcept {
    Weights w;
    const Vector3 p = place - first_;
    weigh_all(lights_,
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

LightTree::Pick LuminairePick::pick(const Point3& place, double u) const noexcept {
    const Weights w = weigh(place);
    double rest = u * w.sum;
    std::size_t block = 0;
    while (block + 1 < blocks_ && rest >= w.of_block[block])
        rest -= w.of_block[block++];
    std::size_t chosen = wide * block;
    for (std::size_t i = chosen; i < wide * (block + 1); ++i) {
        const auto weight = static_cast<double>(w.of[i]);
        if (weight <= 0.0)
            continue;
        chosen = i;
        if (rest < weight)
            break;
        rest -= weight;
    }
    return {chosen, static_cast<double>(w.of[chosen]) / w.sum};
}

double LuminairePick::probability(const Point3& place, std::size_t luminaire) const noexcept {
    const Weights w = weigh(place);
    return static_cast<double>(w.of[luminaire]) / w.sum;
}

} // namespace isolux
