#include "isolux/filter/lens_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "isolux/base/parallel.h"
#include "isolux/filter/filter_sites.h"
#include "isolux/filter/verify.h"

namespace isolux {
namespace {

constexpr float narrowest_pixels = 0.35F;
constexpr std::size_t grain = 4096; ///< pixels

Planes3 mean_of(const Planes3& a, const Planes3& b) {
    Planes3 mean = a;
    for_each_index(mean.x.size(), grain, [&](std::size_t i) {
        mean.x[i] = 0.5F * (a.x[i] + b.x[i]);
        mean.y[i] = 0.5F * (a.y[i] + b.y[i]);
        mean.z[i] = 0.5F * (a.z[i] + b.z[i]);
    });
    return mean;
}

void add(Planes3& to, const Planes3& what) {
    for_each_index(to.x.size(), grain, [&](std::size_t i) {
        to.x[i] += what.x[i];
        to.y[i] += what.y[i];
        to.z[i] += what.z[i];
    });
}

void add_luminance(Plane& to, const Planes3& what) {
    for (std::size_t i = 0; i < to.size(); ++i)
        to[i] += static_cast<float>(luminance_sum(what.colour(i)));
}

FilterSites everywhere(PictureSize size) {
    FilterSites sites;
    sites.size = size;
    sites.object.assign(size.pixels(), 1);
    return sites;
}

void blend(Planes3& planes, const Planes3& filtered, const Plane& share) {
    for (std::size_t i = 0; i < share.size(); ++i) {
        planes.x[i] += share[i] * (filtered.x[i] - planes.x[i]);
        planes.y[i] += share[i] * (filtered.y[i] - planes.y[i]);
        planes.z[i] += share[i] * (filtered.z[i] - planes.z[i]);
    }
}

/// Share of the lens's filter, a pixel: 0 in focus, elsewhere by the halves.
Plane lens_share(PictureSize size,
                 const Plane& width,
                 const FilterSettings& settings,
                 const Halves& before,
                 const Halves& after) {
    constexpr std::size_t smoothing = 7;
    FilterSites sites = everywhere(size);
    for (std::size_t i = 0; i < width.size(); ++i)
        if (width[i] < narrowest_pixels)
            sites.object[i] = 0;
    Plane share(width.size(), 1.0F);
    if (settings.choose_width) {
        const std::array<Halves, 1> candidates{after};
        const auto best =
            best_candidates(sites, before, candidates, window_side(settings, false));
        for (std::size_t i = 0; i < share.size(); ++i)
            share[i] = static_cast<float>(best[i]);
        share = window_mean(sites, share, smoothing);
    }
    for (std::size_t i = 0; i < share.size(); ++i)
        if (sites.object[i] == 0)
            share[i] = 0.0F;
    return share;
}

void filter_by_lens(const PixelBuffers& buffers,
                    const FilterSettings& settings,
                    VerifiedHalves& halves,
                    Planes3& remainder,
                    FilteredPicture& picture) {
    const PictureSize size = buffers.size;
    const Plane width = make_lens_width(buffers.geometry, settings);
    if (*std::max_element(width.begin(), width.end()) < narrowest_pixels)
        return;
    Halves before = halves.filtered;
    add_luminance(before.a, buffers.remainder_a);
    add_luminance(before.b, buffers.remainder_b);
    const auto blurred = [&](const Halves& h) {
        Planes3 both = filter_lens(size, width, {h.a, h.b, Plane(width.size(), 0.0F)});
        return Halves{std::move(both.x), std::move(both.y)};
    };
    const Plane share = lens_share(size, width, settings, before, blurred(before));
    const Halves after = blurred(halves.filtered);
    blend(picture.direct, filter_lens(size, width, picture.direct), share);
    blend(picture.indirect, filter_lens(size, width, picture.indirect), share);
    blend(remainder, filter_lens(size, width, remainder), share);
    for (std::size_t i = 0; i < share.size(); ++i) {
        halves.filtered.a[i] += share[i] * (after.a[i] - halves.filtered.a[i]);
        halves.filtered.b[i] += share[i] * (after.b[i] - halves.filtered.b[i]);
    }
}

} // namespace

void finish_picture(const PixelBuffers& buffers,
                    const FilterSettings& settings,
                    VerifiedHalves& halves,
                    FilteredPicture& picture) {
    Planes3 remainder = mean_of(buffers.remainder_a, buffers.remainder_b);
    filter_by_lens(buffers, settings, halves, remainder, picture);
    picture.colour = picture.direct;
    add(picture.colour, picture.indirect);
    add(picture.colour, remainder);

    FilterSites sites = everywhere(buffers.size);
    sites.object = buffers.geometry.first.object;
    const SquaredErrors e = squared_errors(halves.raw, halves.filtered);
    const std::size_t window = window_side(settings, false);
    picture.standard_error = window_mean(sites, e.filtered, window);
    picture.raw_error = window_mean(sites, e.raw, window);
    for_each_index(buffers.size.pixels(), grain, [&](std::size_t i) {
        // The remainder is noisy next to luminaires only: its own pixel is its
        // window.
        const double difference = luminance_sum(buffers.remainder_a.colour(i))
                                  - luminance_sum(buffers.remainder_b.colour(i));
        const auto noise = static_cast<float>(0.25 * difference * difference);
        picture.standard_error[i] =
            std::sqrt(std::max(0.0F, picture.standard_error[i]) + noise);
        picture.raw_error[i] = std::sqrt(picture.raw_error[i] + noise);
    });
}

} // namespace isolux
