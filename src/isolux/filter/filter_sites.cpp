#include "isolux/filter/filter_sites.h"

#include <algorithm>
#include <cmath>

#include "isolux/base/parallel.h"
#include "isolux/filter/pilot_smoothing.h"

namespace isolux {
namespace {

constexpr double omega_h = 2.8;         ///< band limit of the hemisphere, METHODS eq. (95)
constexpr double disc_sigma = 0.5;      ///< standard deviation of a uniform disc of radius 1
constexpr double smallest_slope = 1e-6; ///< an occluder that touches: no width worth a name
constexpr double smallest_sigma = 1e-6; ///< m, of a side of no length
constexpr std::size_t nearby = 2;       ///< pixels, where the pilot looked around in all
constexpr std::size_t grain = 4096;     ///< pixels
constexpr double widest = 1e3;          ///< steps; far beyond any radius

/// Two footprint steps, made dimensionless or not, meet at an angle; the
/// product of two one-dimensional Gaussians is then too wide. METHODS eq. (97).
double angle_factor(double cx, double cy, double rx, double ry, double dot_product) {
    const double lengths = std::sqrt((cx * cx + cy * cy) * (rx * rx + ry * ry));
    return lengths > 0.0 ? std::sqrt(1.0 + std::min(1.0, std::abs(dot_product) / lengths))
                         : 1.0;
}

double skew(const Vector3& column, const Vector3& row) {
    return angle_factor(length(column), 0.0, length(row), 0.0, dot(column, row));
}

bool is_site(const PixelGeometry& g, const FilterSettings& settings, std::size_t i) {
    const bool in_a = g.samples_a[i] > 0.0F;
    const bool in_b = g.samples_b[i] > 0.0F;
    return g.first.object[i] != 0 && (settings.with_half_sites ? in_a || in_b : in_a && in_b);
}

/// Sites without a place yet.
FilterSites sites_without_width(PictureSize size) {
    FilterSites sites;
    sites.size = size;
    for (Plane* plane : {&sites.narrowness, &sites.columns, &sites.rows})
        plane->assign(size.pixels(), 0.0F);
    return sites;
}

FilterSites sites_in_world(const PixelGeometry& geometry,
                           PictureSize size,
                           const FilterSettings& settings) {
    FilterSites sites = sites_without_width(size);
    sites.position = geometry.position;
    sites.normal = geometry.first.normal;
    sites.object = geometry.first.object;
    for_each_index(size.pixels(), grain, [&](std::size_t i) {
        if (!is_site(geometry, settings, i))
            sites.object[i] = 0;
    });
    return sites;
}

FilterSites sites_of_light(const PixelGeometry& geometry,
                           PictureSize size,
                           const LightLayer& light,
                           const FilterSettings& settings) {
    FilterSites sites = sites_without_width(size);
    sites.central = true;
    const auto sigma = [](double side) {
        return static_cast<float>(std::max(side / std::sqrt(12.0), smallest_sigma));
    };
    sites.scale_x = sigma(light.side_t);
    sites.scale_y = sigma(light.side_b);
    sites.half_side_x = static_cast<float>(0.5 * light.side_t);
    sites.half_side_y = static_cast<float>(0.5 * light.side_b);
    sites.position.assign(size.pixels(), 0.0F);
    sites.normal.assign(size.pixels(), 0.0F);
    sites.object.assign(size.pixels(), 0);
    const Vector3 to_centre = light.centre - geometry.origin;
    for_each_index(size.pixels(), grain, [&](std::size_t i) {
        if (!(light.unshadowed_first[i] > 0.0F) || !is_site(geometry, settings, i))
            return;
        const Vector3 at = light.frame.to_local(geometry.position.vector(i) - to_centre);
        if (!(at.z > 0.0))
            return;
        sites.object[i] = geometry.first.object[i];
        sites.position.set(i, at);
        sites.normal.set(i, light.frame.to_local(geometry.first.normal.vector(i)));
    });
    return sites;
}

/// The widths in the light's plane as widths in pixels, narrowed where the
/// steps are skew. `floor` in pixels; 0: none.
void set_light_pixels(FilterSites& sites,
                      const PixelGeometry& geometry,
                      const LightLayer& light,
                      double floor,
                      std::size_t i) {
    const Vector3 x = sites.position.vector(i);
    const auto step = [&](const Planes3& world, double& dx, double& dy) {
        const Vector3 u = light.frame.to_local(world.vector(i));
        dx = (u.x - x.x * u.z / x.z) / sites.scale_x;
        dy = (u.y - x.y * u.z / x.z) / sites.scale_y;
        const double tilt = std::abs(u.z / x.z);
        return std::hypot(std::abs(dx) + tilt * sites.half_side_x / sites.scale_x,
                          std::abs(dy) + tilt * sites.half_side_y / sites.scale_y);
    };
    double cx = 0.0;
    double cy = 0.0;
    double rx = 0.0;
    double ry = 0.0;
    const double column = step(geometry.column_step, cx, cy);
    const double row = step(geometry.row_step, rx, ry);
    double narrowness = sites.narrowness[i] * angle_factor(cx, cy, rx, ry, cx * rx + cy * ry);
    if (floor > 0.0) {
        const double at_floor = 1.0 / (floor * std::max(column, row));
        narrowness = narrowness > 0.0 ? std::min(narrowness, at_floor) : at_floor;
    }
    sites.narrowness[i] = static_cast<float>(narrowness);
    sites.columns[i] = static_cast<float>(std::min(widest, 1.0 / (narrowness * column)));
    sites.rows[i] = static_cast<float>(std::min(widest, 1.0 / (narrowness * row)));
}

/// Widths in metres on the tangent plane as widths in pixels. `floor` in
/// pixels; 0: none.
void set_world_pixels(FilterSites& sites,
                      const PixelGeometry& geometry,
                      double floor,
                      std::size_t i) {
    const Vector3 column = geometry.column_step.vector(i);
    const Vector3 row = geometry.row_step.vector(i);
    const double longer = std::max(length(column), length(row));
    if (!(length(column) > 0.0) || !(length(row) > 0.0)) {
        sites.narrowness[i] = 0.0F;
        return;
    }
    double narrowness = sites.narrowness[i] * skew(column, row);
    if (floor > 0.0) {
        const double at_floor = 1.0 / (floor * longer);
        narrowness = narrowness > 0.0 ? std::min(narrowness, at_floor) : at_floor;
    }
    narrowness = std::max(narrowness, 1.0 / (widest * longer));
    sites.narrowness[i] = static_cast<float>(narrowness);
    sites.columns[i] = static_cast<float>(1.0 / (narrowness * length(column)));
    sites.rows[i] = static_cast<float>(1.0 / (narrowness * length(row)));
}

} // namespace

double width_factor(double samples) noexcept {
    constexpr double samples_of_table = 16.0;
    return samples > samples_of_table ? std::pow(samples / samples_of_table, -1.0 / 6.0) : 1.0;
}

FilterSites make_shadow_sites(const PixelGeometry& geometry,
                              PictureSize size,
                              const LightLayer& light,
                              const FilterSettings& settings) {
    FilterSites sites = light.merged ? sites_in_world(geometry, size, settings)
                                     : sites_of_light(geometry, size, light, settings);
    const double k_mu = settings.k_mu_shadow / width_factor(settings.samples);
    if (light.merged) {
        const double narrower = 1.0 / width_factor(settings.samples);
        for_each_index(size.pixels(), grain, [&](std::size_t i) {
            if (sites.object[i] != 0 && light.merged_width[i] > 0.0F)
                sites.narrowness[i] = static_cast<float>(narrower / light.merged_width[i]);
        });
    } else {
        Plane slope_min = light.slope_min;
        fill_slopes(size, sites.object, slope_min);
        for_each_index(size.pixels(), grain, [&](std::size_t i) {
            if (sites.object[i] != 0 && slope_min[i] >= 0.0F)
                sites.narrowness[i] =
                    static_cast<float>(k_mu / std::max<double>(slope_min[i], smallest_slope));
        });
    }
    smooth_positive(size, sites.object, sites.narrowness);
    const double floor = settings.shadow_floor_pixels;
    for_each_index(size.pixels(), grain, [&](std::size_t i) {
        if (sites.object[i] == 0 || (!(sites.narrowness[i] > 0.0F) && !(floor > 0.0)))
            return;
        if (light.merged)
            set_world_pixels(sites, geometry, floor, i);
        else
            set_light_pixels(sites, geometry, light, floor, i);
    });
    return sites;
}

FilterSites make_indirect_sites(const PixelGeometry& geometry,
                                PictureSize size,
                                const IndirectLayer& indirect,
                                const FilterSettings& settings) {
    FilterSites sites = sites_in_world(geometry, size, settings);
    const Plane z_min = smallest_nearby(size,
                                        geometry.first.object,
                                        geometry.first.normal,
                                        indirect.z_min,
                                        nearby * settings.pilot_step);
    const double factor = width_factor(settings.samples);
    const double k_mu = settings.k_mu_indirect / factor;
    for_each_index(size.pixels(), grain, [&](std::size_t i) {
        if (sites.object[i] == 0)
            return;
        sites.narrowness[i] =
            static_cast<float>(k_mu * omega_h / std::max<double>(z_min[i], smallest_sigma));
        set_world_pixels(sites, geometry, settings.floor_pixels * factor, i);
    });
    return sites;
}

Plane make_lens_width(const PixelGeometry& geometry, const FilterSettings& settings) {
    const double k_mu = settings.k_mu_lens / width_factor(settings.samples);
    Plane width(geometry.lens_shift_min.size());
    for (std::size_t i = 0; i < width.size(); ++i)
        width[i] = static_cast<float>(disc_sigma * geometry.lens_shift_min[i] / k_mu);
    return width;
}

} // namespace isolux
