#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "isolux/calc/view_render.h"
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
constexpr double largest_chance_in_preview = 0.5;
constexpr double least_chance = 0.05;

/// A mirrored surface that makes up this much of the picture has all luminaires looked at.
constexpr double strongly_mirrored = 0.3;

/// Numbers of surfaces beside the primary one: below any pixel's.
constexpr std::uint64_t further_surface = 1ULL << 40U;

enum class Where { first, second, elsewhere };

float narrow(double v) noexcept { return static_cast<float>(v); }

void add(Planes3& planes, std::size_t pixel, const Rgb& c) noexcept {
    planes.x[pixel] += narrow(c.r);
    planes.y[pixel] += narrow(c.g);
    planes.z[pixel] += narrow(c.b);
}

bool is_finite(const Rgb& c) noexcept { return std::isfinite(c.r + c.g + c.b); }

/// Reflected light that previews find once for the pixels of a block that show one surface.
struct SharedLight {
    std::uint32_t object = 0; ///< 0: nothing found yet
    UnitVector3 normal;
    Rgb reflected; ///< lx

    [[nodiscard]] bool is_for(std::uint32_t other, const UnitVector3& n) const noexcept {
        return object != 0 && object == other && dot(normal, n) >= same_normal;
    }
};

/// No room for another block of passes.
bool is_full(std::uint16_t passes) noexcept {
    constexpr std::uint32_t most = 65535;
    return passes / picture_replicates * picture_replicates + picture_replicates > most;
}

/// One ray through one pixel.
class PixelSample {
public:
    PixelSample(const ViewSetup& setup,
                std::uint32_t pass,
                const VertexCache& cache,
                const PilotPlanes& pilot,
                PixelBuffers& buffers,
                PictureSums& sums,
                SharedLight* shared,
                std::size_t column,
                std::size_t row)
        : setup_(setup), cache_(cache), pilot_(pilot), buffers_(buffers), sums_(sums),
          shared_(shared), column_(column), row_(row),
          pixel_(row * setup.size.columns + column),
          probed_(setup.settings.is_preview ? (row & ~std::size_t{1}) * setup.size.columns
                                                  + (column & ~std::size_t{1})
                                            : pixel_),
          replicate_(pass % picture_replicates),
          unit_(sums.passes[pixel_] / picture_replicates), is_a_(replicate_ % 2 == 0) {}

    void take() {
        thread_local EyePath path;
        const PointRandomness random(
            setup_.settings.seed, StreamPurpose::selection, replicate_, pixel_);
        NumberSequence numbers(random, unit_);
        const double u = numbers.next();
        const double v = numbers.next();
        const double lens_u = numbers.next();
        const double lens_v = numbers.next();
        const auto line = setup_.camera.sight_line(
            static_cast<double>(column_) + u, static_cast<double>(row_) + v, lens_u, lens_v);
        ++sums_.passes[pixel_];
        if (!line)
            return;
        follow_eye(setup_.scene, setup_.emission, *line, numbers, path, rays_);
        const SeenSurface* primary = primary_of(path);
        Rgb emission = path.luminaires;
        Rgb direct;
        Rgb indirect;
        Rgb rest = emission; // what no filter touches

        for (std::size_t s = 0; s < path.surfaces.size(); ++s) {
            const SeenSurface& seen = path.surfaces[s];
            add(sums_.albedo, pixel_, seen.throughput * seen.diffuse);
            if (&seen == primary)
                continue;
            const Rgb d = luminance_of(seen, light_elsewhere(seen, numbers));
            const Rgb i = luminance_of(
                seen, reflected(seen, ReflectedBy::mis, pixel_ + (s + 1) * further_surface));
            direct += d;
            indirect += i;
            rest += d + i;
        }
        if (primary != nullptr)
            add_primary(*primary, direct, indirect, rest);
        const Rgb all = emission + direct + indirect;
        if (!is_finite(all) || !is_finite(rest))
            return; // a degenerate sample counts as nothing
        add(sums_.raw, pixel_, all);
        add(sums_.direct, pixel_, direct);
        add(sums_.emission, pixel_, emission);
        sums_.replicate[replicate_][pixel_] += narrow(luminance_sum(all));
        add(is_a_ ? buffers_.remainder_a : buffers_.remainder_b, pixel_, rest);
    }

private:
    void add_primary(const SeenSurface& seen, Rgb& direct, Rgb& indirect, Rgb& rest) {
        const Where where = where_is(seen);
        const Rgb e_reflected = reflected_on(seen, where);
        Rgb faint;
        const Rgb e_direct =
            where == Where::elsewhere ? light_on(seen) : light_in_layers(seen, where, faint);
        const Rgb mirrored = mirrored_light(seen);
        if (!is_finite(e_reflected + e_direct + faint + mirrored))
            return;
        direct += luminance_of(seen, e_direct + faint + mirrored);
        indirect += luminance_of(seen, e_reflected);
        if (where == Where::elsewhere) {
            rest += luminance_of(seen, e_direct + mirrored + e_reflected);
            return;
        }
        // Faint luminaires, and what panes mirror, are smoothed with the reflected light; what
        // mirrors do is not.
        Rgb smooth = e_reflected + faint;
        if (setup_.mirrored.is_strong())
            rest += luminance_of(seen, mirrored);
        else
            smooth += mirrored;
        PixelGeometry& g = buffers_.geometry;
        constexpr double inverse_pi = 0.318309886183790671538;
        PixelSurface& surface = where == Where::first ? g.first : g.second;
        add(is_a_ ? surface.reflected_a : surface.reflected_b,
            pixel_,
            (seen.throughput * inverse_pi) * seen.diffuse);
        if (where != Where::first)
            return;
        (is_a_ ? g.samples_a : g.samples_b)[pixel_] += 1.0F;
        add(is_a_ ? buffers_.indirect.a : buffers_.indirect.b, pixel_, smooth);
        for (std::size_t k = 0; k < visible_.size(); ++k) {
            LightLayer& layer = buffers_.lights[k];
            (is_a_ ? layer.visible_a : layer.visible_b)[pixel_] += narrow(visible_[k]);
        }
        sums_.illuminance[pixel_] +=
            narrow(luminance_sum(e_direct + faint + mirrored + e_reflected));
    }

    /// Reflected light on the primary surface.
    [[nodiscard]] Rgb reflected_on(const SeenSurface& seen, Where where) {
        const std::uint32_t object = object_of(setup_.scene, seen);
        if (shared_ != nullptr && shared_->is_for(object, seen.normal))
            return shared_->reflected;
        // Through a lens a pixel sees far more of the surface than the pilot's place.
        const bool is_near_edge =
            where == Where::first && !setup_.camera.has_lens()
                ? pilot_.is_near_edge[probed_] != 0
                : setup_.estimator.choose(seen, setup_.edge) == ReflectedBy::path_tracing;
        const Rgb e = reflected(
            seen, is_near_edge ? ReflectedBy::path_tracing : ReflectedBy::mis, pixel_);
        if (shared_ != nullptr && is_finite(e))
            *shared_ = {object, seen.normal, e};
        return e;
    }

    /// Straight light that comes by imaged mirrors; previews ask every fourth ray.
    [[nodiscard]] Rgb mirrored_light(const SeenSurface& seen) {
        if (setup_.images.chains().empty())
            return {};
        const RandomStream stream(setup_.settings.seed, StreamPurpose::direct, replicate_);
        const auto w = stream.words(pixel_, 0xfffff0U);
        double u = sobol_owen(unit_, 0, w[0]);
        double weight = 1.0;
        if (setup_.settings.is_preview && !setup_.mirrored.is_strong()) {
            constexpr double asked = 0.25;
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

    [[nodiscard]] Where where_is(const SeenSurface& seen) const noexcept {
        const std::uint32_t object = object_of(setup_.scene, seen);
        const PixelGeometry& g = buffers_.geometry;
        const auto is_on = [&](const PixelSurface& surface) {
            return surface.object[pixel_] == object
                   && dot(surface.normal.vector(pixel_), seen.normal) >= same_normal;
        };
        if (is_on(g.first)
            && is_level(seen.normal, seen.at - (g.origin + g.position.vector(pixel_))))
            return Where::first;
        return is_on(g.second) ? Where::second : Where::elsewhere;
    }

    [[nodiscard]] Rgb reflected(const SeenSurface& seen, ReflectedBy by, std::uint64_t place) {
        if (setup_.emission.total_flux() <= 0.0 || setup_.settings.direct_only)
            return {};
        return setup_.estimator.reflected(seen,
                                          by,
                                          cache_,
                                          setup_.counts,
                                          setup_.settings.is_preview ? effort_of_a_preview
                                                                     : effort_of_a_sample,
                                          {setup_.settings.seed, replicate_, unit_, place},
                                          rays_);
    }

    /// One luminaire to be looked at: what is wanted is the share of it that is visible,
    /// METHODS eq. (89).
    struct Look {
        std::size_t luminaire = 0;
        double unshadowed = 0.0; ///< lx
        double chance = 1.0;     ///< of looking at all
        double expected = 1.0;   ///< what the pilot found; it steers only
        std::uint32_t block = 0; ///< of the random numbers
    };

    /// Looks at up to packet_size luminaires at once. @return what is visible of each
    std::array<double, packet_size> look_at(const SeenSurface& seen,
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
            const auto words = stream.words(pixel_, looks[k].block);
            aims[k] = setup_.light.aim(looks[k].luminaire,
                                       seen.at,
                                       seen.normal,
                                       sobol_owen(unit_, 0, words[0]),
                                       sobol_owen(unit_, 1, words[1]));
            sights[k] = aims[k].sight;
            wanted |= aims[k].share > 0.0 ? 1U << k : 0U;
        }
        if (wanted == 0)
            return visible;
        setup_.scene.caster.transmittance16(std::span(sights).first(looks.size()),
                                            wanted,
                                            std::span(passed).first(looks.size()));
        rays_ += static_cast<std::uint64_t>(std::popcount(wanted));
        for (std::size_t k = 0; k < looks.size(); ++k) {
            if ((wanted >> k & 1U) == 0)
                continue;
            const double weight = setup_.light.weight(aims[k]) / looks[k].chance;
            arrived_[k] = static_cast<double>(passed[k]) * weight;
            const double surprise = static_cast<double>(passed[k]) - looks[k].expected;
            if (surprise != 0.0)
                visible[k] += surprise * weight / looks[k].unshadowed;
        }
        return visible;
    }

    /// By chance; in previews a block draws one number, and its pixels take it a quarter apart.
    [[nodiscard]] bool is_left_out(const RandomStream& stream, const Look& look) const {
        if (look.chance >= 1.0)
            return false;
        if (!setup_.settings.is_preview)
            return sobol_owen(unit_, 2, stream.words(pixel_, look.block)[2]) >= look.chance;
        const double corner =
            0.25 * static_cast<double>((column_ & 1U) + 2U * ((row_ ^ column_) & 1U));
        const std::uint64_t block = probed_ + (std::uint64_t{unit_} << 40U);
        const double u = stream.uniform(block, look.block + 0x20000U) + corner;
        return u - std::floor(u) >= look.chance;
    }

    /// Share of the pilot's shadow rays that reached a luminaire of its own layer.
    [[nodiscard]] double expected_of(const LightLayer& layer) const noexcept {
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
    [[nodiscard]] bool is_wide_footprint() const noexcept {
        return !setup_.settings.is_preview
               && (setup_.camera.has_lens() || buffers_.geometry.coverage[pixel_] < 1.0F);
    }

    [[nodiscard]] double chance_of(double e, double total) const noexcept {
        return setup_.settings.is_preview
                   ? std::clamp(e / (always_looked_at_in_preview * total),
                                least_chance,
                                largest_chance_in_preview)
                   : std::clamp(e / (always_looked_at * total), least_chance, 1.0);
    }

    /// Direct light on one of the pixel's two surfaces; keeps what is visible of each layer.
    /// @param faint  takes the light of the luminaires that have no shadow of their own here
    Rgb light_in_layers(const SeenSurface& seen, Where where, Rgb& faint) {
        visible_.assign(buffers_.lights.size(), 1.0);
        const auto unshadowed = [&](std::size_t k) {
            const LightLayer& layer = buffers_.lights[k];
            return static_cast<double>(where == Where::first ? layer.unshadowed_first[pixel_]
                                                             : layer.unshadowed_second[pixel_]);
        };
        double total = 0.0;
        for (std::size_t k = 0; k < visible_.size(); ++k)
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
                              where == Where::first ? expected_of(buffers_.lights[k]) : 1.0,
                              static_cast<std::uint32_t>(k)};
        }
        if (!setup_.merged.empty()) {
            const std::size_t last = visible_.size() - 1;
            const double e = unshadowed(last);
            if (e > 0.0) {
                layer_of[count] = last;
                looks[count++] = merged_look(seen, e);
            }
        }
        const std::size_t own = count;
        const double of_faint = faint_look(seen, where, looks, count);
        const auto found = look_at(seen, std::span(looks).first(count));
        Rgb sum;
        for (std::size_t i = 0; i < own; ++i) {
            const std::size_t k = layer_of[i];
            visible_[k] = found[i];
            sum +=
                (is_wide ? arrived_[i] : unshadowed(k) * found[i]) * buffers_.lights[k].colour;
        }
        if (count > own)
            faint = (of_faint * found[own]) * setup_.emission.colour(looks[own].luminaire);
        return sum;
    }

    /// One of the faint luminaires stands for all. @return how much it and all would send, were
    /// they like it
    double faint_look(const SeenSurface& seen,
                      Where where,
                      std::array<Look, packet_size>& looks,
                      std::size_t& count) const {
        const std::uint32_t both = pilot_.faint[pixel_];
        std::uint32_t mask = where == Where::first ? both & 0xffffU : both >> 16U;
        if (mask == 0)
            return 0.0;
        const int members = std::popcount(mask);
        const RandomStream stream(setup_.settings.seed, StreamPurpose::direct, replicate_);
        const auto words = stream.words(pixel_, 0xfffff2U);
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
    [[nodiscard]] Look merged_look(const SeenSurface& seen, double e) const {
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
        const auto words = stream.words(pixel_, 0xfffff1U);
        const double u = sobol_owen(unit_, 3, words[3]) * total;
        const auto it = std::upper_bound(running.begin(), running.end(), u);
        const auto m = static_cast<std::size_t>(std::min<std::ptrdiff_t>(
            it - running.begin(), static_cast<std::ptrdiff_t>(running.size()) - 1));
        const double share = (running[m] - (m > 0 ? running[m - 1] : 0.0)) / total;
        // Its light is divided by the chance of having drawn it.
        return {setup_.merged[m], e * std::max(share, 1e-12), 1.0, 1.0, 0xfffff3U};
    }

    /// Direct light on a surface that is none of the pixel's two: every luminaire.
    Rgb light_on(const SeenSurface& seen) {
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
                sum += (looks[i].unshadowed * found[i])
                       * setup_.emission.colour(looks[i].luminaire);
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

    /// Direct light on a surface in a mirror or behind a second pane: every luminaire if it
    /// matters, one of them if it is faint.
    Rgb light_elsewhere(const SeenSurface& seen, NumberSequence& numbers) {
        if (seen.throughput >= strongly_mirrored)
            return light_on(seen);
        const double u_luminaire = numbers.next();
        const double u = numbers.next();
        const double v = numbers.next();
        ++rays_;
        return estimate_next_event(
                   setup_.scene, setup_.emission, seen.at, seen.normal, u_luminaire, u, v)
            .illuminance;
    }

    const ViewSetup& setup_;
    const VertexCache& cache_;
    const PilotPlanes& pilot_;
    PixelBuffers& buffers_;
    PictureSums& sums_;
    SharedLight* shared_;
    std::size_t column_, row_, pixel_;
    /// Previews probe every fourth pixel: the neighbour's finding steers as well.
    std::size_t probed_;
    std::uint32_t replicate_, unit_;
    bool is_a_;
    std::vector<double> visible_;
    std::array<double, packet_size> arrived_{}; ///< lx of each look, nothing expected
    std::uint64_t rays_ = 0;
};

} // namespace

void add_samples(const ViewSetup& setup,
                 std::uint32_t pass,
                 const SamplePlan& plan,
                 std::size_t block,
                 std::span<const VertexCache> caches,
                 std::size_t first_column,
                 std::size_t first_row,
                 const PilotPlanes& pilot,
                 PixelBuffers& buffers,
                 PictureSums& sums) {
    const std::size_t a = setup.slices_a_side;
    const std::size_t end_row = std::min(setup.size.rows, first_row + tile_side);
    const std::size_t end_column = std::min(setup.size.columns, first_column + tile_side);
    const std::size_t turn = 37U * std::size_t{pass} + pass / picture_replicates;
    const auto sample = [&](std::size_t column, std::size_t row, SharedLight* shared) {
        const std::size_t pixel = row * setup.size.columns + column;
        if (!plan.takes(pixel, block) || is_full(sums.passes[pixel]))
            return;
        // Neighbours have different slices, and every pixel another one in every pass.
        const std::size_t slice = (column % a + a * (row % a) + turn) % (a * a);
        PixelSample(setup, pass, caches[slice], pilot, buffers, sums, shared, column, row)
            .take();
    };
    if (!setup.settings.is_preview) {
        for (std::size_t row = first_row; row < end_row; ++row)
            for (std::size_t column = first_column; column < end_column; ++column)
                sample(column, row, nullptr);
        return;
    }
    // Blocks of two by two; every pass begins at another pixel of them.
    for (std::size_t row = first_row; row < end_row; row += 2)
        for (std::size_t column = first_column; column < end_column; column += 2) {
            SharedLight shared;
            for (std::uint32_t k = 0; k < 4; ++k) {
                const std::uint32_t corner = k ^ (3U * (pass % 2)) ^ (pass / 2 % 2);
                const std::size_t x = column + (corner & 1U);
                const std::size_t y = row + (corner >> 1U);
                if (x < end_column && y < end_row)
                    sample(x, y, &shared);
            }
        }
}

} // namespace isolux
