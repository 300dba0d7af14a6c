#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/direct_light.h"
#include "isolux/transport/opening_light.h"
#include "isolux/transport/response.h"

#include "support/random_luminaires.h"
#include "support/statistics.h"

namespace isolux {
namespace {

using test::NormalDraws;

/// One point of every luminaire's opening looked at: how much its light would be if all of it
/// came from there. Its mean over the opening is the illuminance, so that its bound is one.
/// Solid openings share their light by facets; each facet's part is bounded apart and added.
double light_of_places(const Emission& emission,
                       const Receiver& receiver,
                       std::size_t luminaire,
                       NormalDraws& random,
                       double& nearest) {
    const Opening& opening = emission.luminaire(luminaire).opening;
    const std::size_t parts = std::max<std::size_t>(1, opening.facets.size());
    double sum = 0.0;
    for (std::size_t f = 0; f < parts; ++f) {
        EmissionPoint from{
            luminaire, f, emission.luminaire(luminaire).placement.world_from_luminaire.origin};
        double area = 1.0;
        if (opening.form != OpeningForm::point) {
            area = opening.facets[f].area;
            const double u = random.uniform();
            from.position = sample_polygon(opening.facets[f].vertices, u, random.uniform());
        }
        const Vector3 d = receiver.point - from.position;
        nearest = std::min(nearest, length(d));
        const UnitVector3 w(d);
        sum += area * emission.evaluate(from, w) * evaluate_response(receiver, -w)
               / length_squared(d);
    }
    return sum;
}

/// METHODS eq. (14): 20 000 random configurations, the receiver inside the node in about half
/// of them.
TEST(LightBounds, AreNeverBelowTheLight) {
    NormalDraws random(1);
    std::size_t bright = 0;
    for (int scenes = 0; scenes < 500; ++scenes) {
        const std::size_t count = 1 + static_cast<std::size_t>(5.0 * random.uniform());
        const Scene scene = test::random_scene(random, count, 1.0 + random.uniform());
        const Emission emission(scene);
        const LightTree tree(scene);
        for (int i = 0; i < 40; ++i) {
            const Receiver receiver = test::random_receiver(random, i % 2 == 0 ? 1.5 : 8.0);
            for (const LightTree::Node& node : tree.nodes()) {
                if (!node.is_leaf() && &node != tree.nodes().data())
                    continue;
                double light = 0.0;
                double nearest = 1.0;
                for (std::size_t l = 0; l < count; ++l)
                    if (!node.is_leaf() || node.luminaire == l)
                        light += light_of_places(emission, receiver, l, random, nearest);
                if (nearest < 1e-3)
                    continue;
                const double bound = upper_bound(node.bounds, receiver);
                EXPECT_LE(light, bound * (1.0 + 1e-6)) << scenes << ' ' << i;
                if (light > 0.0) {
                    EXPECT_GT(importance(glow_of(node.bounds), receiver.point), 0.0F)
                        << scenes << ' ' << i;
                }
                bright += light > 0.0 ? 1U : 0U;
            }
        }
    }
    EXPECT_GT(bright, 20000U); // the statement was put to the test
}

/// A bound that is always valid may still be useless: for one luminaire on its own axis it is
/// the light itself, but for the band's width and the opening's size.
TEST(LightBounds, AreTightFarOnTheAxis) {
    test::Builder b;
    test::add_speck(b);
    b.add_panel({-0.3, -0.3, 0}, {0, 0.6, 0}, {0.6, 0, 0}, 1000.0 * std::numbers::pi);
    const Scene scene = b.build();
    const LightBounds bounds =
        bound_luminaire(scene.luminaires[0], describe_type(scene.luminaire_types[0]));
    const Receiver receiver{{0, 0, -20}, UnitVector3::from_unit({0, 0, 1})};
    const double light = 1000.0 / 400.0;
    EXPECT_GE(upper_bound(bounds, receiver), light);
    EXPECT_LE(upper_bound(bounds, receiver), 1.05 * light);
}

/// The weight of a walk down the tree loses no angle that light comes at, however it rounds: a
/// beam of half a degree, looked at from just inside its edge, far from the origin.
TEST(LightBounds, WeighAThinBeamToItsEdge) {
    LightBounds beam;
    beam.lower = beam.upper = {4.1e5, 5.6e6, 30.0};
    beam.axis = UnitVector3(Vector3{1.0, 2.0, -3.0});
    beam.reach = std::numbers::pi / 360.0;
    beam.count = 1.0;
    beam.largest.front() = 1000.0;
    const Basis basis = make_basis(beam.axis);
    for (const double away : {0.01, 1.0, 50.0})
        for (int turn = 0; turn < 64; ++turn) {
            const double phi = 0.1 * turn;
            const auto at = [&](double angle) {
                const Vector3 local{std::sin(angle) * std::cos(phi),
                                    std::sin(angle) * std::sin(phi),
                                    std::cos(angle)};
                return beam.lower + away * basis.to_world(local);
            };
            EXPECT_GT(importance(glow_of(beam), at(0.999 * beam.reach)), 0.0F) << away;
            EXPECT_EQ(importance(glow_of(beam), at(beam.reach + 5e-3)), 0.0F) << away;
        }
}

TEST(LightTree, HoldsEveryLuminaireThatShinesOnce) {
    NormalDraws random(2);
    Scene scene = test::random_scene(random, 300, 30.0);
    scene.luminaires[7].flux = Lumen(0.0);
    const LightTree tree(scene);
    std::vector<int> found(300, 0);
    for (const LightTree::Node& node : tree.nodes())
        if (node.is_leaf())
            ++found[node.luminaire];
    for (std::size_t l = 0; l < 300; ++l)
        EXPECT_EQ(found[l], l == 7 ? 0 : 1) << l;
}

/// Leaves are counted from left to right, so that those below a node stand side by side.
TEST(LightTree, CountsItsLeaves) {
    NormalDraws random(6);
    const Scene scene = test::random_scene(random, 100, 10.0);
    const LightTree tree(scene);
    std::vector<int> seen(100, 0);
    for (const LightTree::Node& node : tree.nodes()) {
        if (node.is_leaf()) {
            ++seen[node.first_leaf];
            const auto n = static_cast<std::uint32_t>(&node - tree.nodes().data());
            EXPECT_EQ(tree.luminaires_below(n)[0], node.luminaire);
            EXPECT_EQ(tree.leaf_of(node.luminaire), n);
            continue;
        }
        const LightTree::Node& left = tree.nodes()[node.left];
        EXPECT_EQ(left.first_leaf, node.first_leaf);
        EXPECT_EQ(tree.luminaires_below(node.left).size(),
                  static_cast<std::size_t>(left.bounds.count));
        EXPECT_EQ(tree.nodes()[node.left + 1].first_leaf,
                  node.first_leaf + static_cast<std::uint32_t>(left.bounds.count));
    }
    EXPECT_EQ(std::ranges::count(seen, 1), 100);
}

/// Whoever can light a place can be picked, whether luminaires are few or many.
TEST(NextEventPick, LeavesNoLightOut) {
    NormalDraws random(4);
    for (const std::size_t count : {5U, 80U, 300U})
        for (int scenes = 0; scenes < 20; ++scenes) {
            const Scene scene = test::random_scene(random, count, 4.0);
            const Emission emission(scene);
            for (int i = 0; i < 50; ++i) {
                Receiver receiver{test::random_point(random, 6.0), {}};
                receiver.kind = IlluminanceKind::mean_spherical;
                for (std::size_t l = 0; l < count; ++l) {
                    const OpeningView view = emission.view(l, receiver.point);
                    const double u = random.uniform();
                    const EmissionPoint from = view.sample(u, random.uniform());
                    const UnitVector3 w(receiver.point - from.position);
                    if (emission.evaluate(from, w) > 0.0 && view.pdf(from) > 0.0) {
                        EXPECT_GT(emission.pdf_towards(receiver.point, from), 0.0) << l;
                    }
                }
            }
        }
}

/// A row of 400 lamps: for a receiver at one end most are negligible and drawn from the tree.
/// Against the sum of all, z-test over 64 seeds.
TEST(DirectLightUnderManyLuminaires, IsTheSumOfAll) {
    test::Builder b;
    test::add_speck(b);
    const LuminaireTypeId lamp = b.add_isotropic_type(1000.0);
    for (int i = 0; i < 400; ++i)
        b.add_point({1.0 * i, 0.0, 2.0}, lamp);
    const Scene scene = b.build();
    const Emission emission(scene);
    const MirrorImages images(scene);
    const DirectLight direct(scene, emission, images);
    const Receiver receiver{{0, 0, 0}, UnitVector3::from_unit({0, 0, 1})};
    double sum = 0.0;
    for (const Luminaire& l : scene.luminaires) {
        const Vector3 d = l.placement.world_from_luminaire.origin - receiver.point;
        sum += 1000.0 / (4.0 * std::numbers::pi) * d.z / std::pow(length(d), 3.0);
    }
    std::uint64_t rays = 0;
    std::size_t tail_draws = 0;
    const Estimate e = test::over_seeds([&](std::size_t seed) {
        const DirectPlan plan = direct.plan(receiver, 0, seed, false, rays);
        EXPECT_FALSE(plan.tail.empty());
        tail_draws += plan.tail_draws;
        Rgb light;
        direct.estimate(
            receiver, plan, 0, seed, 0, {}, 0, {{&light, 1}, nullptr, {}, {}}, rays);
        return luminance_sum(light);
    });
    EXPECT_GT(e.standard_error, 0.0);
    EXPECT_LT(e.standard_error, 1e-3 * sum);
    EXPECT_LT(std::abs(test::z_score(e, sum)), test::z_limit) << e.mean << " for " << sum;
    // Neither the far lamps nor the bounds of their groups cost a ray each.
    EXPECT_LT(static_cast<double>(rays), 64.0 * 150.0);
    EXPECT_GE(tail_draws, 64U);
}

/// The same hall lying on its side: x becomes y and so on, `turns` times.
Vector3 turned(const Vector3& v, int turns) {
    return turns == 0 ? v : turned({v.z, v.x, v.y}, turns - 1);
}

/// Direct light of panels [first, last) of a hall with sixteen by eight of them, which shine up
/// and down, over a board.
struct Hall {
    Hall(std::size_t first, std::size_t last, int turns) : scene(make(first, last, turns)) {}

    static Scene make(std::size_t first, std::size_t last, int turns) {
        const auto at = [turns](double x, double y, double z) {
            return Point3{} + turned({x, y, z}, turns);
        };
        test::Builder b;
        b.add_quad(at(7, 3.5, 1.5),
                   turned({3, 0, 0}, turns),
                   turned({0, 3, 0}, turns),
                   b.add_diffuse(0.0));
        LuminaireType type;
        type.source = IsotropicSource{Lumen(1000.0)};
        type.opening.shape = OpeningShape::rectangle;
        type.opening.extent_x = Metre(0.6);
        type.opening.extent_y = Metre(0.6);
        const Opening opening = make_opening(type.opening);
        const LuminaireTypeId id = b.add_type(std::move(type));
        for (std::size_t i = first; i < last; ++i) {
            Luminaire l;
            l.placement.type = id;
            Frame& frame = l.placement.world_from_luminaire;
            frame.x = UnitVector3(turned({1, 0, 0}, turns));
            frame.y = UnitVector3(turned({0, 1, 0}, turns));
            frame.z = UnitVector3(turned({0, 0, 1}, turns));
            frame.origin =
                at(1.4 * static_cast<double>(i % 16), 1.4 * static_cast<double>(i / 16), 3.0);
            l.opening = to_world(opening, frame);
            l.flux = luminous_flux(b.types[id.index()]);
            b.luminaires.push_back(l);
        }
        return b.build();
    }

    /// @param rays  of all seeds
    Estimate at(const Receiver& receiver, std::uint64_t& rays) const {
        return test::over_seeds([&](std::size_t seed) {
            const DirectPlan plan = direct.plan(receiver, 0, seed, false, rays);
            Rgb light;
            direct.estimate(
                receiver, plan, 0, seed, 0, {}, 0, {{&light, 1}, nullptr, {}, {}}, rays);
            return luminance_sum(light);
        });
    }

    Scene scene;
    Emission emission{scene};
    MirrorImages images{scene};
    DirectLight direct{scene, emission, images};
};

/// Halls of 64 panels look at each of them for itself; one of 128 takes those far away in
/// groups and asks of whole groups whether anything hides them. It has to find as much as its
/// halves together: in the open, below the board, half below it and above the panels; and
/// nobody who sees them all needs a ray for a panel that is not in the tail.
TEST(DirectLightUnderManyLuminaires, IsThatOfItsParts) {
    for (const int turns : {0, 1, 2}) {
        const Hall whole(0, 128, turns);
        const Hall one(0, 64, turns);
        const Hall other(64, 128, turns);
        const UnitVector3 up(turned({0, 0, 1}, turns));
        for (const double z : {0.0, 0.75, 1.4, 2.0, 4.0})
            for (const double x : {0.7, 5.8, 6.9, 9.7, 10.3, 20.3}) {
                const Receiver receiver{Point3{} + turned({x, 4.9, z}, turns),
                                        z < 3.0 ? up : -up};
                std::uint64_t rays = 0;
                std::uint64_t rays_of_parts = 0;
                const Estimate e = whole.at(receiver, rays);
                const Estimate a = one.at(receiver, rays_of_parts);
                const Estimate b = other.at(receiver, rays_of_parts);
                const double error = std::sqrt(e.standard_error * e.standard_error
                                               + a.standard_error * a.standard_error
                                               + b.standard_error * b.standard_error);
                const double sum = a.mean + b.mean;
                EXPECT_NEAR(e.mean, sum, test::z_limit * error + 4e-4 * sum)
                    << turns << ' ' << x << ' ' << z;
                EXPECT_GT(sum, 0.0);
                EXPECT_LT(error, 0.02 * sum) << turns << ' ' << x << ' ' << z;
                if (z >= 2.0) {
                    EXPECT_EQ(rays_of_parts, 0U);
                    EXPECT_LE(rays, 16.0 * test::seeds) << turns << ' ' << x << ' ' << z;
                }
            }
    }
}

} // namespace
} // namespace isolux
