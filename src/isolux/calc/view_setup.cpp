#include <algorithm>
#include <cmath>
#include <numeric>

#include "isolux/base/parallel.h"
#include "isolux/calc/view_render.h"

namespace isolux {

namespace {

constexpr std::size_t pilot_paths = 512;
constexpr std::uint32_t pilot_replicate = 0xfffffcU;

/// METHODS 11.3, with the paths of all slices: neighbouring pixels see them all.
constexpr double edge_factor = 0.4;
constexpr double widest_edge = 0.5; ///< m

/// Layers of luminaires' own: fewer in large pictures, for their memory.
constexpr std::size_t most_layers_if_large = 8;
constexpr std::size_t large_picture = 2'000'000; ///< pixels

/// Rays that find out which luminaires matter, across and down.
constexpr std::size_t survey_side = 24;

/// What each luminaire would send to what one ray shows, as it is reflected.
std::vector<double>
light_on_ray(const ViewSetup& setup, double x, double y, std::size_t number) {
    std::vector<double> light(setup.light.luminaires(), 0.0);
    const auto line = setup.camera.sight_line(x, y);
    if (!line)
        return light;
    thread_local EyePath path;
    std::uint64_t rays = 0;
    const PointRandomness random(setup.settings.seed, StreamPurpose::pilot, 1, number);
    NumberSequence numbers(random, 0);
    follow_eye(setup.scene, setup.emission, *line, numbers, path, rays);
    const SeenSurface* seen = primary_of(path);
    for (std::size_t l = 0; seen != nullptr && l < light.size(); ++l)
        light[l] = luminance_sum(seen->diffuse)
                   * setup.light.unshadowed(l, seen->at, seen->normal, OpeningDetail::coarse);
    return light;
}

/// Luminaires by the light they send to what the view shows, brightest first.
std::vector<std::size_t> rank_luminaires(const ViewSetup& setup) {
    const std::size_t count = setup.light.luminaires();
    std::vector<std::vector<double>> found(survey_side * survey_side);
    for_each_index(found.size(), survey_side, [&](std::size_t k) {
        const auto share = [](std::size_t i) {
            return (static_cast<double>(i) + 0.5) / static_cast<double>(survey_side);
        };
        found[k] =
            light_on_ray(setup,
                         share(k % survey_side) * static_cast<double>(setup.size.columns),
                         share(k / survey_side) * static_cast<double>(setup.whole.rows),
                         k);
    });
    std::vector<double> sums(count, 0.0);
    for (const std::vector<double>& light : found)
        for (std::size_t l = 0; l < count; ++l)
            sums[l] += light[l];
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return sums[a] > sums[b];
    });
    return order;
}

/// A rectangle of the same extent as a luminaire's opening.
LightLayer layer_of(const ViewSetup& setup, std::size_t l) {
    const Luminaire& luminaire = setup.emission.luminaire(l);
    const Frame& frame = luminaire.placement.world_from_luminaire;
    LightLayer layer;
    layer.colour = setup.emission.colour(l);
    layer.centre = frame.origin;
    const UnitVector3 n = setup.light.normal_of(l);
    // Sides along the luminaire's own axes, as far as they lie across its normal.
    const bool is_upright = std::abs(dot(n, frame.x)) > 0.9;
    const UnitVector3 t = is_upright ? frame.y : frame.x;
    layer.frame = {t, UnitVector3(cross(n, t)), n};
    double low_t = 0.0;
    double high_t = 0.0;
    double low_b = 0.0;
    double high_b = 0.0;
    for (const Facet& f : luminaire.opening.facets)
        for (const Point3& p : f.vertices) {
            const Vector3 d = p - layer.centre;
            low_t = std::min(low_t, dot(d, layer.frame.t));
            high_t = std::max(high_t, dot(d, layer.frame.t));
            low_b = std::min(low_b, dot(d, layer.frame.b));
            high_b = std::max(high_b, dot(d, layer.frame.b));
        }
    layer.side_t = high_t - low_t;
    layer.side_b = high_b - low_b;
    return layer;
}

} // namespace

ViewSetup::ViewSetup(const Scene& of,
                     const View& view,
                     const RenderSettings& asked,
                     const PictureRows& rows)
    : scene(of),
      settings(asked), whole{view.camera.columns, view.camera.rows}, size{view.camera.columns,
                                                                          rows.count},
      first_row(rows.first), camera(view.camera), emission(of), images(of), light(of, emission),
      mirrored(of, emission, images), estimator(of, emission, images),
      detail(asked.is_preview ? OpeningDetail::coarse : OpeningDetail::fine) {
    // Few pixels are worth few paths.
    if (whole.pixels() < 65536)
        slices_a_side = whole.pixels() < 4096 ? 2 : 4;
    const double slices = static_cast<double>(slices_a_side * slices_a_side);
    const double paths = static_cast<double>(paths_a_slice);
    double vertices_per_path = 1.0;
    if (emission.total_flux() > 0.0) {
        const VertexCache pilot =
            build_vertex_cache(scene,
                               emission,
                               PathRandomness(settings.seed, pilot_replicate),
                               0,
                               pilot_paths,
                               EffectiveCounts{});
        vertices_per_path = std::max(0.01, static_cast<double>(pilot.size()) / pilot_paths);
    }
    counts = {paths, paths * vertices_per_path, 1.0, 1.0, 0.0, scene.total_area};
    edge = std::min(widest_edge, edge_factor * std::sqrt(scene.total_area / (paths * slices)));

    const std::vector<std::size_t> order = rank_luminaires(*this);
    const std::size_t most =
        whole.pixels() > large_picture ? most_layers_if_large : most_layers;
    const std::size_t own = order.size() <= most ? order.size() : most - 1;
    single.assign(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(own));
    merged.assign(order.begin() + static_cast<std::ptrdiff_t>(own), order.end());
}

PixelBuffers make_view_buffers(const ViewSetup& setup) {
    std::vector<LightLayer> layers;
    for (const std::size_t l : setup.single)
        layers.push_back(layer_of(setup, l));
    if (!setup.merged.empty()) {
        LightLayer rest;
        rest.merged = true;
        rest.colour = {};
        // One colour for all of them, by their flux.
        double flux = 0.0;
        for (const std::size_t l : setup.merged) {
            const double f = in_lumen(setup.emission.luminaire(l).flux);
            rest.colour += f * setup.emission.colour(l);
            flux += f;
        }
        rest.colour = flux > 0.0 ? (1.0 / flux) * rest.colour : Rgb::grey(1.0);
        layers.push_back(std::move(rest));
    }
    PixelBuffers buffers = make_pixel_buffers(setup.size, std::move(layers));
    buffers.geometry.origin = midpoint(setup.scene.bounds.lower, setup.scene.bounds.upper);
    return buffers;
}

std::vector<VertexCache>
build_caches(const ViewSetup& setup, std::uint32_t replicate, std::uint64_t unit) {
    const std::size_t slices = setup.slices_a_side * setup.slices_a_side;
    const PathRandomness random(setup.settings.seed, replicate);
    std::vector<VertexCache> caches(slices);
    if (setup.settings.direct_only)
        return caches;
    for_each_index(slices, 1, [&](std::size_t s) {
        caches[s] = build_vertex_cache(setup.scene,
                                       setup.emission,
                                       random,
                                       (unit * slices + s) * setup.paths_a_slice,
                                       setup.paths_a_slice,
                                       setup.counts);
    });
    return caches;
}

std::optional<SightLine> sight_line_of(const ViewSetup& setup,
                                       std::size_t column,
                                       std::size_t row,
                                       NumberSequence& numbers) noexcept {
    const double u = numbers.next();
    const double v = numbers.next();
    const double lens_u = numbers.next();
    const double lens_v = numbers.next();
    return setup.camera.sight_line(static_cast<double>(column) + u,
                                   static_cast<double>(setup.first_row + row) + v,
                                   lens_u,
                                   lens_v);
}

const SeenSurface* primary_of(const EyePath& path) noexcept {
    for (const SeenSurface& s : path.surfaces)
        if (s.reflections == 0)
            return &s;
    return nullptr;
}

} // namespace isolux
