#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/light_path.h"

#include "support/test_scene.h"

namespace isolux {
namespace {

/// METHODS eq. (11), k = 2: the density of a path's first vertex is over that with which
/// next-event estimation finds the same luminaire from the same place, moved off the surface. A
/// wall stands where two cells of the light grid meet, so that the other side of it is another
/// place.
TEST(LightPath, DividesByTheDensityOfItsRivalAtTheSamePlace) {
    test::Builder b;
    const MaterialId grey = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {20, 10, 3}, grey, grey, grey);
    b.add_quad({10, 0, 0}, {0, 10, 0}, {0, 0, 3}, grey);
    const LuminaireTypeId lamp = b.add_isotropic_type(1000.0);
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 10; ++j)
            b.add_point({0.5 + 1.0 * i, 0.5 + 1.0 * j, 2.5}, lamp);
    const Scene scene = b.build();
    const Emission emission(scene);
    ASSERT_NE(emission.tree(), nullptr);
    const double flux = 1000.0 * 200.0;
    int at_the_wall = 0;
    std::vector<PathVertex> vertices;
    for (std::uint64_t path = 0; path < 2000; ++path)
        walk_light_path(scene, emission, PathRandomness(3, 0), path, vertices);
    for (const PathVertex& v : vertices) {
        if (!v.is_first)
            continue;
        const Point3 lamp_at =
            scene.luminaires[v.luminaire].placement.world_from_luminaire.origin;
        const Vector3 d = v.position - lamp_at;
        const double cosine = -dot(v.normal, UnitVector3(d));
        const double intensity = 1000.0 / (4.0 * std::numbers::pi);
        const double nee = emission.pdf_towards(v.position, {v.luminaire, 0, lamp_at});
        const double density = intensity * cosine / (flux * length_squared(d) * nee);
        ASSERT_NEAR(v.density, density, 1e-3 * density) << v.position.x << ' ' << v.normal.x();
        at_the_wall += std::abs(v.position.x - 10.0) < 1e-3 ? 1 : 0;
    }
    EXPECT_GT(at_the_wall, 50);
}

} // namespace
} // namespace isolux
