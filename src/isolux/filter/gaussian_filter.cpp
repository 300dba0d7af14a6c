#include "isolux/filter/gaussian_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "isolux/base/parallel.h"
#include "isolux/filter/gaussian_row.h"

namespace isolux {
namespace {

constexpr float plane_share = 0.05F; ///< of the width, by which j may leave i's tangent plane

/// Which way a pass of the filter goes.
enum class Along : std::uint8_t { rows, columns };

SiteRow row_of(
    const FilterSites& s, Along along, std::size_t radius, const Plane* scale, std::size_t y) {
    const std::size_t first = y * s.size.columns;
    SiteRow row;
    row.x = s.position.x.data() + first;
    row.y = s.position.y.data() + first;
    row.z = s.position.z.data() + first;
    row.nx = s.normal.x.data() + first;
    row.ny = s.normal.y.data() + first;
    row.nz = s.normal.z.data() + first;
    row.object = s.object.data() + first;
    row.narrowness = s.narrowness.data() + first;
    row.width = (along == Along::rows ? s.columns : s.rows).data() + first;
    row.scale = scale != nullptr ? scale->data() + first : nullptr;
    row.count = static_cast<std::ptrdiff_t>(s.size.columns);
    row.step = along == Along::rows ? 1 : row.count;
    row.above = static_cast<std::ptrdiff_t>(y);
    row.below = static_cast<std::ptrdiff_t>(s.size.rows - 1 - y);
    row.largest_radius = static_cast<std::ptrdiff_t>(radius);
    row.central = s.central;
    row.inverse_scale_x = 1.0F / s.scale_x;
    row.inverse_scale_y = 1.0F / s.scale_y;
    row.half_side_x = s.half_side_x;
    row.half_side_y = s.half_side_y;
    row.plane_tolerance = plane_share * s.largest_scale();
    return row;
}

template <std::size_t N> using Pass = std::array<Plane, N>;
template <std::size_t N>
using RowFilter = void (*)(const SiteRow&,
                           const std::array<const float*, N>&,
                           const std::array<float*, N>&);

template <std::size_t N>
Pass<N> one_pass(const FilterSites& sites,
                 Along along,
                 const std::array<const Plane*, N>& in,
                 std::size_t radius,
                 const Plane* scale,
                 RowFilter<N> filter_row) {
    Pass<N> out;
    for (Plane& plane : out)
        plane.resize(sites.size.pixels());
    for_each_index(sites.size.rows, 4, [&](std::size_t y) {
        const std::size_t first = y * sites.size.columns;
        std::array<const float*, N> from{};
        std::array<float*, N> to{};
        for (std::size_t c = 0; c < N; ++c) {
            from[c] = in[c]->data() + first;
            to[c] = out[c].data() + first;
        }
        filter_row(row_of(sites, along, radius, scale, y), from, to);
    });
    return out;
}

/// Nothing is filtered: no width anywhere.
bool is_idle(const FilterSites& sites) {
    return std::none_of(
        sites.narrowness.begin(), sites.narrowness.end(), [](float v) { return v > 0.0F; });
}

template <std::size_t N>
Pass<N> two_passes(const FilterSites& sites,
                   const std::array<const Plane*, N>& in,
                   std::size_t radius,
                   const Plane* scale,
                   RowFilter<N> filter_row) {
    if (is_idle(sites)) {
        Pass<N> same;
        for (std::size_t c = 0; c < N; ++c)
            same[c] = *in[c];
        return same;
    }
    const Pass<N> rows = one_pass<N>(sites, Along::rows, in, radius, scale, filter_row);
    std::array<const Plane*, N> pointers{};
    for (std::size_t c = 0; c < N; ++c)
        pointers[c] = &rows[c];
    return one_pass<N>(sites, Along::columns, pointers, radius, scale, filter_row);
}

Plane transposed(PictureSize size, const Plane& from) {
    constexpr std::size_t block = 32;
    Plane to(from.size());
    const std::size_t blocks = (size.rows + block - 1) / block;
    for_each_index(blocks, 1, [&](std::size_t b) {
        const std::size_t end = std::min(size.rows, (b + 1) * block);
        for (std::size_t x = 0; x < size.columns; ++x)
            for (std::size_t y = b * block; y < end; ++y)
                to[x * size.rows + y] = from[y * size.columns + x];
    });
    return to;
}

/// One pass of the lens along rows.
Plane lens_pass(PictureSize size, const Plane& width, const Plane& in) {
    constexpr float cut_widths = 3.0F;
    Plane out(in.size());
    for_each_index(size.rows, 1, [&](std::size_t y) {
        const std::size_t first = y * size.columns;
        for (std::size_t x = 0; x < size.columns; ++x) {
            const float w = width[first + x];
            if (w < 0.35F) {
                out[first + x] = in[first + x];
                continue;
            }
            const auto reach = static_cast<std::size_t>(std::ceil(cut_widths * w));
            const std::size_t begin = x > reach ? x - reach : 0;
            const std::size_t end = std::min(size.columns, x + reach + 1);
            float sum = 0.0F;
            float weights = 0.0F;
            for (std::size_t j = begin; j < end; ++j) {
                const float m = static_cast<float>(j) - static_cast<float>(x);
                const float weight = exp_of_negative(-0.5F * m * m / (w * w));
                sum += weight * in[first + j];
                weights += weight;
            }
            out[first + x] = sum / weights;
        }
    });
    return out;
}

} // namespace

Planes3 filter_colours(const FilterSites& sites,
                       const Planes3& planes,
                       std::size_t radius,
                       const Plane* scale) {
    auto out =
        two_passes<3>(sites, {&planes.x, &planes.y, &planes.z}, radius, scale, filter_row_3);
    return {std::move(out[0]), std::move(out[1]), std::move(out[2])};
}

Halves filter_halves(const FilterSites& sites, const Halves& halves, std::size_t radius) {
    auto out = two_passes<2>(sites, {&halves.a, &halves.b}, radius, nullptr, filter_row_2);
    return {std::move(out[0]), std::move(out[1])};
}

std::array<Halves, 4>
filter_ladder(const FilterSites& sites, const Halves& halves, std::size_t radius) {
    const Plane* a = &halves.a;
    const Plane* b = &halves.b;
    auto out =
        two_passes<8>(sites, {a, b, a, b, a, b, a, b}, radius, nullptr, filter_row_ladder);
    std::array<Halves, 4> ladder;
    for (std::size_t k = 0; k < ladder.size(); ++k)
        ladder[k] = {std::move(out[2 * k]), std::move(out[2 * k + 1])};
    return ladder;
}

Planes3 filter_lens(PictureSize size, const Plane& width, const Planes3& planes) {
    const PictureSize turned{size.rows, size.columns};
    const Plane turned_width = transposed(size, width);
    const auto both = [&](const Plane& plane) {
        const Plane rows = transposed(size, lens_pass(size, width, plane));
        return transposed(turned, lens_pass(turned, turned_width, rows));
    };
    return {both(planes.x), both(planes.y), both(planes.z)};
}

} // namespace isolux
