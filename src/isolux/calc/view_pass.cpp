#include <algorithm>
#include <array>
#include <cmath>

#include "isolux/calc/view_light.h"
#include "isolux/calc/view_render.h"

namespace isolux {

namespace {

/// Numbers of surfaces beside the primary one: below any pixel's.
constexpr std::uint64_t further_surface = 1ULL << 40U;

float narrow(double v) noexcept { return static_cast<float>(v); }

void add_to(Planes3& planes, std::size_t pixel, const Rgb& c) noexcept {
    planes.x[pixel] += narrow(c.r);
    planes.y[pixel] += narrow(c.g);
    planes.z[pixel] += narrow(c.b);
}

bool is_finite(const Rgb& c) noexcept { return std::isfinite(c.r + c.g + c.b); }

/// Side of the blocks of pixels that share what is traced in previews.
constexpr std::size_t traced_side = 4;

/// Reflected light that previews find once for the pixels of a block that show one surface.
struct SharedLight {
    struct Found {
        std::uint32_t object = 0; ///< 0: nothing found yet
        UnitVector3 normal;
        Rgb reflected; ///< lx
    };

    /// The last two surfaces of a block: along an edge they take turns.
    struct Surfaces {
        std::array<Found, 2> found;
        std::size_t next = 0;

        [[nodiscard]] const Found* find(std::uint32_t object,
                                        const UnitVector3& normal) const noexcept {
            for (const Found& f : found)
                if (f.object == object && dot(f.normal, normal) >= same_normal)
                    return &f;
            return nullptr;
        }

        void keep(const Found& f) noexcept {
            found[next] = f;
            next = 1 - next;
        }
    };

    Surfaces traced; ///< next to edges, for blocks of four by four
    Surfaces local;  ///< elsewhere, for blocks of four by two
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
                const EyePath* seen,
                std::size_t column,
                std::size_t row)
        : setup_(setup), cache_(cache), pilot_(pilot), buffers_(buffers), sums_(sums),
          shared_(shared), seen_(seen), column_(column), row_(row),
          pixel_(row * setup.size.columns + column), replicate_(pass % picture_replicates),
          unit_(sums.passes[pixel_] / picture_replicates), is_a_(replicate_ % 2 == 0),
          light_(setup, pilot, buffers, column, row, replicate_, unit_) {}

    void take() {
        ++sums_.passes[pixel_];
        const PointRandomness random(
            setup_.settings.seed, StreamPurpose::selection, replicate_, setup_.number(pixel_));
        NumberSequence numbers(random, unit_);
        if (seen_ != nullptr) {
            add(*seen_, numbers);
            return;
        }
        const auto line = sight_line_of(setup_, column_, row_, numbers);
        if (!line)
            return;
        thread_local EyePath path;
        follow_eye(setup_.scene, setup_.emission, *line, numbers, path, rays_);
        add(path, numbers);
    }

private:
    void add(const EyePath& path, NumberSequence& numbers) {
        const SeenSurface* primary = primary_of(path);
        Rgb emission = path.luminaires;
        Rgb direct;
        Rgb indirect;
        Rgb rest = emission; // what no filter touches

        for (std::size_t s = 0; s < path.surfaces.size(); ++s) {
            const SeenSurface& seen = path.surfaces[s];
            add_to(sums_.albedo, pixel_, seen.throughput * seen.diffuse);
            if (&seen == primary)
                continue;
            const Rgb d = luminance_of(seen, light_.elsewhere(seen, numbers));
            const Rgb i = luminance_of(
                seen,
                reflected(
                    seen, ReflectedBy::mis, setup_.number(pixel_) + (s + 1) * further_surface));
            direct += d;
            indirect += i;
            rest += d + i;
        }
        if (primary != nullptr)
            add_primary(*primary, direct, indirect, rest);
        const Rgb all = emission + direct + indirect;
        if (!is_finite(all) || !is_finite(rest))
            return; // a degenerate sample counts as nothing
        add_to(sums_.raw, pixel_, all);
        add_to(sums_.direct, pixel_, direct);
        add_to(sums_.emission, pixel_, emission);
        sums_.replicate[replicate_][pixel_] += narrow(luminance_sum(all));
        add_to(is_a_ ? buffers_.remainder_a : buffers_.remainder_b, pixel_, rest);
    }

    void add_primary(const SeenSurface& seen, Rgb& direct, Rgb& indirect, Rgb& rest) {
        const Shown shown = what_shows(seen);
        const Rgb e_reflected = reflected_on(seen, shown);
        Rgb faint;
        const Rgb e_direct =
            shown == Shown::elsewhere ? light_.on(seen) : light_.in_layers(seen, shown, faint);
        const Rgb mirrored = light_.mirrored(seen);
        if (!is_finite(e_reflected + e_direct + faint + mirrored))
            return;
        direct += luminance_of(seen, e_direct + faint + mirrored);
        indirect += luminance_of(seen, e_reflected);
        if (shown == Shown::elsewhere) {
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
        PixelSurface& surface = shown == Shown::first ? g.first : g.second;
        add_to(is_a_ ? surface.reflected_a : surface.reflected_b,
               pixel_,
               (seen.throughput * inverse_pi) * seen.diffuse);
        if (shown != Shown::first)
            return;
        (is_a_ ? g.samples_a : g.samples_b)[pixel_] += 1.0F;
        add_to(is_a_ ? buffers_.indirect.a : buffers_.indirect.b, pixel_, smooth);
        for (std::size_t k = 0; k < light_.visible().size(); ++k) {
            LightLayer& layer = buffers_.lights[k];
            if (!(layer.unshadowed_first[pixel_] > 0.0F))
                continue; // nothing to see: 1, whatever the samples
            (is_a_ ? layer.visible_a : layer.visible_b)[pixel_] += narrow(light_.visible()[k]);
        }
        sums_.illuminance[pixel_] +=
            narrow(luminance_sum(e_direct + faint + mirrored + e_reflected));
    }

    /// Reflected light on the primary surface.
    [[nodiscard]] Rgb reflected_on(const SeenSurface& seen, Shown shown) {
        // Through a lens a pixel sees far more of the surface than the pilot's place.
        const bool is_near_edge =
            shown == Shown::first && !setup_.camera.has_lens()
                ? pilot_.is_near_edge[light_.probed()] != 0
                : setup_.estimator.choose(seen, setup_.edge) == ReflectedBy::path_tracing;
        const ReflectedBy by = is_near_edge ? ReflectedBy::path_tracing : ReflectedBy::mis;
        if (shared_ == nullptr)
            return reflected(seen, by, setup_.number(pixel_));
        const std::uint32_t object = object_of(setup_.scene, seen);
        SharedLight::Surfaces& surfaces = is_near_edge ? shared_->traced : shared_->local;
        if (const SharedLight::Found* found = surfaces.find(object, seen.normal))
            return found->reflected;
        const Rgb e = reflected(seen, by, setup_.number(pixel_));
        if (is_finite(e))
            surfaces.keep({object, seen.normal, e});
        return e;
    }

    [[nodiscard]] Shown what_shows(const SeenSurface& seen) const noexcept {
        const std::uint32_t object = object_of(setup_.scene, seen);
        const PixelGeometry& g = buffers_.geometry;
        const auto is_on = [&](const PixelSurface& surface) {
            return surface.object[pixel_] == object
                   && dot(surface.normal.vector(pixel_), seen.normal) >= same_normal;
        };
        if (is_on(g.first)
            && is_level(seen.normal, seen.at - (g.origin + g.position.vector(pixel_))))
            return Shown::first;
        return is_on(g.second) ? Shown::second : Shown::elsewhere;
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

    const ViewSetup& setup_;
    const VertexCache& cache_;
    const PilotPlanes& pilot_;
    PixelBuffers& buffers_;
    PictureSums& sums_;
    SharedLight* shared_;
    const EyePath* seen_;
    std::size_t column_, row_, pixel_;
    std::uint32_t replicate_, unit_;
    bool is_a_;
    PixelLight light_;
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
                 PictureSums& sums,
                 const SeenTile* seen) {
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
        const EyePath* path =
            seen != nullptr ? &seen->paths[seen->index(column, row, pass)] : nullptr;
        PixelSample(setup, pass, caches[slice], pilot, buffers, sums, shared, path, column, row)
            .take();
    };
    if (!setup.settings.is_preview) {
        for (std::size_t row = first_row; row < end_row; ++row)
            for (std::size_t column = first_column; column < end_column; ++column)
                sample(column, row, nullptr);
        return;
    }
    // Blocks that share reflected light; every pass begins at another pixel of them.
    constexpr std::size_t pixels = traced_side * traced_side;
    for (std::size_t row = first_row; row < end_row; row += traced_side)
        for (std::size_t column = first_column; column < end_column; column += traced_side) {
            SharedLight shared;
            for (std::size_t k = 0; k < pixels; ++k) {
                // Four by two within four by four: the bits of k are x, y, x, y.
                const std::size_t turned = k ^ (pass * 7U % pixels);
                const std::size_t x = column + (turned & 1U) + (turned >> 1U & 2U);
                const std::size_t y = row + (turned >> 1U & 1U) + (turned >> 2U & 2U);
                if (k % 8 == 0)
                    shared.local = {};
                if (x < end_column && y < end_row)
                    sample(x, y, &shared);
            }
        }
}

} // namespace isolux
