#include <algorithm>
#include <array>
#include <cmath>

#include "isolux/calc/view_render.h"
#include "isolux/sampling/sobol.h"
#include "isolux/transport/next_event.h"

namespace isolux {

namespace {

/// Luminaires above this share of a surface's direct light are looked at every time, others in
/// proportion, METHODS eq. (89).
constexpr double always_looked_at = 0.04;
constexpr double always_in_preview = 0.12;
constexpr double least_chance = 0.05;

/// A mirrored surface that makes up this much of the picture has all luminaires looked at.
constexpr double strongly_mirrored = 0.3;

constexpr SeenEffort effort_of_a_sample{4, 1, 1};

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

/// One ray through one pixel.
class PixelSample {
public:
    PixelSample(const ViewSetup& setup,
                std::uint32_t pass,
                const VertexCache& cache,
                const PilotPlanes& pilot,
                PixelBuffers& buffers,
                PictureSums& sums,
                std::size_t column,
                std::size_t row)
        : setup_(setup), cache_(cache), pilot_(pilot), buffers_(buffers), sums_(sums),
          column_(column), row_(row), pixel_(row * setup.size.columns + column),
          replicate_(pass % picture_replicates), unit_(pass / picture_replicates),
          is_a_(replicate_ % 2 == 0) {}

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
        const bool is_near_edge =
            where == Where::first
                ? pilot_.is_near_edge[pixel_] != 0
                : setup_.estimator.choose(seen, setup_.edge) == ReflectedBy::path_tracing;
        Rgb e_indirect = reflected(
            seen, is_near_edge ? ReflectedBy::path_tracing : ReflectedBy::mis, pixel_);
        const Rgb e_direct =
            where == Where::elsewhere ? light_on(seen, {}) : light_in_layers(seen, where);
        Rgb mirrored;
        if (!setup_.images.chains().empty()) {
            const RandomStream stream(setup_.settings.seed, StreamPurpose::direct, replicate_);
            const auto w = stream.words(pixel_, 0xfffff0U);
            mirrored = setup_.mirrored.estimate(seen.at,
                                                seen.normal,
                                                {sobol_owen(unit_, 0, w[0]),
                                                 sobol_owen(unit_, 1, w[1]),
                                                 sobol_owen(unit_, 2, w[2]),
                                                 sobol_owen(unit_, 3, w[3])},
                                                rays_);
        }
        if (!is_finite(e_indirect + e_direct + mirrored))
            return;
        direct += luminance_of(seen, e_direct + mirrored);
        indirect += luminance_of(seen, e_indirect);
        if (where == Where::elsewhere) {
            rest += luminance_of(seen, e_direct + mirrored + e_indirect);
            return;
        }
        // What panes mirror is faint and soft enough to be smoothed with the reflected light;
        // what mirrors do is not.
        if (setup_.mirrored.is_strong())
            rest += luminance_of(seen, mirrored);
        else
            e_indirect += mirrored;
        PixelGeometry& g = buffers_.geometry;
        constexpr double inverse_pi = 0.318309886183790671538;
        PixelSurface& surface = where == Where::first ? g.first : g.second;
        add(is_a_ ? surface.reflected_a : surface.reflected_b,
            pixel_,
            (seen.throughput * inverse_pi) * seen.diffuse);
        if (where != Where::first)
            return;
        (is_a_ ? g.samples_a : g.samples_b)[pixel_] += 1.0F;
        add(is_a_ ? buffers_.indirect.a : buffers_.indirect.b, pixel_, e_indirect);
        for (std::size_t k = 0; k < visible_.size(); ++k) {
            LightLayer& layer = buffers_.lights[k];
            (is_a_ ? layer.visible_a : layer.visible_b)[pixel_] += narrow(visible_[k]);
        }
        sums_.illuminance[pixel_] +=
            narrow(luminance_sum(e_direct + mirrored + e_indirect)
                   - (setup_.mirrored.is_strong() ? 0.0 : luminance_sum(mirrored)));
    }

    [[nodiscard]] Where where_is(const SeenSurface& seen) const noexcept {
        const std::uint32_t object = object_of(setup_.scene, seen);
        const PixelGeometry& g = buffers_.geometry;
        const auto is_on = [&](const PixelSurface& surface) {
            return surface.object[pixel_] == object
                   && dot(surface.normal.vector(pixel_), seen.normal) >= same_normal;
        };
        if (is_on(g.first))
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
                                          effort_of_a_sample,
                                          {setup_.settings.seed, replicate_, unit_, place},
                                          rays_);
    }

    /// What share of luminaire `l` a look finds visible, METHODS eq. (89).
    /// @param e         its unshadowed light
    /// @param chance    of looking at all
    /// @param expected  what the pilot found; it steers only
    [[nodiscard]] double visible(const SeenSurface& seen,
                                 std::size_t l,
                                 double e,
                                 double chance,
                                 double expected,
                                 std::uint32_t stream_block) {
        const RandomStream stream(setup_.settings.seed, StreamPurpose::direct, replicate_);
        const auto words = stream.words(pixel_, stream_block);
        if (chance < 1.0 && sobol_owen(unit_, 2, words[2]) >= chance)
            return expected;
        const LookResult look = setup_.light.look(l,
                                                  seen.at,
                                                  seen.normal,
                                                  sobol_owen(unit_, 0, words[0]),
                                                  sobol_owen(unit_, 1, words[1]),
                                                  expected,
                                                  rays_);
        return expected + (look.visible - expected) * look.weight / (e * chance);
    }

    /// Share of the pilot's shadow rays that reached a luminaire of its own layer.
    [[nodiscard]] double expected_of(const LightLayer& layer) const noexcept {
        if (layer.slope_min[pixel_] < 0.0F)
            return 1.0;
        const double n = std::round(static_cast<double>(buffers_.geometry.coverage[pixel_])
                                    * static_cast<double>(pilot_sight_lines(setup_.settings)));
        const double occluded = static_cast<double>(layer.occluded[pixel_]) * (n + 1.0) - 0.5;
        return std::clamp(std::round(n - occluded) / n, 0.0, 1.0);
    }

    [[nodiscard]] double chance_of(double e, double total) const noexcept {
        const double always = setup_.settings.is_preview ? always_in_preview : always_looked_at;
        return std::clamp(e / (always * total), least_chance, 1.0);
    }

    /// Direct light on one of the pixel's two surfaces; keeps what is visible of each layer.
    Rgb light_in_layers(const SeenSurface& seen, Where where) {
        visible_.assign(buffers_.lights.size(), 1.0);
        const auto unshadowed = [&](std::size_t k) {
            const LightLayer& layer = buffers_.lights[k];
            return static_cast<double>(where == Where::first ? layer.unshadowed_first[pixel_]
                                                             : layer.unshadowed_second[pixel_]);
        };
        double total = 0.0;
        for (std::size_t k = 0; k < visible_.size(); ++k)
            total += unshadowed(k);
        if (!(total > 0.0))
            return {};
        Rgb sum;
        for (std::size_t k = 0; k < visible_.size(); ++k) {
            const double e = unshadowed(k);
            if (!(e > 0.0))
                continue;
            const auto block = static_cast<std::uint32_t>(k);
            visible_[k] =
                k < setup_.single.size()
                    ? visible(seen,
                              setup_.single[k],
                              e,
                              chance_of(e, total),
                              where == Where::first ? expected_of(buffers_.lights[k]) : 1.0,
                              block)
                    : visible_of_merged(seen, e, block);
            sum += (e * visible_[k]) * buffers_.lights[k].colour;
        }
        return sum;
    }

    /// One of the merged luminaires stands for all, drawn by what it would send.
    [[nodiscard]] double
    visible_of_merged(const SeenSurface& seen, double e, std::uint32_t block) {
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
        if (!(total > 0.0))
            return 1.0;
        const RandomStream stream(setup_.settings.seed, StreamPurpose::direct, replicate_);
        const auto words = stream.words(pixel_, 0xfffff1U);
        const double u = sobol_owen(unit_, 3, words[3]) * total;
        const auto it = std::upper_bound(running.begin(), running.end(), u);
        const auto m = static_cast<std::size_t>(std::min<std::ptrdiff_t>(
            it - running.begin(), static_cast<std::ptrdiff_t>(running.size()) - 1));
        const double share = (running[m] - (m > 0 ? running[m - 1] : 0.0)) / total;
        if (!(share > 0.0))
            return 1.0;
        return visible(seen, setup_.merged[m], e * share, 1.0, 1.0, block);
    }

    /// Direct light on a surface that is none of the pixel's two: every luminaire.
    Rgb light_on(const SeenSurface& seen, std::span<const double>) {
        const std::size_t n = setup_.light.luminaires();
        thread_local std::vector<double> e;
        e.resize(n);
        double total = 0.0;
        for (std::size_t l = 0; l < n; ++l) {
            e[l] = setup_.light.unshadowed(l, seen.at, seen.normal, setup_.detail);
            total += e[l];
        }
        Rgb sum;
        for (std::size_t l = 0; l < n; ++l)
            if (e[l] > 0.0)
                sum += (e[l]
                        * visible(seen,
                                  l,
                                  e[l],
                                  chance_of(e[l], total),
                                  1.0,
                                  static_cast<std::uint32_t>(l) + 0x10000U))
                       * setup_.emission.colour(l);
        return sum;
    }

    /// Direct light on a surface in a mirror or behind a second pane: every luminaire if it
    /// matters, one of them if it is faint.
    Rgb light_elsewhere(const SeenSurface& seen, NumberSequence& numbers) {
        if (seen.throughput >= strongly_mirrored)
            return light_on(seen, {});
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
    std::size_t column_, row_, pixel_;
    std::uint32_t replicate_, unit_;
    bool is_a_;
    std::vector<double> visible_;
    std::uint64_t rays_ = 0;
};

} // namespace

void add_samples(const ViewSetup& setup,
                 std::uint32_t pass,
                 std::span<const VertexCache> caches,
                 std::size_t first_column,
                 std::size_t first_row,
                 const PilotPlanes& pilot,
                 PixelBuffers& buffers,
                 PictureSums& sums) {
    const std::size_t a = setup.slices_a_side;
    const std::size_t end_row = std::min(setup.size.rows, first_row + tile_side);
    const std::size_t end_column = std::min(setup.size.columns, first_column + tile_side);
    for (std::size_t row = first_row; row < end_row; ++row)
        for (std::size_t column = first_column; column < end_column; ++column) {
            // Neighbours have different slices, and every pixel another one in every pass.
            const std::size_t slice =
                (column % a + a * (row % a) + 37U * std::size_t{pass}) % (a * a);
            PixelSample(setup, pass, caches[slice], pilot, buffers, sums, column, row).take();
        }
}

} // namespace isolux
