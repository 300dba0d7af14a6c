#include <algorithm>
#include <cmath>

#include "isolux/base/parallel.h"
#include "isolux/calc/view_render.h"
#include "isolux/filter/sample_counts.h"

namespace isolux {

namespace {

constexpr std::uint32_t probe_replicate = 0xfffffbU;

/// Reflected light is tried out in one pixel of so many by so many.
constexpr std::size_t probe_spacing = 4;
constexpr std::uint32_t tries = 4;

/// Counts lie between the mean over this and the mean times this.
constexpr double direct_spread = 8.0;
constexpr double reflected_spread = 2.0;

/// p (1-p) of what is merged, for want of looks at each, METHODS eq. (132).
constexpr float merged_variance = 0.25F;

/// What the pilot expects a pixel to show, and how much samples will differ there.
class CountPlanner {
public:
    CountPlanner(const ViewSetup& setup, const PilotPlanes& pilot, PixelBuffers& buffers)
        : setup_(setup), pilot_(pilot), buffers_(buffers),
          illuminance_(setup.size.pixels(), 0.0F) {}

    /// METHODS eq. (133).
    SamplePlan plan(double mean) {
        pretend_samples(1.0F);
        FilterSettings filter = picture_filter();
        filter.samples = mean;
        add_shadows(filter);
        add_reflected(filter);
        pretend_samples(0.0F);
        to_luminance();
        add_luminaires();
        // The few tries of reflected light know little of rare bright samples: counts stay
        // within half and twice the mean.
        const double spread = is_direct_only() ? direct_spread : reflected_spread;
        const double step = picture_replicates;
        const double least = step * std::max(1.0, std::round(mean / spread / step));
        const double most = step * std::round(mean * spread / step);
        const auto counts = [&](double budget) {
            std::vector<std::uint16_t> n = counts_for_budget(need_,
                                                             illuminance_,
                                                             budget,
                                                             static_cast<std::uint16_t>(least),
                                                             static_cast<std::uint16_t>(most),
                                                             picture_replicates);
            // Nor do they know how little the filter leaves of it, and nothing of what edges
            // need: these get the mean at least.
            const auto of_edge = static_cast<std::uint16_t>(step * std::floor(mean / step));
            if (!is_direct_only())
                for (std::size_t i = 0; i < n.size(); ++i)
                    if (need_.edge[i])
                        n[i] = std::max(n[i], of_edge);
            return n;
        };
        // What edges get beyond the budget is taken from all.
        const double over = std::max(0.0, mean_of(counts(mean)) - mean);
        return to_blocks(counts(std::max(least, mean - over)));
    }

private:
    static double mean_of(const std::vector<std::uint16_t>& counts) {
        double sum = 0.0;
        for (const std::uint16_t n : counts)
            sum += n;
        return sum / static_cast<double>(counts.size());
    }

    /// The filter's sites are pixels with samples in both halves: all that show a surface.
    void pretend_samples(float count) {
        PixelGeometry& g = buffers_.geometry;
        for (std::size_t i = 0; i < setup_.size.pixels(); ++i)
            g.samples_a[i] = g.samples_b[i] = g.first.object[i] != 0 ? count : 0.0F;
    }

    [[nodiscard]] bool is_direct_only() const noexcept {
        return setup_.emission.total_flux() <= 0.0 || setup_.settings.direct_only;
    }

    void add_shadows(const FilterSettings& filter) {
        for (const LightLayer& light : buffers_.lights) {
            const FilterSites sites =
                make_shadow_sites(buffers_.geometry, setup_.size, light, filter);
            SampleNeed need = shadow_need(buffers_.geometry, light, sites);
            for (std::size_t i = 0; i < need.variance.size(); ++i) {
                const float e = light.unshadowed_first[i];
                if (light.merged)
                    need.variance[i] = merged_variance * e * e;
                illuminance_[i] += need.settled[i] ? e : e * (1.0F - light.occluded[i]);
            }
            add(std::move(need));
        }
    }

    void add_reflected(const FilterSettings& filter) {
        if (is_direct_only())
            return;
        probe_reflected();
        const FilterSites sites =
            make_indirect_sites(buffers_.geometry, setup_.size, buffers_.indirect, filter);
        add(indirect_need(buffers_.geometry, buffers_.indirect, sites));
    }

    /// A tolerance is one of the raw picture: then the filter counts for nothing.
    void add(SampleNeed need) {
        if (setup_.settings.tolerance)
            need.left.assign(need.left.size(), 1.0F);
        add_need(need_, need);
    }

    /// Reflected light and its variance, found in one pixel for all of a square that show the
    /// same object.
    void probe_reflected() {
        Plane& variance = buffers_.indirect.variance;
        std::fill(variance.begin(), variance.end(), -1.0F);
        const std::vector<VertexCache> caches = build_caches(setup_, probe_replicate, 0);
        const std::size_t across = (setup_.size.columns + probe_spacing - 1) / probe_spacing;
        const std::size_t down = (setup_.size.rows + probe_spacing - 1) / probe_spacing;
        for_each_index(across * down, 16, [&](std::size_t b) {
            probe_square(caches, b % across * probe_spacing, b / across * probe_spacing, b);
        });
    }

    void probe_square(const std::vector<VertexCache>& caches,
                      std::size_t column,
                      std::size_t row,
                      std::size_t number) {
        thread_local EyePath path;
        std::uint64_t rays = 0;
        const std::size_t x = std::min(setup_.size.columns - 1, column + probe_spacing / 2);
        const std::size_t y = std::min(setup_.size.rows - 1, row + probe_spacing / 2);
        const std::size_t pixel = y * setup_.size.columns + x;
        const auto line = setup_.camera.sight_line(
            static_cast<double>(x) + 0.5, static_cast<double>(setup_.first_row + y) + 0.5);
        if (!line)
            return;
        const PointRandomness random(setup_.settings.seed,
                                     StreamPurpose::selection,
                                     probe_replicate,
                                     setup_.number(pixel));
        NumberSequence numbers(random, 0);
        follow_eye(setup_.scene, setup_.emission, *line, numbers, path, rays);
        const SeenSurface* seen = primary_of(path);
        if (seen == nullptr)
            return;
        const ReflectedBy by = setup_.estimator.choose(*seen, setup_.edge);
        double sum = 0.0;
        double squares = 0.0;
        for (std::uint32_t k = 0; k < tries; ++k) {
            const VertexCache& cache = caches[(number + 5U * k) % caches.size()];
            const double e = luminance_sum(setup_.estimator.reflected(
                *seen,
                by,
                cache,
                setup_.counts,
                effort_of_a_sample,
                {setup_.settings.seed, probe_replicate, k, setup_.number(pixel)},
                rays));
            if (!std::isfinite(e))
                return;
            sum += e;
            squares += e * e;
        }
        const double mean = sum / tries;
        const double variance = std::max(0.0, (squares - sum * mean) / (tries - 1));
        const std::uint32_t object = object_of(setup_.scene, *seen);
        const std::size_t end_column = std::min(setup_.size.columns, column + probe_spacing);
        const std::size_t end_row = std::min(setup_.size.rows, row + probe_spacing);
        for (std::size_t v = row; v < end_row; ++v)
            for (std::size_t u = column; u < end_column; ++u) {
                const std::size_t i = v * setup_.size.columns + u;
                if (buffers_.geometry.first.object[i] != object)
                    continue;
                buffers_.indirect.variance[i] = static_cast<float>(variance);
                illuminance_[i] += static_cast<float>(mean);
            }
    }

    /// From illuminances to luminances; where unfiltered light is seen, samples are needed,
    /// too.
    void to_luminance() {
        for (std::size_t i = 0; i < illuminance_.size(); ++i) {
            const float k = pilot_.reflected[i];
            illuminance_[i] *= k;
            need_.variance[i] *= k * k;
            if (pilot_.has_more[i] != 0)
                need_.edge[i] = true;
        }
    }

    /// Next to a luminaire a sample is as wrong as the pixel is bright.
    void add_luminaires() {
        double mean = 0.0;
        for (const float v : illuminance_)
            mean += static_cast<double>(v) / static_cast<double>(illuminance_.size());
        const auto dark = static_cast<float>(0.1 * mean);
        for (std::size_t i = 0; i < illuminance_.size(); ++i) {
            if (!is_at_rim(i))
                continue;
            const float v = illuminance_[i];
            need_.edge[i] = true;
            need_.settled[i] = false;
            need_.variance[i] = std::max(need_.variance[i], v * v + dark * dark);
        }
    }

    /// Its neighbours show more or less of luminaires than it does; the surfaces behind may be
    /// one.
    [[nodiscard]] bool is_at_rim(std::size_t pixel) const noexcept {
        const std::size_t x = pixel % setup_.size.columns;
        const std::size_t y = pixel / setup_.size.columns;
        for (std::size_t v = y - std::min<std::size_t>(y, 1);
             v < std::min(setup_.size.rows, y + 2);
             ++v)
            for (std::size_t u = x - std::min<std::size_t>(x, 1);
                 u < std::min(setup_.size.columns, x + 2);
                 ++u)
                if (pilot_.has_luminaire[v * setup_.size.columns + u]
                    != pilot_.has_luminaire[pixel])
                    return true;
        return false;
    }

    [[nodiscard]] SamplePlan to_blocks(const std::vector<std::uint16_t>& counts) const {
        SamplePlan plan;
        plan.blocks.resize(counts.size());
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const std::size_t n = counts[i] / picture_replicates;
            plan.blocks[i] = static_cast<std::uint8_t>(n);
            if (plan.active.size() < n)
                plan.active.resize(n, 0);
            for (std::size_t b = 0; b < n; ++b)
                ++plan.active[b];
        }
        return plan;
    }

    const ViewSetup& setup_;
    const PilotPlanes& pilot_;
    PixelBuffers& buffers_;
    Plane illuminance_;
    SampleNeed need_;
};

} // namespace

SamplePlan plan_samples(const ViewSetup& setup,
                        const PilotPlanes& pilot,
                        PixelBuffers& buffers,
                        double mean) {
    return CountPlanner(setup, pilot, buffers).plan(mean);
}

} // namespace isolux
