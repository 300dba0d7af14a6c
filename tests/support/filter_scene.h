#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "isolux/filter/pixel_buffers.h"

namespace isolux::test {

inline constexpr double sqrt_12 = 3.46410161513775459;

/// A floor z = 0 seen from above, one pixel every `step` m, the picture's middle at the origin;
/// diffuse of reflectance pi (so that luminance is illuminance), one sample a half and pixel.
inline PixelBuffers
make_floor_buffers(PictureSize size, double step, std::vector<LightLayer> lights = {}) {
    PixelBuffers buffers = make_pixel_buffers(size, std::move(lights));
    PixelGeometry& g = buffers.geometry;
    const double middle_x = 0.5 * static_cast<double>(size.columns - 1);
    const double middle_y = 0.5 * static_cast<double>(size.rows - 1);
    for (std::size_t i = 0; i < size.pixels(); ++i) {
        const double x = static_cast<double>(i % size.columns) - middle_x;
        const double y = static_cast<double>(i / size.columns) - middle_y;
        g.first.object[i] = 1;
        g.first.normal.set(i, Vector3{0.0, 0.0, 1.0});
        g.first.reflected_a.set(i, Vector3{1.0, 1.0, 1.0});
        g.first.reflected_b.set(i, Vector3{1.0, 1.0, 1.0});
        g.position.set(i, Vector3{x * step, -y * step, 0.0});
        g.column_step.set(i, Vector3{step, 0.0, 0.0});
        g.row_step.set(i, Vector3{0.0, -step, 0.0});
        g.depth[i] = 1.0F;
        g.coverage[i] = 1.0F;
        g.samples_a[i] = 1.0F;
        g.samples_b[i] = 1.0F;
        for (LightLayer& light : buffers.lights)
            light.unshadowed_first[i] = 1.0F;
    }
    return buffers;
}

/// A square light of standard deviation `sigma` at (0, 0, height), shining down.
inline LightLayer make_light(double sigma, double height) {
    LightLayer light;
    light.centre = {0.0, 0.0, height};
    light.frame = {UnitVector3::from_unit({1.0, 0.0, 0.0}),
                   UnitVector3::from_unit({0.0, -1.0, 0.0}),
                   UnitVector3::from_unit({0.0, 0.0, -1.0})};
    light.side_t = light.side_b = sigma * sqrt_12;
    return light;
}

inline double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// A plane of values f(x, y) over the floor.
inline Plane over_floor(const PixelBuffers& buffers,
                        const std::function<double(double x, double y)>& f) {
    Plane plane(buffers.size.pixels());
    for (std::size_t i = 0; i < plane.size(); ++i)
        plane[i] = static_cast<float>(
            f(buffers.geometry.position.x[i], buffers.geometry.position.y[i]));
    return plane;
}

} // namespace isolux::test
