#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "isolux/calc/view_look.h"
#include "isolux/calc/view_render.h"
#include "isolux/sampling/sobol.h"
#include "isolux/sampling/warp.h"

namespace isolux {

namespace {

/// Luminaires that give less than this share of a pixel's direct light are faint there: their
/// shadows are smoothed with the reflected light.
constexpr double least_share = 0.01;
constexpr double least_share_of_preview = 0.05;

/// Directions nearer to the surface than this cosine say nothing (METHODS eq. (95)).
constexpr double most_grazing = 0.22;

class PixelPilot {
public:
    PixelPilot(const ViewSetup& setup,
               std::size_t column,
               std::size_t row,
               std::span<const PilotRay> rays,
               SeenTile* seen)
        : setup_(setup), look_(setup, column, row, seen),
          is_probed_(!setup.settings.is_preview || (column % 2 == 0 && row % 2 == 0)),
          pixel_(look_.pixel()) {
        look_.look(rays);
    }

    void write(PixelBuffers& buffers, PilotPlanes& pilot) {
        look_.write_geometry(buffers);
        look_.write_plan(pilot);
        if (look_.is_empty())
            return;
        write_lights(buffers, pilot);
        if (!is_probed_)
            return;
        write_distances(buffers.indirect);
        pilot.is_near_edge[pixel_] = is_near_edge() ? 1 : 0;
    }

private:
    void write_lights(PixelBuffers& buffers, PilotPlanes& pilot) {
        const SeenPlace first = look_.first_place();
        std::uint32_t faint = faint_in_block(buffers, pilot, first);
        const std::vector<double>& e = light_on(first, faint);
        const double least = least_of(e);
        for (std::size_t k = 0; k < setup_.single.size(); ++k) {
            if (e[k] <= least) {
                faint |= e[k] > 0.0 ? 1U << k : 0U;
                continue;
            }
            buffers.lights[k].unshadowed_first[pixel_] = static_cast<float>(e[k]);
            if (is_probed_)
                probe(setup_.single[k], buffers.lights[k], false);
        }
        if (!setup_.merged.empty()) {
            LightLayer& layer = buffers.lights.back();
            layer.unshadowed_first[pixel_] = static_cast<float>(e.back());
            if (e.back() > least && is_probed_)
                probe_merged(first, layer);
        }
        if (look_.has_second()) {
            const std::vector<double>& s = light_on(look_.second_place(), 0);
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

    void write_distances(IndirectLayer& indirect) {
        // Directions from the samples on the surface, in turn; one from each in previews.
        const auto places = look_.on_first();
        const std::size_t wanted = pilot_sight_lines(setup_.settings);
        double low = std::numeric_limits<double>::infinity();
        for (std::size_t d = 0; d < wanted; ++d) {
            const SeenSurface& seen = places[d % places.size()];
            const auto dd = static_cast<std::uint32_t>(d);
            const Vector3 local =
                sample_cosine_hemisphere(look_.random()(dd, 4), look_.random()(dd, 5));
            if (local.z < most_grazing)
                continue;
            const UnitVector3 w(make_basis(seen.normal).to_world(local));
            const auto hit = setup_.scene.caster.find_first_hit(seen.at, w);
            if (!hit)
                continue;
            low = std::min(low, hit->distance);
        }
        indirect.z_min[pixel_] = static_cast<float>(low);
    }

    [[nodiscard]] bool is_near_edge() const noexcept {
        const SeenPlace p = look_.first_place();
        return setup_.scene.caster.find_nearest_surfaces(p.at, setup_.edge).second
               < setup_.edge;
    }

    [[nodiscard]] double least_of(const std::vector<double>& e) const noexcept {
        double total = 0.0;
        for (const double v : e)
            total += v;
        return total * (setup_.settings.is_preview ? least_share_of_preview : least_share);
    }

    /// Luminaires that are known to be faint here: those that are so in the block's probed
    /// pixel, where it shows the same surface.
    [[nodiscard]] std::uint32_t faint_in_block(const PixelBuffers& buffers,
                                               const PilotPlanes& pilot,
                                               const SeenPlace& p) const noexcept {
        const PixelSurface& first = buffers.geometry.first;
        const std::size_t probed = setup_.probed_by(look_.pixel());
        const bool is_same = probed != pixel_ && first.object[probed] == first.object[pixel_]
                             && dot(first.normal.vector(probed), p.normal) >= same_normal;
        return is_same ? pilot.faint[probed] & 0xffffU : 0U;
    }

    /// Unshadowed illuminance of every layer on a surface, 0 of those whose bit is set in
    /// `left_out`; the merged one last.
    const std::vector<double>& light_on(const SeenPlace& p, std::uint32_t left_out) {
        thread_local std::vector<double> e;
        e.clear();
        for (std::size_t k = 0; k < setup_.single.size(); ++k)
            e.push_back(
                (left_out >> k & 1U) != 0
                    ? 0.0
                    : setup_.light.unshadowed(setup_.single[k], p.at, p.normal, setup_.detail));
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
        const auto words = stream.words(setup_.number(pixel_), static_cast<std::uint32_t>(l));
        std::size_t looks = 0;
        std::size_t occluded = 0;
        double low = std::numeric_limits<double>::infinity();
        std::array<LightAim, most_pilot_samples> aims;
        std::array<SightSegment, most_pilot_samples> sights;
        std::array<float, most_pilot_samples> visible{};
        std::array<Point3, most_pilot_samples> places;
        std::uint32_t wanted = 0;
        for (const SeenSurface& seen : look_.on_first()) {
            const auto index = static_cast<std::uint32_t>(looks);
            aims[looks] = setup_.light.aim(l,
                                           seen.at,
                                           seen.normal,
                                           sobol_owen(index, 0, words[0]),
                                           sobol_owen(index, 1, words[1]));
            sights[looks] = aims[looks].sight;
            wanted |= aims[looks].share > 0.0 ? 1U << looks : 0U;
            places[looks++] = seen.at;
        }
        if (wanted != 0)
            setup_.scene.caster.transmittance16(
                std::span(sights).first(looks), wanted, std::span(visible).first(looks));
        for (std::size_t k = 0; k < looks; ++k) {
            if ((wanted >> k & 1U) == 0 || visible[k] > 0.0F)
                continue;
            ++occluded;
            low = std::min(low, setup_.light.occluder_slope(aims[k], places[k], rays_));
        }
        if (!is_merged)
            layer.occluded[pixel_] = static_cast<float>((static_cast<double>(occluded) + 0.5)
                                                        / (static_cast<double>(looks) + 1.0));
        if (occluded == 0)
            return;
        const auto smallest = static_cast<float>(low);
        float& slope_min = layer.slope_min[pixel_];
        slope_min = slope_min < 0.0F ? smallest : std::min(slope_min, smallest);
    }

    /// The narrowest penumbra of the merged luminaires that matter here.
    void probe_merged(const SeenPlace& p, LightLayer& layer) {
        float narrowest = 0.0F;
        const double least = least_share * static_cast<double>(layer.unshadowed_first[pixel_]);
        for (const std::size_t l : setup_.merged) {
            if (setup_.light.unshadowed(l, p.at, p.normal, OpeningDetail::coarse) < least)
                continue;
            layer.slope_min[pixel_] = -1.0F;
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
        layer.slope_min[pixel_] = -1.0F;
        layer.merged_width[pixel_] = narrowest;
    }

    const ViewSetup& setup_;
    PilotLook look_;
    bool is_probed_;
    std::size_t pixel_;
    std::uint64_t rays_ = 0;
};

} // namespace

void run_pilot(const ViewSetup& setup,
               std::size_t first_column,
               std::size_t first_row,
               PixelBuffers& buffers,
               PilotPlanes& pilot,
               SeenTile* seen) {
    if (seen != nullptr) {
        *seen = {first_column, first_row, std::move(seen->paths)};
        seen->paths.resize(tile_side * tile_side * rays_of_preview);
    }
    const std::size_t end_row = std::min(setup.size.rows, first_row + tile_side);
    const std::size_t end_column = std::min(setup.size.columns, first_column + tile_side);
    // By blocks of two by two, the pixel that previews probe first.
    for (std::size_t row = first_row; row < end_row; row += 2)
        for (std::size_t column = first_column; column < end_column; column += 2) {
            const BlockRays rays(setup, column, row);
            for (std::size_t y = row; y < std::min(row + 2, end_row); ++y)
                for (std::size_t x = column; x < std::min(column + 2, end_column); ++x)
                    PixelPilot(setup, x, y, rays.of(x - column, y - row), seen)
                        .write(buffers, pilot);
        }
}

} // namespace isolux
