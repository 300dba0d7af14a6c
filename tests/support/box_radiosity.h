#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "isolux/base/parallel.h"
#include "isolux/base/polygon.h"
#include "isolux/base/receiver.h"

/// Radiosity of an empty box by collocation in double precision, for comparison only: constant
/// patches, form factors by Lambert's polygon formula, no rays and no random numbers.
namespace isolux::test {

class BoxRadiosity {
public:
    struct Patch {
        std::array<Point3, 4> corner;
        Point3 centre;
        UnitVector3 normal; ///< inwards
        double reflectance = 0.0;
        double exitance = 0.0; ///< reflected, lm/m2
    };

    /// @param reflectances  floor, ceiling, walls
    /// @param direct        illuminance straight from the luminaires at a place
    /// @param patches       along every metre
    BoxRadiosity(const Point3& size,
                 const std::array<double, 3>& reflectances,
                 const std::function<double(const Point3&, const UnitVector3&)>& direct,
                 int patches) {
        const Vector3 x{size.x, 0, 0};
        const Vector3 y{0, size.y, 0};
        const Vector3 z{0, 0, size.z};
        const Point3 o{0, 0, 0};
        const auto [floor, ceiling, wall] = reflectances;
        add_face(o, x, y, floor, patches);
        add_face(o + z, y, x, ceiling, patches);
        add_face(o, y, z, wall, patches);
        add_face(o + x, z, y, wall, patches);
        add_face(o, z, x, wall, patches);
        add_face(o + y, x, z, wall, patches);
        solve(direct);
    }

    /// Reflected illuminance at a plane.
    [[nodiscard]] double reflected(const Point3& at, const UnitVector3& normal) const {
        double e = 0.0;
        for (const Patch& p : patches_)
            e += p.exitance / std::numbers::pi * projected_solid_angle(p.corner, at, normal);
        return e;
    }

private:
    void
    add_face(const Point3& o, const Vector3& u, const Vector3& v, double rho, int per_metre) {
        const int nu = static_cast<int>(std::lround(length(u) * per_metre));
        const int nv = static_cast<int>(std::lround(length(v) * per_metre));
        const Vector3 du = (1.0 / nu) * u;
        const Vector3 dv = (1.0 / nv) * v;
        const UnitVector3 n(cross(u, v));
        for (int i = 0; i < nu; ++i)
            for (int j = 0; j < nv; ++j) {
                const Point3 c = o + static_cast<double>(i) * du + static_cast<double>(j) * dv;
                patches_.push_back(
                    {{c, c + du, c + du + dv, c + dv}, c + 0.5 * du + 0.5 * dv, n, rho, 0.0});
            }
    }

    void solve(const std::function<double(const Point3&, const UnitVector3&)>& direct) {
        const std::size_t n = patches_.size();
        std::vector<double> source(n);
        std::vector<double> factor(n * n);
        for_each_index(n, 16, [&](std::size_t i) {
            const Patch& p = patches_[i];
            source[i] = p.reflectance * direct(p.centre, p.normal);
            for (std::size_t j = 0; j < n; ++j)
                factor[i * n + j] =
                    i == j ? 0.0
                           : p.reflectance
                                 * projected_solid_angle(patches_[j].corner, p.centre, p.normal)
                                 / std::numbers::pi;
        });
        std::vector<double> m = source;
        for (int turn = 0; turn < 200; ++turn) {
            double change = 0.0;
            for (std::size_t i = 0; i < n; ++i) { // Gauss-Seidel
                double sum = source[i];
                for (std::size_t j = 0; j < n; ++j)
                    sum += factor[i * n + j] * m[j];
                change = std::max(change, std::abs(sum - m[i]) / sum);
                m[i] = sum;
            }
            if (change < 1e-12)
                break;
        }
        for (std::size_t i = 0; i < n; ++i)
            patches_[i].exitance = m[i];
    }

    std::vector<Patch> patches_;
};

} // namespace isolux::test
