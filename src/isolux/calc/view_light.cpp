#include "isolux/calc/view_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "isolux/sampling/sobol.h"
#include "isolux/transport/next_event.h"

namespace isolux {

namespace {

/// Luminaires above this share of a surface's direct light are looked at every time, others in
/// proportion, METHODS eq. (89).
constexpr double always_looked_at = 0.04;

/// In previews no luminaire is looked at more often than this; the pixels of a block take
/// turns.
constexpr double always_looked_at_in_preview = 0.08;
constexpr double largest_chance_in_preview = 0.125;
constexpr double least_chance = 0.05;

/// A mirrored surface that makes up this much of the picture has all luminaires looked at.
constexpr double strongly_mirrored = 0.3;

} // namespace

/// Looks at up to packet_size luminaires at once. @return what is visible of each
std::array<double, packet_size> PixelLight::look_at(const SeenSurface& seen,
                                                    std::span<const Look> looks) {
    const RandomStream stream(setup_.settings.seed, StreamPurpose::direct, replicate_);
    std::array<double, packet_size> visible{};
    std::array<LightAim, packet_size> aims;
    std::array<SightSegment, packet_size> sights;
    std::array<float, packet_size> passed{};
    std::uint32_t wanted = 0;
    arrived_ = {};
    for (std::size_t k = 0; k < looks.size(); ++k) {
        visible[k] = looks[k].expected;
        if (is_left_out(stream, looks[k]))
            continue;
        aims[k] = aim_at(looks[k], seen, stream.words(setup_.number(pixel_), looks[k].block));
        sights[k] = aims[k].sight;
        wanted |= aims[k].share > 0.0 ? 1U << k : 0U;
    }
    if (wanted == 0)
        return visible;
    setup_.scene.caster.transmittance16(
        std::span(sights).first(looks.size()), wanted, std::span(passed).first(looks.size()));
    rays_ += static_cast<std::uint64_t>(std::popcount(wanted));
    for (std::size_t k = 0; k < looks.size(); ++k) {
        const double surprise = static_cast<double>(passed[k]) - looks[k].expected;
        if ((wanted >> k & 1U) == 0 || (surprise == 0.0 && setup_.settings.is_preview))
            continue; // previews have no use for what arrived
        const double weight = setup_.light.weight(aims[k]) / looks[k].chance;
        arrived_[k] = static_cast<double>(passed[k]) * weight / looks[k].unshadowed;
        if (surprise != 0.0)
            visible[k] += surprise * weight / looks[k].unshadowed;
    }
    return visible;
}

LightAim PixelLight::aim_at(const Look& look,
                            const SeenSurface& seen,
                            const std::array<std::uint32_t, 4>& words) const {
    return setup_.light.aim(look.luminaire,
                            seen.at,
                            seen.normal,
                            sobol_owen(unit_, 0, words[0]),
                            sobol_owen(unit_, 1, words[1]),
                            setup_.settings.is_preview ? OpeningDraw::area
                                                       : OpeningDraw::solid_angle);
}

/// By chance; in previews a block draws one number, and its pixels take it a quarter apart.
bool PixelLight::is_left_out(const RandomStream& stream, const Look& look) {
    if (look.chance >= 1.0)
        return false;
    if (!setup_.settings.is_preview)
        return sobol_owen(unit_, 2, stream.words(setup_.number(pixel_), look.block)[2])
               >= look.chance;
    const double corner =
        0.25 * static_cast<double>((column_ & 1U) + 2U * ((row_ ^ column_) & 1U));
    const std::uint64_t block = setup_.number(probed_) + (std::uint64_t{unit_} << 40U);
    const std::uint32_t dimension = look.block + 0x20000U;
    if (turns_of_ != dimension / 4) {
        turns_of_ = dimension / 4;
        turns_ = stream.uniform4(block, turns_of_);
    }
    const double u = turns_[dimension % 4] + corner;
    return u - std::floor(u) >= look.chance;
}

/// Share of the pilot's shadow rays that reached a luminaire of its own layer.
double PixelLight::expected_of(const LightLayer& layer) const noexcept {
    const std::size_t at = probed_;
    if (layer.slope_min[at] < 0.0F)
        return 1.0;
    const double n =
        std::max(1.0,
                 std::round(static_cast<double>(buffers_.geometry.coverage[at])
                            * static_cast<double>(pilot_sight_lines(setup_.settings))));
    const double occluded = static_cast<double>(layer.occluded[at]) * (n + 1.0) - 0.5;
    return std::clamp(std::round(n - occluded) / n, 0.0, 1.0);
}

/// The pilot's place does not stand for all that the pixel shows of its surfaces.
bool PixelLight::is_wide_footprint() const noexcept {
    return !setup_.settings.is_preview
           && (setup_.camera.has_lens() || buffers_.geometry.coverage[pixel_] < 1.0F);
}

double PixelLight::chance_of(double e, double total) const noexcept {
    return setup_.settings.is_preview
               ? std::clamp(e / (always_looked_at_in_preview * total),
                            least_chance,
                            largest_chance_in_preview)
               : std::clamp(e / (always_looked_at * total), least_chance, 1.0);
}

Rgb PixelLight::in_layers(const SeenSurface& seen, Shown shown, Rgb& faint) {
    visible_.fill(1.0);
    const std::size_t layers = buffers_.lights.size();
    const auto unshadowed = [&](std::size_t k) {
        const LightLayer& layer = buffers_.lights[k];
        return static_cast<double>(shown == Shown::first ? layer.unshadowed_first[pixel_]
                                                         : layer.unshadowed_second[pixel_]);
    };
    double total = 0.0;
    for (std::size_t k = 0; k < layers; ++k)
        total += unshadowed(k);
    const bool is_wide = is_wide_footprint();
    std::array<Look, packet_size> looks;
    std::array<std::size_t, packet_size> layer_of{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < setup_.single.size(); ++k) {
        const double e = unshadowed(k);
        if (!(e > 0.0))
            continue;
        layer_of[count] = k;
        looks[count++] = {setup_.single[k],
                          e,
                          is_wide ? 1.0 : chance_of(e, total),
                          shown == Shown::first ? expected_of(buffers_.lights[k]) : 1.0,
                          static_cast<std::uint32_t>(k)};
    }
    if (!setup_.merged.empty()) {
        const std::size_t last = layers - 1;
        const double e = unshadowed(last);
        if (e > 0.0) {
            layer_of[count] = last;
            looks[count++] = merged_look(seen, e);
        }
    }
    const std::size_t own = count;
    const double of_faint = faint_look(seen, shown, looks, count);
    const auto found = look_at(seen, std::span(looks).first(count));
    Rgb sum;
    for (std::size_t i = 0; i < own; ++i) {
        const std::size_t k = layer_of[i];
        visible_[k] = found[i];
        sum += (unshadowed(k) * (is_wide ? arrived_[i] : found[i])) * buffers_.lights[k].colour;
    }
    if (count > own)
        faint = (of_faint * found[own]) * setup_.emission.colour(looks[own].luminaire);
    return sum;
}

/// One of the faint luminaires stands for all. @return how much it and all would send, were
/// they like it
double PixelLight::faint_look(const SeenSurface& seen,
                              Shown shown,
                              std::array<Look, packet_size>& looks,
                              std::size_t& count) const {
    const std::uint32_t both = pilot_.faint[pixel_];
    std::uint32_t mask = shown == Shown::first ? both & 0xffffU : both >> 16U;
    if (mask == 0)
        return 0.0;
    const int members = std::popcount(mask);
    const RandomStream stream(setup_.settings.seed, StreamPurpose::direct, replicate_);
    const auto words = stream.words(setup_.number(pixel_), 0xfffff2U);
    auto pick = static_cast<int>(sobol_owen(unit_, 2, words[2]) * members);
    for (; pick > 0; --pick)
        mask &= mask - 1U;
    const auto k = static_cast<std::size_t>(std::countr_zero(mask));
    const std::size_t l = setup_.single[k];
    const double e = setup_.light.unshadowed(l, seen.at, seen.normal, setup_.detail);
    if (!(e > 0.0))
        return 0.0;
    looks[count++] = {l, e, 1.0, 1.0, static_cast<std::uint32_t>(k)};
    return e * members;
}

/// One of the merged luminaires stands for all, drawn by what it would send.
PixelLight::Look PixelLight::merged_look(const SeenSurface& seen, double e) const {
    thread_local std::vector<double> running;
    running.clear();
    double total = 0.0;
    for (const std::size_t l : setup_.merged) {
        // Never nothing: an opening may look over the horizon that its centre is below.
        const Luminaire& luminaire = setup_.emission.luminaire(l);
        const double d2 =
            length_squared(seen.at - luminaire.placement.world_from_luminaire.origin);
        const double least = 1e-3 * in_lumen(luminaire.flux) / (d2 + 1.0);
        total += std::max(
            least, setup_.light.unshadowed(l, seen.at, seen.normal, OpeningDetail::coarse));
        running.push_back(total);
    }
    const RandomStream stream(setup_.settings.seed, StreamPurpose::direct, replicate_);
    const auto words = stream.words(setup_.number(pixel_), 0xfffff1U);
    const double u = sobol_owen(unit_, 3, words[3]) * total;
    const auto it = std::upper_bound(running.begin(), running.end(), u);
    const auto m = static_cast<std::size_t>(std::min<std::ptrdiff_t>(
        it - running.begin(), static_cast<std::ptrdiff_t>(running.size()) - 1));
    const double share = (running[m] - (m > 0 ? running[m - 1] : 0.0)) / total;
    // Its light is divided by the chance of having drawn it.
    return {setup_.merged[m], e * std::max(share, 1e-12), 1.0, 1.0, 0xfffff3U};
}

Rgb PixelLight::on(const SeenSurface& seen) {
    const std::size_t n = setup_.light.luminaires();
    thread_local std::vector<double> e;
    e.resize(n);
    double total = 0.0;
    for (std::size_t l = 0; l < n; ++l) {
        e[l] = setup_.light.unshadowed(l, seen.at, seen.normal, setup_.detail);
        total += e[l];
    }
    Rgb sum;
    std::array<Look, packet_size> looks;
    std::size_t count = 0;
    const auto settle = [&] {
        const auto found = look_at(seen, std::span(looks).first(count));
        for (std::size_t i = 0; i < count; ++i)
            sum +=
                (looks[i].unshadowed * found[i]) * setup_.emission.colour(looks[i].luminaire);
        count = 0;
    };
    for (std::size_t l = 0; l < n; ++l) {
        if (!(e[l] > 0.0))
            continue;
        looks[count++] = {
            l, e[l], chance_of(e[l], total), 1.0, static_cast<std::uint32_t>(l) + 0x10000U};
        if (count == packet_size)
            settle();
    }
    settle();
    return sum;
}

Rgb PixelLight::elsewhere(const SeenSurface& seen, NumberSequence& numbers) {
    if (seen.throughput >= strongly_mirrored)
        return on(seen);
    const double u_luminaire = numbers.next();
    const double u = numbers.next();
    const double v = numbers.next();
    ++rays_;
    return estimate_next_event(
               setup_.scene, setup_.emission, seen.at, seen.normal, u_luminaire, u, v)
        .illuminance;
}

Rgb PixelLight::mirrored(const SeenSurface& seen) {
    if (setup_.images.chains().empty())
        return {};
    const RandomStream stream(setup_.settings.seed, StreamPurpose::direct, replicate_);
    const auto w = stream.words(setup_.number(pixel_), 0xfffff0U);
    double u = sobol_owen(unit_, 0, w[0]);
    double weight = 1.0;
    if (setup_.settings.is_preview && !setup_.mirrored.is_strong()) {
        constexpr double asked = 0.0625;
        if (u >= asked)
            return {};
        u /= asked;
        weight = 1.0 / asked;
    }
    return weight
           * setup_.mirrored.estimate(seen.at,
                                      seen.normal,
                                      {u,
                                       sobol_owen(unit_, 1, w[1]),
                                       sobol_owen(unit_, 2, w[2]),
                                       sobol_owen(unit_, 3, w[3])},
                                      rays_);
}

} // namespace isolux
