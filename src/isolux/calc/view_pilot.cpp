#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "isolux/base/parallel.h"
#include "isolux/calc/view_render.h"
#include "isolux/sampling/sobol.h"
#include "isolux/sampling/warp.h"

namespace isolux {

namespace {

constexpr std::size_t most_samples = 4; ///< of the pilot

/// Luminaires that give less than this share of a pixel's direct light are faint there: their
/// shadows are smoothed with the reflected light.
constexpr double least_share = 0.01;
constexpr double least_share_of_preview = 0.05;

/// Directions nearer to the surface than this cosine say nothing (METHODS eq. (95)).
constexpr double most_grazing = 0.22;

/// One pilot ray's surface.
struct PilotSample {
    SeenSurface seen;
    std::uint32_t object = 0;
    double depth_on_axis = 0.0;
    std::size_t cluster = 0;
};

/// Samples on one surface.
struct Cluster {
    std::uint32_t object = 0;
    UnitVector3 first_normal;
    Point3 first_place;
    std::size_t count = 0;
    Vector3 normal;
    Vector3 position;
    double depth = 0.0;
};

class PixelPilot {
public:
    PixelPilot(const ViewSetup& setup, std::size_t column, std::size_t row)
        : setup_(setup), column_(column), row_(row), pixel_(row * setup.size.columns + column),
          random_(setup.settings.seed, StreamPurpose::pilot, 0, pixel_) {}

    void look() {
        const std::size_t wanted = pilot_sight_lines(setup_.settings);
        thread_local EyePath path;
        for (std::uint32_t s = 0; s < wanted; ++s) {
            NumberSequence numbers(random_, s);
            const double u = numbers.next();
            const double v = numbers.next();
            const double lens_u = numbers.next();
            const double lens_v = numbers.next();
            const auto line = setup_.camera.sight_line(static_cast<double>(column_) + u,
                                                       static_cast<double>(row_) + v,
                                                       lens_u,
                                                       lens_v);
            ++asked_;
            if (!line)
                continue;
            follow_eye(setup_.scene, setup_.emission, *line, numbers, path, rays_);
            const SeenSurface* seen = primary_of(path);
            has_more_ = has_more_ || path.surfaces.size() > (seen != nullptr ? 1U : 0U);
            if (seen == nullptr || used_ == samples_.size())
                continue;
            PilotSample& sample = samples_[used_++];
            sample.seen = *seen;
            sample.object = object_of(setup_.scene, *seen);
            sample.depth_on_axis = setup_.camera.depth_of(seen->at);
            sample.cluster = join(sample);
        }
        pick_two();
    }

    void write_geometry(PixelBuffers& buffers) const {
        PixelGeometry& g = buffers.geometry;
        if (clusters_used_ == 0)
            return;
        const auto write = [&](PixelSurface& surface, std::size_t cluster) {
            const Cluster& c = clusters_[cluster];
            surface.object[pixel_] = c.object;
            surface.normal.set(pixel_, Vector3(UnitVector3(c.normal)));
        };
        write(g.first, first_);
        if (second_ < clusters_used_)
            write(g.second, second_);
        const Cluster& c = clusters_[first_];
        const double n = static_cast<double>(c.count);
        g.position.set(pixel_, first_place().at - g.origin);
        g.depth[pixel_] = static_cast<float>(c.depth / n);
        g.coverage[pixel_] = static_cast<float>(n / static_cast<double>(asked_));
        write_steps(g);
        if (!setup_.camera.has_lens())
            return;
        double low = std::numeric_limits<double>::infinity();
        double high = 0.0;
        for (std::size_t s = 0; s < used_; ++s) {
            const double r = std::abs(setup_.camera.lens_shift(samples_[s].depth_on_axis));
            low = std::min(low, r);
            high = std::max(high, r);
        }
        g.lens_shift_min[pixel_] = static_cast<float>(low);
        g.lens_shift_max[pixel_] = static_cast<float>(high);
    }

    void write_lights(PixelBuffers& buffers, PilotPlanes& pilot) {
        if (clusters_used_ == 0)
            return;
        const Place first = first_place();
        std::vector<double>& e = light_on(first);
        const double least = least_of(e);
        std::uint32_t faint = 0;
        for (std::size_t k = 0; k < setup_.single.size(); ++k) {
            if (e[k] <= least) {
                faint |= e[k] > 0.0 ? 1U << k : 0U;
                continue;
            }
            buffers.lights[k].unshadowed_first[pixel_] = static_cast<float>(e[k]);
            if (is_probed())
                probe(setup_.single[k], buffers.lights[k], false);
        }
        if (!setup_.merged.empty()) {
            LightLayer& layer = buffers.lights.back();
            layer.unshadowed_first[pixel_] = static_cast<float>(e.back());
            if (e.back() > least && is_probed())
                probe_merged(first, layer);
        }
        if (second_ < clusters_used_) {
            const std::vector<double>& s = light_on(place_of(second_));
            const double least_second = least_of(s);
            for (std::size_t k = 0; k < s.size(); ++k) {
                const bool is_faint = k < setup_.single.size() && s[k] <= least_second;
                if (is_faint)
                    faint |= s[k] > 0.0 ? 1U << (16U + k) : 0U;
                else
                    buffers.lights[k].unshadowed_second[pixel_] = static_cast<float>(s[k]);
            }
        }
        pilot.faint[pixel_] = faint;
    }

    /// What the plan of samples has to know.
    void write_plan(PilotPlanes& pilot) const {
        pilot.has_more[pixel_] = has_more_ ? 1 : 0;
        constexpr double inverse_pi = 0.318309886183790671538;
        double reflected = 0.0;
        for (std::size_t s = 0; s < used_; ++s)
            if (samples_[s].cluster == first_)
                reflected +=
                    samples_[s].seen.throughput * luminance_sum(samples_[s].seen.diffuse);
        pilot.reflected[pixel_] =
            static_cast<float>(inverse_pi * reflected / static_cast<double>(asked_));
    }

    void write_distances(IndirectLayer& indirect) {
        if (clusters_used_ == 0)
            return;
        // Directions from the samples on the surface, in turn; one from each in previews.
        const std::size_t wanted = pilot_sight_lines(setup_.settings);
        double low = std::numeric_limits<double>::infinity();
        double high = 0.0;
        std::size_t from = 0;
        for (std::size_t d = 0; d < wanted; ++d, ++from) {
            while (samples_[from % used_].cluster != first_)
                ++from;
            const SeenSurface& seen = samples_[from % used_].seen;
            const auto dd = static_cast<std::uint32_t>(d);
            const Vector3 local = sample_cosine_hemisphere(random_(dd, 4), random_(dd, 5));
            if (local.z < most_grazing)
                continue;
            const UnitVector3 w(make_basis(seen.normal).to_world(local));
            const auto hit = setup_.scene.caster.find_first_hit(seen.at, w);
            if (!hit)
                continue;
            low = std::min(low, hit->distance);
            high = std::max(high, hit->distance);
        }
        indirect.z_min[pixel_] = static_cast<float>(low);
        indirect.z_max[pixel_] = static_cast<float>(high);
    }

    [[nodiscard]] bool is_near_edge() const noexcept {
        if (clusters_used_ == 0 || !is_probed())
            return false;
        const Place p = first_place();
        return setup_.scene.caster.find_nearest_surfaces(p.at, setup_.edge).second
               < setup_.edge;
    }

    /// Previews look for occluders and distances in every fourth pixel.
    [[nodiscard]] bool is_probed() const noexcept {
        return !setup_.settings.is_preview || (column_ % 2 == 0 && row_ % 2 == 0);
    }

private:
    struct Place {
        Point3 at;
        UnitVector3 normal;
    };

    [[nodiscard]] double least_of(const std::vector<double>& e) const noexcept {
        double total = 0.0;
        for (const double v : e)
            total += v;
        return total * (setup_.settings.is_preview ? least_share_of_preview : least_share);
    }

    std::size_t join(const PilotSample& s) {
        for (std::size_t c = 0; c < clusters_used_; ++c)
            if (clusters_[c].object == s.object
                && dot(clusters_[c].first_normal, s.seen.normal) >= same_normal
                && is_level(s.seen.normal, s.seen.at - clusters_[c].first_place))
                return add(c, s);
        clusters_[clusters_used_] = {s.object, s.seen.normal, s.seen.at, 0, {}, {}, 0.0};
        return add(clusters_used_++, s);
    }

    std::size_t add(std::size_t c, const PilotSample& s) {
        Cluster& cluster = clusters_[c];
        ++cluster.count;
        cluster.normal = cluster.normal + Vector3(s.seen.normal);
        cluster.position = cluster.position + (s.seen.at - Point3{});
        cluster.depth += s.seen.travelled;
        return c;
    }

    void pick_two() {
        first_ = second_ = clusters_.size();
        for (std::size_t c = 0; c < clusters_used_; ++c)
            if (first_ >= clusters_used_ || clusters_[c].count > clusters_[first_].count)
                first_ = c;
        for (std::size_t c = 0; c < clusters_used_; ++c)
            if (c != first_
                && (second_ >= clusters_used_ || clusters_[c].count > clusters_[second_].count))
                second_ = c;
    }

    [[nodiscard]] Place place_of(std::size_t c) const noexcept {
        const Cluster& cluster = clusters_[c];
        return {Point3{} + cluster.position / static_cast<double>(cluster.count),
                UnitVector3(cluster.normal)};
    }

    /// Where the line of sight through a place of the picture meets the tangent plane.
    [[nodiscard]] std::optional<Point3>
    on_plane(const Place& p, double x, double y) const noexcept {
        const auto line = setup_.camera.sight_line(x, y);
        if (!line)
            return std::nullopt;
        const double slope = dot(p.normal, line->direction);
        const double t = dot(p.normal, p.at - line->eye) / slope;
        if (!(slope < -1e-4) || !(t > 0.0))
            return std::nullopt;
        return line->eye + t * Vector3(line->direction);
    }

    /// The middle of what the pixel shows of its majority surface: where all of it is that
    /// surface, the place its middle looks at, else the mean of the samples.
    [[nodiscard]] Place first_place() const noexcept {
        Place p = place_of(first_);
        if (clusters_[first_].count == asked_ && !setup_.camera.has_lens())
            if (const auto middle = on_plane(
                    p, static_cast<double>(column_) + 0.5, static_cast<double>(row_) + 0.5))
                p.at = *middle;
        return p;
    }

    /// To where the neighbouring pixels look, on the tangent plane.
    void write_steps(PixelGeometry& g) const {
        const Place p = place_of(first_);
        const double x = static_cast<double>(column_) + 0.5;
        const double y = static_cast<double>(row_) + 0.5;
        const auto here = on_plane(p, x, y);
        const auto right = on_plane(p, x + 1.0, y);
        const auto below = on_plane(p, x, y + 1.0);
        if (here && right)
            g.column_step.set(pixel_, *right - *here);
        if (here && below)
            g.row_step.set(pixel_, *below - *here);
    }

    /// Unshadowed illuminance of every layer on a surface; the merged one last.
    std::vector<double>& light_on(const Place& p) {
        thread_local std::vector<double> e;
        e.clear();
        for (const std::size_t l : setup_.single)
            e.push_back(setup_.light.unshadowed(l, p.at, p.normal, setup_.detail));
        if (!setup_.merged.empty()) {
            e.push_back(0.0);
            for (const std::size_t l : setup_.merged)
                e.back() += setup_.light.unshadowed(l, p.at, p.normal, setup_.detail);
        }
        return e;
    }

    /// Shadow rays from the samples on the majority surface.
    void probe(std::size_t l, LightLayer& layer, bool is_merged) {
        const RandomStream stream(setup_.settings.seed, StreamPurpose::pilot, 2);
        const auto words = stream.words(pixel_, static_cast<std::uint32_t>(l));
        std::size_t looks = 0;
        std::size_t occluded = 0;
        double low = std::numeric_limits<double>::infinity();
        double high = -1.0;
        std::array<LightAim, most_samples> aims;
        std::array<SightSegment, most_samples> sights;
        std::array<float, most_samples> visible{};
        std::array<std::size_t, most_samples> owner{};
        std::uint32_t wanted = 0;
        for (std::size_t s = 0; s < used_; ++s) {
            if (samples_[s].cluster != first_)
                continue;
            const auto index = static_cast<std::uint32_t>(looks);
            aims[looks] = setup_.light.aim(l,
                                           samples_[s].seen.at,
                                           samples_[s].seen.normal,
                                           sobol_owen(index, 0, words[0]),
                                           sobol_owen(index, 1, words[1]));
            sights[looks] = aims[looks].sight;
            wanted |= aims[looks].share > 0.0 ? 1U << looks : 0U;
            owner[looks++] = s;
        }
        if (wanted != 0)
            setup_.scene.caster.transmittance16(
                std::span(sights).first(looks), wanted, std::span(visible).first(looks));
        for (std::size_t k = 0; k < looks; ++k) {
            if ((wanted >> k & 1U) == 0 || visible[k] > 0.0F)
                continue;
            const OccluderSlopes slopes =
                setup_.light.find_occluders(aims[k], samples_[owner[k]].seen.at, rays_);
            ++occluded;
            low = std::min(low, slopes.nearest_surface);
            high = std::max(high, slopes.nearest_light);
        }
        if (!is_merged)
            layer.occluded[pixel_] = static_cast<float>((static_cast<double>(occluded) + 0.5)
                                                        / (static_cast<double>(looks) + 1.0));
        if (occluded == 0)
            return;
        const auto smallest = static_cast<float>(low);
        float& slope_min = layer.slope_min[pixel_];
        slope_min = slope_min < 0.0F ? smallest : std::min(slope_min, smallest);
        layer.slope_max[pixel_] = std::max(layer.slope_max[pixel_], static_cast<float>(high));
    }

    /// The narrowest penumbra of the merged luminaires that matter here.
    void probe_merged(const Place& p, LightLayer& layer) {
        float narrowest = 0.0F;
        const double least = least_share * static_cast<double>(layer.unshadowed_first[pixel_]);
        for (const std::size_t l : setup_.merged) {
            if (setup_.light.unshadowed(l, p.at, p.normal, OpeningDetail::coarse) < least)
                continue;
            layer.slope_min[pixel_] = layer.slope_max[pixel_] = -1.0F;
            probe(l, layer, true);
            const float slope = layer.slope_min[pixel_];
            if (slope < 0.0F)
                continue;
            // METHODS eq. (94)
            const double k_mu = setup_.settings.is_preview ? 3.0 : 6.0;
            const auto width =
                static_cast<float>(setup_.emission.luminaire(l).opening.largest_dimension
                                   / std::sqrt(12.0) * static_cast<double>(slope) / k_mu);
            narrowest = narrowest > 0.0F ? std::min(narrowest, width) : width;
        }
        layer.slope_min[pixel_] = layer.slope_max[pixel_] = -1.0F;
        layer.merged_width[pixel_] = narrowest;
    }

    const ViewSetup& setup_;
    std::size_t column_, row_, pixel_;
    PointRandomness random_;
    std::uint64_t rays_ = 0;
    std::array<PilotSample, most_samples> samples_;
    std::array<Cluster, most_samples> clusters_;
    std::size_t used_ = 0;
    std::size_t asked_ = 0;
    bool has_more_ = false;
    std::size_t clusters_used_ = 0;
    std::size_t first_ = most_samples;
    std::size_t second_ = most_samples;
};

} // namespace

void run_pilot(const ViewSetup& setup,
               std::size_t first_row,
               std::size_t end_row,
               PixelBuffers& buffers,
               PilotPlanes& pilot) {
    for_each_index(end_row - first_row, 1, [&](std::size_t r) {
        const std::size_t row = first_row + r;
        for (std::size_t column = 0; column < setup.size.columns; ++column) {
            PixelPilot p(setup, column, row);
            p.look();
            p.write_geometry(buffers);
            p.write_lights(buffers, pilot);
            p.write_plan(pilot);
            if (p.is_probed())
                p.write_distances(buffers.indirect);
            pilot.is_near_edge[row * setup.size.columns + column] = p.is_near_edge() ? 1 : 0;
        }
    });
}

} // namespace isolux
