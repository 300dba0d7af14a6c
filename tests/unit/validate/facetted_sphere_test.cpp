#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "support/facetted_sphere.h"

namespace isolux::test {
namespace {

using std::numbers::pi;

TEST(FacettedSphere, IsClosedAndLooksInwards) {
    const Point3 centre{1, -2, 3};
    const FacettedSphere s = make_facetted_sphere(centre, 2.0, 3);
    EXPECT_EQ(s.faces.size(), 512u);
    EXPECT_EQ(s.points.size(), 258u); // V = 2 + E - F, E = 3 F/2
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& f : s.faces) {
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_TRUE(edges.emplace(f[k], f[(k + 1) % 3]).second) << "an edge used twice";
        const Vector3 n =
            cross(s.points[f[1]] - s.points[f[0]], s.points[f[2]] - s.points[f[0]]);
        EXPECT_GT(dot(n, centre - s.points[f[0]]), 0.0);
    }
    for (const auto& [a, b] : edges)
        EXPECT_TRUE(edges.contains({b, a})) << "an open edge";
    for (const Point3& p : s.points)
        EXPECT_NEAR(distance(p, centre), 2.0, 1e-15);
}

TEST(FacettedSphere, AreaApproachesTheSphere) {
    double gap = 4.0 * pi - make_facetted_sphere({}, 1.0, 2).area;
    for (int level = 3; level < 6; ++level) {
        const double smaller = 4.0 * pi - make_facetted_sphere({}, 1.0, level).area;
        EXPECT_NEAR(gap / smaller, 4.0, 0.2); // second order in the size of the facets
        gap = smaller;
    }
    EXPECT_GT(gap, 0.0);
}

} // namespace
} // namespace isolux::test
