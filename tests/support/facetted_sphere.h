#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "isolux/base/vec.h"

namespace isolux::test {

/// A sphere made of triangles whose corners lie on it.
struct FacettedSphere {
    std::vector<Point3> points;
    std::vector<std::array<std::uint32_t, 3>> faces; ///< fronts look at the centre
    double area = 0.0;                               ///< m2, of the facets: below 4 pi R2
};

/// An octahedron whose triangles are cut in four `level` times: 8 * 4^level facets. The gap
/// between facet and sphere shrinks by four with every level.
inline FacettedSphere make_facetted_sphere(const Point3& centre, double radius, int level) {
    FacettedSphere s;
    const auto add = [&](const Vector3& v) {
        s.points.push_back(centre + radius * Vector3(UnitVector3(v)));
        return static_cast<std::uint32_t>(s.points.size() - 1);
    };
    for (const Vector3& v :
         {Vector3{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
        add(v);
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t next = (k + 1) % 4;
        s.faces.push_back({k, 4, next});
        s.faces.push_back({k, next, 5});
    }
    for (int l = 0; l < level; ++l) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), 0);
            if (is_new)
                place->second = add(midpoint(s.points[a], s.points[b]) - centre);
            return place->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : s.faces) {
            const std::uint32_t ab = middle(a, b);
            const std::uint32_t bc = middle(b, c);
            const std::uint32_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        s.faces = std::move(finer);
    }
    for (const auto& [a, b, c] : s.faces)
        s.area += 0.5 * length(cross(s.points[b] - s.points[a], s.points[c] - s.points[a]));
    return s;
}

} // namespace isolux::test
