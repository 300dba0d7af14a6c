#include "isolux/filter/sample_counts.h"

#include <algorithm>
#include <cmath>

#include "isolux/base/parallel.h"

namespace isolux {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr float edge_weight = 0.3F;
constexpr float fully_covered = 0.999F;

/// Mean over a square of pixels of the same object as the middle one; values below 0 are
/// unknown, and so is a mean of none.
Plane mean_on_object(PictureSize size,
                     const std::vector<std::uint32_t>& object,
                     const Plane& values,
                     std::ptrdiff_t radius) {
    Plane mean(values.size(), 0.0F);
    const auto columns = static_cast<std::ptrdiff_t>(size.columns);
    const auto rows = static_cast<std::ptrdiff_t>(size.rows);
    for_each_index(size.rows, 4, [&](std::size_t row) {
        const auto y = static_cast<std::ptrdiff_t>(row);
        for (std::ptrdiff_t x = 0; x < columns; ++x) {
            const auto i = static_cast<std::size_t>(y * columns + x);
            if (object[i] == 0)
                continue;
            float sum = 0.0F;
            float count = 0.0F;
            for (auto v = std::max<std::ptrdiff_t>(0, y - radius);
                 v <= std::min(rows - 1, y + radius);
                 ++v) {
                for (auto u = std::max<std::ptrdiff_t>(0, x - radius);
                     u <= std::min(columns - 1, x + radius);
                     ++u) {
                    const auto j = static_cast<std::size_t>(v * columns + u);
                    const float same =
                        object[j] == object[i] && values[j] >= 0.0F ? 1.0F : 0.0F;
                    sum += same * values[j];
                    count += same;
                }
            }
            mean[i] = count > 0.0F ? sum / count : -1.0F;
        }
    });
    return mean;
}

/// On an edge (the pixel shows two things) or next to one (its neighbour shows
/// another).
std::vector<bool> edges(const PixelGeometry& g, PictureSize size) {
    std::vector<bool> edge(size.pixels(), false);
    for (std::size_t i = 0; i < edge.size(); ++i) {
        const std::size_t x = i % size.columns;
        const bool right = x + 1 < size.columns && g.first.object[i + 1] != g.first.object[i];
        const std::size_t below = i + size.columns;
        const bool down = below < edge.size() && g.first.object[below] != g.first.object[i];
        if (g.coverage[i] < fully_covered || right || down)
            edge[i] = true;
        if (right)
            edge[i + 1] = true;
        if (down)
            edge[below] = true;
    }
    return edge;
}

/// Values below 0 become the mean of the others.
void fill_unknown(Plane& values) {
    double sum = 0.0;
    std::size_t known = 0;
    for (const float v : values) {
        if (v < 0.0F)
            continue;
        sum += static_cast<double>(v);
        ++known;
    }
    const auto mean = static_cast<float>(known > 0 ? sum / static_cast<double>(known) : 0.0);
    for (float& v : values)
        if (v < 0.0F)
            v = mean;
}

SampleNeed make_need(const PixelGeometry& geometry, const FilterSites& sites) {
    SampleNeed need;
    need.left.resize(sites.size.pixels());
    for (std::size_t i = 0; i < need.left.size(); ++i)
        need.left[i] = sites.narrowness[i] > 0.0F
                           ? static_cast<float>(variance_left(sites.columns[i], sites.rows[i]))
                           : 1.0F;
    need.settled.assign(need.left.size(), false);
    need.edge = edges(geometry, sites.size);
    return need;
}

/// A multiple of `step`: every half or replicate of the picture gets as many.
std::uint16_t
whole_count(double n, std::uint16_t least, std::uint16_t most, std::uint16_t step) {
    const double rounded = step * std::floor(n / step + 0.5);
    return static_cast<std::uint16_t>(std::clamp<double>(rounded, least, most));
}

} // namespace

double variance_left(double columns, double rows) noexcept {
    const double area = 4.0 * pi * columns * rows;
    return area > 1.0 ? 1.0 / area : 1.0;
}

SampleNeed
shadow_need(const PixelGeometry& geometry, const LightLayer& light, const FilterSites& sites) {
    SampleNeed need = make_need(geometry, sites);
    const Plane p = mean_on_object(sites.size, sites.object, light.occluded, 1);
    need.variance.assign(p.size(), 0.0F);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const float e = light.unshadowed_first[i];
        need.variance[i] = e * e * p[i] * (1.0F - p[i]);
        need.settled[i] = sites.object[i] == 0 || !(sites.narrowness[i] > 0.0F);
    }
    return need;
}

SampleNeed indirect_need(const PixelGeometry& geometry,
                         const IndirectLayer& indirect,
                         const FilterSites& sites) {
    SampleNeed need = make_need(geometry, sites);
    need.variance = mean_on_object(sites.size, sites.object, indirect.variance, 4);
    fill_unknown(need.variance);
    for (std::size_t i = 0; i < need.variance.size(); ++i)
        need.settled[i] = sites.object[i] == 0;
    return need;
}

void add_need(SampleNeed& total, const SampleNeed& layer) {
    const std::size_t n = layer.variance.size();
    if (total.variance.empty()) {
        total.variance.assign(n, 0.0F);
        total.left.assign(n, 1.0F);
        total.settled.assign(n, true);
        total.edge.assign(n, false);
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (!layer.settled[i]) {
            total.variance[i] += layer.variance[i] * layer.left[i];
            total.settled[i] = false;
        }
        if (layer.edge[i])
            total.edge[i] = true;
    }
}

std::vector<std::uint16_t> counts_for_error(const SampleNeed& need,
                                            double wanted,
                                            std::uint16_t least,
                                            std::uint16_t most) {
    std::vector<std::uint16_t> counts(need.variance.size(), least);
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (!need.settled[i])
            counts[i] = whole_count(
                need.variance[i] * need.left[i] / (wanted * wanted), least, most, 2);
    return counts;
}

std::vector<std::uint16_t> counts_for_budget(const SampleNeed& need,
                                             const Plane& value,
                                             double mean,
                                             std::uint16_t least,
                                             std::uint16_t most,
                                             std::uint16_t step) {
    const std::size_t pixels = value.size();
    double sum = 0.0;
    for (const float v : value)
        sum += v;
    const double dark = 0.1 * sum / static_cast<double>(std::max<std::size_t>(1, pixels));
    Plane weight(pixels, 0.0F);
    for (std::size_t i = 0; i < pixels; ++i) {
        const double scale = std::hypot<double>(value[i], dark);
        if (!need.settled[i] && scale > 0.0)
            weight[i] = static_cast<float>(
                std::sqrt(std::max(0.0F, need.variance[i] * need.left[i])) / scale);
        if (need.edge[i])
            weight[i] = std::max(weight[i], edge_weight);
    }
    const auto counts_at = [&](double factor, std::vector<std::uint16_t>& counts) {
        double total = 0.0;
        for (std::size_t i = 0; i < pixels; ++i)
            total += counts[i] = whole_count(factor * weight[i], least, most, step);
        return total;
    };
    std::vector<std::uint16_t> counts(pixels, least);
    const double budget = mean * static_cast<double>(pixels);
    constexpr double largest_factor = 1e7;
    double low = 0.0;
    double high = 1.0;
    for (; high < largest_factor && counts_at(high, counts) <= budget; high *= 4.0)
        low = high;
    constexpr int halvings = 24;
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (counts_at(middle, counts) <= budget ? low : high) = middle;
    }
    counts_at(low, counts);
    return counts;
}

} // namespace isolux
