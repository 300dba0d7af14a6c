#include "isolux/filter/layer_filter.h"

#include <array>
#include <utility>

#include "isolux/base/parallel.h"
#include "isolux/filter/verify.h"

namespace isolux {
namespace {

constexpr std::size_t grain = 4096;

Plane mean_of(const Halves& halves) {
    Plane mean(halves.a.size());
    for_each_index(mean.size(), grain, [&](std::size_t i) {
        mean[i] = 0.5F * (halves.a[i] + halves.b[i]);
    });
    return mean;
}

/// The candidates, mixed by the shares of the choice.
Plane mixed(const WidthChoice& choice, const Halves& raw, const std::array<Halves, 4>& ladder) {
    Plane mean(raw.a.size());
    for_each_index(mean.size(), grain, [&](std::size_t i) {
        float sum = choice.share[0][i] * (raw.a[i] + raw.b[i]);
        for (std::size_t k = 0; k < ladder.size(); ++k)
            sum += choice.share[k + 1][i] * (ladder[k].a[i] + ladder[k].b[i]);
        mean[i] = 0.5F * sum;
    });
    return mean;
}

Plane luminance(const Planes3& planes) {
    Plane y(planes.x.size());
    for_each_index(y.size(), grain, [&](std::size_t i) {
        y[i] = static_cast<float>(luminance_sum(planes.colour(i)));
    });
    return y;
}

bool is_grey(const Planes3& planes) { return planes.x == planes.y && planes.y == planes.z; }

Planes3 mean_of(const Planes3& a, const Planes3& b) {
    return {mean_of(Halves{a.x, b.x}), mean_of(Halves{a.y, b.y}), mean_of(Halves{a.z, b.z})};
}

void mix(const Plane& share, const Plane& raw, Plane& filtered) {
    for_each_index(raw.size(), grain, [&](std::size_t i) {
        filtered[i] += share[i] * (raw[i] - filtered[i]);
    });
}

} // namespace

FilteredLayer filter_layer(const FilterSites& sites,
                           const Halves& raw,
                           const FilterSettings& settings,
                           bool indirect) {
    FilteredLayer layer;
    if (!settings.choose_width) {
        layer.fixed = filter_halves(sites, raw, settings.radius);
        layer.mean = mean_of(layer.fixed);
        layer.scale.assign(raw.a.size(), 1.0F);
        return layer;
    }
    std::array<Halves, 4> ladder = filter_ladder(sites, raw, settings.radius);
    WidthChoice choice = choose_widths(sites, raw, ladder, window_side(settings, indirect));
    layer.mean = mixed(choice, raw, ladder);
    layer.fixed = std::move(ladder[1]);
    layer.scale = std::move(choice.scale);
    for_each_index(layer.scale.size(), grain, [&](std::size_t i) {
        layer.scale[i] *= 1.0F - choice.share[0][i];
    });
    return layer;
}

FilteredIndirect filter_indirect(const FilterSites& sites,
                                 const IndirectLayer& indirect,
                                 const FilterSettings& settings) {
    FilteredIndirect out;
    out.raw = {luminance(indirect.a), luminance(indirect.b)};
    if (is_grey(indirect.a) && is_grey(indirect.b)) {
        FilteredLayer layer = filter_layer(sites, out.raw, settings, true);
        out.colour = {layer.mean, layer.mean, layer.mean};
        out.fixed = std::move(layer.fixed);
        out.scale = std::move(layer.scale);
        return out;
    }
    const Planes3 mean = mean_of(indirect.a, indirect.b);
    if (!settings.choose_width) {
        out.fixed = filter_halves(sites, out.raw, settings.radius);
        out.colour = filter_colours(sites, mean, settings.radius);
        out.scale.assign(out.raw.a.size(), 1.0F);
        return out;
    }
    std::array<Halves, 4> ladder = filter_ladder(sites, out.raw, settings.radius);
    WidthChoice choice = choose_widths(sites, out.raw, ladder, window_side(settings, true));
    out.colour = filter_colours(sites, mean, settings.radius, &choice.scale);
    mix(choice.share[0], mean.x, out.colour.x);
    mix(choice.share[0], mean.y, out.colour.y);
    mix(choice.share[0], mean.z, out.colour.z);
    out.fixed = std::move(ladder[1]);
    out.scale = std::move(choice.scale);
    return out;
}

} // namespace isolux
