#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/angle.h"
#include "isolux/base/parallel.h"
#include "isolux/scene/material.h"
#include "isolux/scene/ray_caster.h"

namespace isolux {
namespace {

CasterTriangle opaque(const Point3& a, const Point3& b, const Point3& c) {
    return {.corner = {a, b, c}};
}

/// The rectangle `corner`, `corner + u`, ...; its front is on the side of u x v.
void add_rectangle(std::vector<CasterTriangle>& to,
                   const Point3& corner,
                   const Vector3& u,
                   const Vector3& v,
                   const CasterTriangle& like = {}) {
    CasterTriangle t = like;
    t.corner = {corner, corner + u, corner + u + v};
    to.push_back(t);
    t.corner = {corner, corner + u + v, corner + v};
    to.push_back(t);
}

/// A box seen from inside: the room [0,size] shifted to `origin`.
std::vector<CasterTriangle> make_room(const Point3& origin, const Vector3& size) {
    const Vector3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    const CasterTriangle wall{.is_shell = true};
    std::vector<CasterTriangle> t;
    add_rectangle(t, origin, x, y, wall);
    add_rectangle(t, origin + z, y, x, wall);
    add_rectangle(t, origin, y, z, wall);
    add_rectangle(t, origin + x, z, y, wall);
    add_rectangle(t, origin, z, x, wall);
    add_rectangle(t, origin + y, x, z, wall);
    return t;
}

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}

    double uniform(double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(engine_);
    }

    Point3 point(double reach) {
        return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
    }

private:
    std::mt19937_64 engine_;
};

/// Where a segment meets a triangle's plane, told in double precision.
struct Crossing {
    double t = 0.0;      ///< parameter of the segment
    double margin = 0.0; ///< least barycentric coordinate there; negative: outside
};

Crossing cross_plane(const Point3& a, const Point3& b, const CasterTriangle& tri) {
    const Vector3 u = tri.corner[1] - tri.corner[0], v = tri.corner[2] - tri.corner[0];
    const Vector3 n = cross(u, v);
    const double t = dot(n, tri.corner[0] - a) / dot(n, b - a);
    const Vector3 p = (a + t * (b - a)) - tri.corner[0];
    const double nn = dot(n, n);
    const double beta = dot(cross(p, v), n) / nn, gamma = dot(cross(u, p), n) / nn;
    return {t, std::min({beta, gamma, 1.0 - beta - gamma})};
}

enum class Answer { free, blocked, too_close_to_tell };

Answer brute_force(const Point3& a, const Point3& b, const std::vector<CasterTriangle>& all) {
    constexpr double edge = 1e-4; // of a triangle; well above float rounding
    Answer answer = Answer::free;
    for (const auto& tri : all) {
        const Crossing c = cross_plane(a, b, tri);
        if (c.t < -edge || c.t > 1.0 + edge || c.margin < -edge)
            continue;
        if (c.margin < edge || c.t < edge || c.t > 1.0 - edge)
            answer = Answer::too_close_to_tell;
        else
            return Answer::blocked;
    }
    return answer;
}

std::vector<CasterTriangle> random_triangles(Random& random, int count, double size) {
    std::vector<CasterTriangle> all;
    for (int i = 0; i < count; ++i) {
        const Point3 p = random.point(5.0);
        all.push_back(opaque(
            p, p + (random.point(size) - Point3{}), p + (random.point(size) - Point3{})));
    }
    return all;
}

TEST(RayCaster, SeesWhatBruteForceSees) {
    Random random(1);
    const auto triangles = random_triangles(random, 60, 2.0);
    const RayCaster caster(triangles);
    int told = 0, blocked = 0;
    for (int i = 0; i < 20000; ++i) {
        const Point3 a = random.point(5.0), b = random.point(5.0);
        const Answer answer = brute_force(a, b, triangles);
        if (answer == Answer::too_close_to_tell)
            continue;
        ++told;
        blocked += answer == Answer::blocked;
        ASSERT_EQ(caster.transmittance(a, b), answer == Answer::free ? 1.0 : 0.0) << i;
    }
    EXPECT_GT(told, 19000);
    EXPECT_GT(blocked, 2000);
    EXPECT_LT(blocked, told - 2000);
}

TEST(RayCaster, PacketsSeeWhatSingleRaysSee) {
    Random random(2);
    auto triangles = random_triangles(random, 60, 2.0);
    for (std::size_t i = 0; i < triangles.size(); i += 2)
        triangles[i].is_pane = true;
    const RayCaster caster(triangles);
    for (std::size_t count = 1; count <= packet_size; ++count)
        for (int i = 0; i < 50; ++i) {
            std::vector<SightSegment> segments;
            const Point3 a = random.point(5.0);
            for (std::size_t k = 0; k < count; ++k)
                segments.push_back({a, random.point(5.0)});
            const auto wanted = static_cast<std::uint32_t>(random.uniform(0.0, 65536.0));
            std::vector<float> result(count, -1.0F);
            caster.transmittance16(segments, wanted, result);
            for (std::size_t k = 0; k < count; ++k) {
                const double single = caster.transmittance(a, segments[k].b);
                EXPECT_EQ(result[k],
                          (wanted >> k & 1U) != 0 ? static_cast<float>(single) : -1.0F);
            }
        }
}

TEST(RayCaster, FindsTheNearestTriangleAndWhereItIsHit) {
    Random random(3);
    const auto triangles = random_triangles(random, 60, 2.0);
    const RayCaster caster(triangles);
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const Point3 a = random.point(5.0), b = random.point(5.0);
        const UnitVector3 direction(b - a);
        double nearest = 1e300;
        bool clear = true;
        std::size_t which = 0;
        for (std::size_t k = 0; k < triangles.size(); ++k) {
            const Crossing c = cross_plane(a, a + Vector3(direction), triangles[k]);
            if (c.t > 0.0 && std::abs(c.margin) < 1e-4)
                clear = false;
            if (c.t > 0.0 && c.margin > 0.0 && c.t < nearest)
                nearest = c.t, which = k;
        }
        if (!clear || nearest < 1e-3)
            continue;
        const auto hit = caster.find_first_hit(a, direction);
        ASSERT_EQ(hit.has_value(), nearest < 1e300) << i;
        if (!hit)
            continue;
        ++hits;
        EXPECT_EQ(hit->triangle.index(), which);
        EXPECT_NEAR(
            hit->distance, nearest, 1e-5 * (1.0 + nearest)); // a few float steps, slanted
        EXPECT_LE(dot(hit->normal, direction), 0.0);
        const auto& corner = triangles[which].corner;
        EXPECT_NEAR(dot(hit->normal, hit->position - corner[0]), 0.0, 1e-13);
        const Vector3 front = cross(corner[1] - corner[0], corner[2] - corner[0]);
        EXPECT_EQ(hit->is_front, dot(front, direction) < 0.0);
    }
    EXPECT_GT(hits, 1000);
}

TEST(RayCaster, StopsAtTheAskedDistance) {
    const RayCaster caster(make_room({0, 0, 0}, {4, 3, 2}));
    const UnitVector3 x(Vector3{1, 0, 0});
    EXPECT_TRUE(caster.find_first_hit({1, 1, 1}, x, 3.01));
    EXPECT_FALSE(caster.find_first_hit({1, 1, 1}, x, 2.99));
}

TEST(RayCaster, WorksWithoutAnyTriangle) {
    const RayCaster caster({});
    EXPECT_FALSE(caster.find_first_hit({1, 2, 3}, UnitVector3(Vector3{0, 0, -1})));
    EXPECT_EQ(caster.transmittance({0, 0, 0}, {1, 1, 1}), 1.0);
    EXPECT_FALSE(caster.has_panes());
    const SightSegment segment[] = {{{0, 0, 0}, {1, 1, 1}}};
    float result[] = {-1.0F};
    caster.transmittance16(segment, 1, result);
    EXPECT_EQ(result[0], 1.0F);
}

/// Nothing is missed and nothing is met twice: every ray in a closed room hits a wall once, and
/// a point just off the wall sees all other such points.
void expect_closed_room_works(const Point3& origin, const Vector3& size) {
    const RayCaster caster(make_room(origin, size));
    Random random(4);
    std::vector<Point3> on_walls;
    for (int i = 0; i < 3000; ++i) {
        const Point3 inside = origin
                              + Vector3{size.x * random.uniform(0.01, 0.99),
                                        size.y * random.uniform(0.01, 0.99),
                                        size.z * random.uniform(0.01, 0.99)};
        const UnitVector3 direction(random.point(1.0) - Point3{});
        const auto hit = caster.find_first_hit(inside, direction);
        ASSERT_TRUE(hit.has_value());
        ASSERT_TRUE(hit->is_front);
        const Point3 p = caster.offset_point(hit->position, hit->normal);
        const auto back = caster.find_first_hit(p, -direction);
        ASSERT_TRUE(back.has_value());
        ASSERT_NEAR(caster.transmittance(inside, p), 1.0, 0.0);
        ASSERT_EQ(caster.transmittance(p, inside), 1.0);
        on_walls.push_back(p);
    }
    for (std::size_t i = 0; i + 1 < on_walls.size(); ++i)
        ASSERT_EQ(caster.transmittance(on_walls[i], on_walls[i + 1]), 1.0) << i;
    const Point3 middle = origin + 0.5 * size;
    const Point3 outside = origin + Vector3{0.5 * size.x, 0.5 * size.y, 1.5 * size.z};
    EXPECT_EQ(caster.transmittance(middle, outside), 0.0);
}

TEST(RayCaster, ClosedRoomLeaksNothing) { expect_closed_room_works({0, 0, 0}, {6, 4, 3}); }

TEST(RayCaster, ClosedRoomAKilometreAwayLeaksNothing) {
    expect_closed_room_works({1e3, -2e3, 5e2}, {6, 4, 3});
}

TEST(RayCaster, ClosedRoomFarOutOnTheNationalGridLeaksNothing) {
    expect_closed_room_works({3.45e6, 5.6e6, 120}, {6.2, 4.1, 2.9});
}

TEST(RayCaster, MillimetreDetailsAreSeenAKilometreAway) {
    // A floor with 1 mm ridges 5 mm apart, far from the origin.
    const Point3 origin{1200, -900, 40};
    std::vector<CasterTriangle> t;
    add_rectangle(t, origin, {3, 0, 0}, {0, 3, 0});
    for (int i = 0; i < 100; ++i)
        add_rectangle(t, origin + Vector3{1.0 + 0.005 * i, 0, 0}, {0, 3, 0}, {0, 0, 0.001});
    const RayCaster caster(t);
    for (int i = 0; i < 99; ++i) {
        const double x = 1.0 + 0.005 * i;
        // Over the ridge at half its height and at twice its height.
        const auto across = [&](double z) {
            return caster.transmittance(origin + Vector3{x - 0.002, 1.3, z},
                                        origin + Vector3{x + 0.002, 1.3, z});
        };
        ASSERT_EQ(across(0.0005), 0.0) << i;
        ASSERT_EQ(across(0.0020), 1.0) << i;
        // Between two ridges, down to the floor.
        const auto hit = caster.find_first_hit(origin + Vector3{x + 0.0025, 1.3, 1.0},
                                               UnitVector3(Vector3{0, 0, -1}));
        ASSERT_TRUE(hit.has_value());
        ASSERT_NEAR(hit->position.z, origin.z, 1e-12);
    }
}

TEST(RayCaster, FindsWhatIsNearestAheadAndNothingBehind) {
    std::vector<CasterTriangle> t = make_room({0, 0, 0}, {6, 4, 3});
    add_rectangle(t, {1, 1, 0.74}, {1, 0, 0}, {0, 1, 0});   // a desk, just below the points
    add_rectangle(t, {4, 1, 0.70}, {0, 1, 0}, {0, 0, 0.4}); // a screen that stands up past them
    const RayCaster caster(t);
    const UnitVector3 up({0, 0, 1});
    const auto ahead = [&](const Point3& p, const UnitVector3& n) {
        return caster.find_nearest_ahead(p, &n, 2.5);
    };
    EXPECT_NEAR(ahead({1.5, 1.3, 0.75}, up), 1.3, 1e-6);   // the wall, not the desk
    EXPECT_NEAR(ahead({3.8, 1.5, 0.75}, up), 0.2, 1e-6);   // the screen
    EXPECT_NEAR(ahead({0.1, 2.0, 0.0}, up), 0.1, 1e-6);    // on the floor, which is no light
    EXPECT_NEAR(ahead({1.5, 1.5, 0.75}, -up), 0.01, 1e-6); // looking down on the desk
    EXPECT_EQ(caster.find_nearest_ahead({3, 2, 1.5}, &up, 1.0), 1.0); // far enough
    EXPECT_EQ(RayCaster({}).find_nearest_ahead({0, 0, 0}, &up, 3.0), 3.0);
}

/// However a wall is turned, a point before its middle is as far from it as from its plane.
TEST(RayCaster, KnowsHowFarATurnedWallIs) {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const UnitVector3 n(random.point(1.0) - Point3{});
        const UnitVector3 u(cross(n, Vector3{0.3, -0.2, 0.9}));
        const Vector3 v = cross(n, u);
        const Point3 middle = random.point(20.0);
        std::vector<CasterTriangle> t;
        add_rectangle(t, middle - 2.0 * Vector3(u) - 1.5 * v, 4.0 * Vector3(u), 3.0 * v);
        const RayCaster caster(t);
        const double away = random.uniform(0.001, 1.0);
        const Point3 p = middle + away * Vector3(n) + random.uniform(-1, 1) * v;
        EXPECT_NEAR(caster.find_nearest_surfaces(p, 3.0).nearest, away, 1e-9);
        EXPECT_NEAR(caster.find_nearest_ahead(p, nullptr, 3.0), away, 1e-9);
    }
}

TEST(RayCaster, FindsWhatIsNearestAheadAsBruteForceDoes) {
    Random random(11);
    std::vector<CasterTriangle> t;
    for (int i = 0; i < 300; ++i) {
        const Point3 a = random.point(5.0);
        t.push_back(
            opaque(a, a + (random.point(0.5) - Point3{}), a + (random.point(0.5) - Point3{})));
    }
    const RayCaster caster(t);
    std::vector<RayCaster> one_by_one;
    for (const CasterTriangle& own : t)
        one_by_one.emplace_back(std::span(&own, 1));
    int hidden = 0;
    for (int i = 0; i < 300; ++i) {
        const Point3 p = random.point(5.0);
        const UnitVector3 n(random.point(1.0) - Point3{});
        double nearest = 2.0;
        double any = 2.0;
        for (std::size_t k = 0; k < t.size(); ++k) {
            const double d = one_by_one[k].find_nearest_surfaces(p, 2.0).nearest;
            any = std::min(any, d);
            if (std::ranges::any_of(t[k].corner,
                                    [&](const Point3& c) { return dot(n, c - p) > 1e-4; }))
                nearest = std::min(nearest, d);
        }
        hidden += any < nearest ? 1 : 0;
        EXPECT_NEAR(caster.find_nearest_ahead(p, &n, 2.0), nearest, 1e-6);
        EXPECT_NEAR(caster.find_nearest_ahead(p, nullptr, 2.0), any, 1e-6);
    }
    EXPECT_GT(hidden, 50); // often something nearer lies behind
}

TEST(RayCaster, OffsetGrowsWithTheDistanceFromTheMiddle) {
    const RayCaster caster(make_room({1e3, 1e3, 0}, {6, 4, 3}));
    const Vector3 up{0, 0, 2};
    // METHODS "Ray tracer": max |coordinate| 2^-20 + 1e-5 m, counted from the middle of the
    // scene
    const Point3 middle{1003, 1002, 1.5}, corner{1006, 1004, 3};
    EXPECT_NEAR(caster.offset_point(middle, up).z - middle.z, 1e-5, 1e-12);
    EXPECT_NEAR(caster.offset_point(corner, up).z - corner.z, 3.0 * 0x1p-20 + 1e-5, 1e-12);
}

// Panes.

TEST(RayCaster, PaneDimsByTheSlabFormulaAtEveryAngle) {
    std::vector<CasterTriangle> t;
    const CasterTriangle pane{
        .is_pane = true, .refractive_index = 1.5, .internal_transmittance = 0.9};
    add_rectangle(t, {-100, -100, 0}, {200, 0, 0}, {0, 200, 0}, pane);
    const RayCaster caster(t);
    EXPECT_TRUE(caster.has_panes());
    for (const double angle : {0.0, 10.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0}) {
        const Angle theta = degrees(angle);
        const double c = std::cos(theta.in_radians()), s = std::sin(theta.in_radians());
        const double expected = evaluate_slab({1.5, 0.9}, c).transmittance;
        EXPECT_NEAR(caster.transmittance({-s, 0.2, -c}, {s, 0.2, c}), expected, 1e-12);
        EXPECT_NEAR(caster.transmittance({s, 0.2, c}, {-s, 0.2, -c}), expected, 1e-12);
    }
}

TEST(RayCaster, TheSeamOfAPaneDimsOnce) {
    std::vector<CasterTriangle> t;
    const CasterTriangle pane{.is_pane = true};
    add_rectangle(t, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, pane);
    const RayCaster caster(t);
    const double once = evaluate_slab({}, 1.0).transmittance;
    for (int i = 1; i < 200; ++i) {
        const double x = i / 200.0; // on the diagonal
        ASSERT_NEAR(caster.transmittance({x, x, -1}, {x, x, 1}), once, 1e-12);
    }
}

/// Rays far from all panes are not asked about them; a pane far away makes that no reason.
TEST(RayCaster, PanesAreFoundWhetherTheirBoxIsSmallOrLarge) {
    const CasterTriangle pane{.is_pane = true};
    std::vector<CasterTriangle> few;
    add_rectangle(few, {0.2, 0.2, 0.5}, {0.6, 0, 0}, {0, 0.6, 0}, pane);
    std::vector<CasterTriangle> many = few;
    add_rectangle(many, {-9, -9, -9}, {0.1, 0, 0}, {0, 0.1, 0}, pane);
    add_rectangle(many, {9, 9, 9}, {0.1, 0, 0}, {0, 0.1, 0}, pane);
    const RayCaster small(few);
    const RayCaster large(many);
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    std::size_t dimmed = 0;
    for (int i = 0; i < 4000; ++i) {
        const Point3 a{u(engine), u(engine), u(engine)};
        const Point3 b{u(engine), u(engine), u(engine)};
        ASSERT_NEAR(small.transmittance(a, b), large.transmittance(a, b), 1e-6) << i;
        dimmed += small.transmittance(a, b) < 1.0 ? 1U : 0U;
        const std::array<SightSegment, 1> one{{{a, b}}};
        std::array<float, 1> seen{};
        small.transmittance16(one, 1U, seen);
        ASSERT_NEAR(seen[0], large.transmittance(a, b), 1e-6) << i;
        const UnitVector3 w(b - a);
        const auto hit = small.find_first_hit(a, w, distance(a, b));
        const auto other = large.find_first_hit(a, w, distance(a, b));
        ASSERT_EQ(hit.has_value(), other.has_value()) << i;
    }
    EXPECT_GT(dimmed, 400U);
}

TEST(RayCaster, SixteenLinesMeetWhatEachMeetsAlone) {
    std::vector<CasterTriangle> t;
    const CasterTriangle pane{.is_pane = true};
    add_rectangle(t, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    add_rectangle(t, {-0.4, -0.4, 0.5}, {0.6, 0, 0}, {0, 0.6, 0}, pane);
    const RayCaster caster(t);
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    std::size_t at_panes = 0;
    std::size_t missed = 0;
    for (std::size_t count = 1; count <= packet_size; ++count) {
        std::array<SightLine, packet_size> lines;
        for (SightLine& line : lines)
            line = {{0.2 * u(engine), 0.2 * u(engine), 1.0},
                    UnitVector3(Vector3{u(engine), u(engine), -0.8})};
        std::array<std::optional<SurfaceHit>, packet_size> hits;
        caster.find_first_hits16(std::span(lines).first(count), hits);
        for (std::size_t i = 0; i < count; ++i) {
            const auto alone = caster.find_first_hit(lines[i].eye, lines[i].direction);
            ASSERT_EQ(hits[i].has_value(), alone.has_value()) << count << ' ' << i;
            missed += alone ? 0U : 1U;
            if (!alone)
                continue;
            EXPECT_EQ(hits[i]->triangle, alone->triangle);
            EXPECT_NEAR(hits[i]->distance, alone->distance, 1e-6);
            EXPECT_LT(distance(hits[i]->position, alone->position), 1e-6);
            EXPECT_EQ(hits[i]->is_front, alone->is_front);
            at_panes += alone->triangle.index() > 1 ? 1U : 0U;
        }
    }
    EXPECT_GT(at_panes, 10U);
    EXPECT_GT(missed, 10U);
}

TEST(RayCaster, PanesMultiplyAndWallsStop) {
    std::vector<CasterTriangle> t;
    const CasterTriangle pane{.is_pane = true};
    for (int i = 0; i < 3; ++i)
        add_rectangle(t, {-1, -1, 0.01 * i}, {2, 0, 0}, {0, 2, 0}, pane);
    add_rectangle(t, {-1, -1, 0.5}, {1, 0, 0}, {0, 2, 0});
    const RayCaster caster(t);
    const double once = evaluate_slab({}, 1.0).transmittance;
    EXPECT_NEAR(caster.transmittance({0.5, 0, -1}, {0.5, 0, 1}), once * once * once, 1e-12);
    EXPECT_EQ(caster.transmittance({-0.5, 0, -1}, {-0.5, 0, 1}), 0.0);
    const auto hit = caster.find_first_hit({-0.5, 0, -1}, UnitVector3(Vector3{0, 0, 1}));
    ASSERT_TRUE(hit);
    EXPECT_LT(hit->triangle.index(), 2U); // the first pane, not the wall behind it
}

// Rooms that touch.

TEST(RayCaster, EachRoomSeesItsOwnSideOfASharedWall) {
    // Far from the origin and turned, so that the two walls do not coincide to the last bit.
    for (const double shift : {0.0, 1.234567e4}) {
        auto triangles = make_room({shift, 0, 0}, {4.1, 3.3, 2.7});
        const auto left_count = triangles.size();
        for (const auto& t : make_room({shift + 4.1, -1.1, 0}, {3.3, 5.7, 2.9}))
            triangles.push_back(t);
        const RayCaster caster(triangles);
        Random random(5);
        for (int i = 0; i < 5000; ++i) {
            const bool left = i % 2 == 0;
            const Point3 p{shift + (left ? random.uniform(0.1, 4.0) : random.uniform(4.2, 7.3)),
                           random.uniform(0.1, 3.2),
                           random.uniform(0.1, 2.6)};
            const auto hit =
                caster.find_first_hit(p, UnitVector3(random.point(1.0) - Point3{}));
            ASSERT_TRUE(hit);
            EXPECT_TRUE(hit->is_front) << i;
            EXPECT_EQ(hit->triangle.index() < left_count, left) << i;
        }
    }
}

TEST(RayCaster, HitsDoNotDependOnTheNumberOfThreadsThatBuiltTheTree) {
    Random random(6);
    const auto triangles = random_triangles(random, 20000, 0.5);
    const auto trace = [&](std::size_t threads) {
        const ThreadLimit limit(threads);
        const RayCaster caster(triangles);
        Random rays(7);
        std::vector<double> distances;
        for (int i = 0; i < 5000; ++i) {
            const Point3 from = rays.point(5.0);
            const auto hit =
                caster.find_first_hit(from, UnitVector3(rays.point(1.0) - Point3{}));
            distances.push_back(hit ? hit->distance : -1.0);
        }
        return distances;
    };
    EXPECT_EQ(trace(1), trace(0));
}

} // namespace
} // namespace isolux
