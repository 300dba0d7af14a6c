#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/scene/outer_planes.h"
#include "isolux/scene/ray_caster.h"

namespace isolux {
namespace {

/// Turned about the vertical by 31 degrees and moved, so that no wall lies along an axis.
Point3 turned(double x, double y, double z) {
    const double c = std::cos(0.541), s = std::sin(0.541);
    return {7.0 + c * x - s * y, -3.0 + s * x + c * y, z};
}

/// Four corners round a rectangle.
void add_rectangle(std::vector<CasterTriangle>& to, const std::array<Point3, 4>& p) {
    to.push_back({.corner = {p[0], p[1], p[2]}});
    to.push_back({.corner = {p[0], p[2], p[3]}});
}

/// The faces of a box, turned; those that `without` names left out: 0 and 1 across x, 2 and 3
/// across y, 4 and 5 across z.
void add_box(std::vector<CasterTriangle>& to,
             const std::array<double, 3>& a,
             const std::array<double, 3>& b,
             int without = -1) {
    for (int face = 0; face < 6; ++face) {
        if (face == without)
            continue;
        const auto axis = static_cast<std::size_t>(face / 2);
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<Point3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) {
            std::array<double, 3> q{};
            q[axis] = face % 2 == 0 ? a[axis] : b[axis];
            q[u] = k == 1 || k == 2 ? b[u] : a[u];
            q[v] = k >= 2 ? b[v] : a[v];
            p[k] = turned(q[0], q[1], q[2]);
        }
        add_rectangle(to, p);
    }
}

std::vector<Piece> pieces_of(const std::vector<CasterTriangle>& triangles) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        pieces.push_back(make_piece(triangles[i], TriangleId(i), {}));
    return pieces;
}

/// A room of 8 m x 6 m x 3 m with a niche of 0.4 m x 1 m x 1 m behind its wall at y = 6, whose
/// opening the wall leaves free, and four cupboards.
std::vector<CasterTriangle> furnished_room() {
    std::vector<CasterTriangle> t;
    add_box(t, {0, 0, 0}, {8, 6, 3}, 3);
    for (const auto& [x0, x1, z0, z1] : {std::array{0.0, 3.0, 0.0, 3.0},
                                         std::array{4.0, 8.0, 0.0, 3.0},
                                         std::array{3.0, 4.0, 0.0, 1.0},
                                         std::array{3.0, 4.0, 2.0, 3.0}})
        add_rectangle(
            t, {turned(x0, 6, z0), turned(x1, 6, z0), turned(x1, 6, z1), turned(x0, 6, z1)});
    add_box(t, {3, 6, 1}, {4, 6.4, 2}, 2);
    for (const double x : {1.0, 2.5, 4.5, 6.0})
        add_box(t, {x, 2.0, 0.0}, {x + 0.8, 2.6, 1.8});
    return t;
}

TEST(OuterPlanes, AreFloorCeilingAndWallsHoweverTheyAreTurned) {
    const std::vector<CasterTriangle> triangles = furnished_room();
    const std::vector<Piece> pieces = pieces_of(triangles);
    const OuterPlanes planes(pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Point3 middle = midpoint(
            triangles[i].corner[0], midpoint(triangles[i].corner[1], triangles[i].corner[2]));
        const bool is_shell = i < 10 + 8; // of the room, then niche and cupboards
        const bool is_bottom = std::abs(middle.z) < 1e-9;
        EXPECT_EQ(planes.hold(pieces[i]), is_shell || is_bottom) << i;
    }
    const Vector3 origin = turned(4, 3, 1.5) - Point3{};
    const Vector3 niche = turned(3.5, 6.2, 1.5) - Point3{};
    const Vector3 wall = turned(1.0, 6.0, 1.5) - Point3{};
    EXPECT_TRUE(planes.enclose(origin, origin));
    EXPECT_TRUE(planes.enclose(origin, wall));
    EXPECT_FALSE(planes.enclose(origin, niche));
    EXPECT_FALSE(planes.enclose(niche, niche));
    EXPECT_FALSE(planes.enclose(origin + Vector3{0, 0, 5}, origin));
}

TEST(OuterPlanes, TellOfPacketsWhatTheyTellOfEveryRay) {
    const OuterPlanes planes(pieces_of(furnished_room()));
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> place(-0.3, 1.3);
    for (int i = 0; i < 2000; ++i) {
        RayPacket rays{};
        std::array<bool, RayPacket::width> enclosed{};
        for (std::size_t k = 0; k < RayPacket::width; ++k) {
            const bool is_out = i % 2 == 0 && random() % 8 == 0;
            const auto somewhere = [&] {
                const auto at = [&](double size) {
                    const double s = place(random);
                    return size * (is_out ? s : std::clamp(s, 0.01, 0.99));
                };
                return turned(at(8.0), at(6.0), at(3.0)) - Point3{};
            };
            const Vector3 from = somewhere(), to = somewhere();
            rays.set(k, {from, to - from, 0.0, 1.0});
            enclosed[k] = planes.enclose(from, to);
        }
        const auto wanted = static_cast<std::uint32_t>(random() & 0xffffU);
        bool all = true;
        for (std::size_t k = 0; k < RayPacket::width; ++k)
            all = all && (enclosed[k] || (wanted >> k & 1U) == 0);
        EXPECT_EQ(planes.enclose(rays, wanted), all) << i;
    }
}

TEST(OuterPlanes, AreNoneOfARoundRoom) {
    std::vector<CasterTriangle> t;
    constexpr int n = 40;
    const auto at = [](int i, int k) {
        const double theta = std::numbers::pi * i / n, phi = 2.0 * std::numbers::pi * k / n;
        return Point3{
            std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    };
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            if (i > 0)
                t.push_back({.corner = {at(i, k), at(i + 1, k), at(i, k + 1)}});
            if (i + 1 < n)
                t.push_back({.corner = {at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)}});
        }
    EXPECT_TRUE(OuterPlanes(pieces_of(t)).empty());
    EXPECT_TRUE(OuterPlanes(std::span<const Piece>()).empty());
}

TEST(OuterPlanes, AreNotTheInnerWallsOfACorner) {
    // An L: the walls at x = 3 and y = 3 have a part of the room behind them.
    const std::array<std::array<double, 2>, 6> corners{
        {{0, 0}, {9, 0}, {9, 3}, {3, 3}, {3, 9}, {0, 9}}};
    std::vector<CasterTriangle> t;
    for (std::size_t k = 0; k < 6; ++k) {
        const auto& [x0, y0] = corners[k];
        const auto& [x1, y1] = corners[(k + 1) % 6];
        add_rectangle(
            t, {turned(x0, y0, 0), turned(x1, y1, 0), turned(x1, y1, 3), turned(x0, y0, 3)});
    }
    for (const double z : {0.0, 3.0}) {
        add_rectangle(t, {turned(0, 0, z), turned(9, 0, z), turned(9, 3, z), turned(0, 3, z)});
        add_rectangle(t, {turned(0, 3, z), turned(3, 3, z), turned(3, 9, z), turned(0, 9, z)});
    }
    const std::vector<Piece> pieces = pieces_of(t);
    const OuterPlanes planes(pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const bool is_inner = i / 2 == 2 || i / 2 == 3;
        EXPECT_EQ(planes.hold(pieces[i]), !is_inner) << i;
    }
    EXPECT_EQ(RayCaster(t).transmittance(turned(8, 1, 1), turned(1, 8, 1)), 0.0);
    EXPECT_EQ(RayCaster(t).transmittance(turned(8, 1, 1), turned(1, 1, 1)), 1.0);
}

/// The same triangles and large ones anywhere far away: no plane has next to nothing beyond it,
/// so all of them are traced.
RayCaster plain_caster(std::vector<CasterTriangle> triangles) {
    std::mt19937_64 random(6);
    std::normal_distribution<double> anywhere;
    const auto vector = [&](double size) {
        return size
               * Vector3(
                   UnitVector3(Vector3{anywhere(random), anywhere(random), anywhere(random)}));
    };
    for (int i = 0; i < 200; ++i) {
        const Point3 p = Point3{} + vector(400.0);
        triangles.push_back({.corner = {p, p + vector(30.0), p + vector(30.0)}});
    }
    EXPECT_TRUE(OuterPlanes(pieces_of(triangles)).empty());
    return RayCaster(triangles);
}

TEST(OuterPlanes, ChangeNothingOfWhatIsSeen) {
    std::vector<CasterTriangle> triangles = furnished_room();
    CasterTriangle pane{.is_pane = true}; // a window in the wall x = 8 and a screen
    pane.corner = {turned(8, 1, 1), turned(8, 5, 1), turned(8, 5, 2)};
    triangles.push_back(pane);
    pane.corner = {turned(5, 3, 0.5), turned(7, 4, 0.5), turned(6, 3.5, 2.5)};
    triangles.push_back(pane);
    const RayCaster caster(triangles);
    const RayCaster plain = plain_caster(triangles);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> place(-0.1, 1.1);
    int blocked = 0, dimmed = 0, seen = 0;
    for (int i = 0; i < 4000; ++i) {
        // Every third packet has points anywhere, outside and in the niche, too; in the others
        // they lie inside or, every fifth of them, in the ceiling, as openings do.
        const auto somewhere = [&] {
            const auto at = [&](double size) {
                const double s = place(random);
                return size * (i % 3 == 0 ? s : std::clamp(s, 1e-3, 1.0 - 1e-3));
            };
            return turned(at(8.0), at(6.0), at(3.0));
        };
        std::array<SightSegment, packet_size> segments;
        for (SightSegment& s : segments) {
            s = {somewhere(), somewhere()};
            if (i % 3 != 0 && random() % 5 == 0)
                s.b.z = 3.0;
        }
        std::array<float, packet_size> found{}, expected{};
        caster.transmittance16(segments, 0xffffU, found, RayOrder::scattered);
        plain.transmittance16(segments, 0xffffU, expected, RayOrder::scattered);
        for (std::size_t k = 0; k < packet_size; ++k) {
            ASSERT_NEAR(found[k], expected[k], 1e-4) << i << ' ' << k;
            ASSERT_NEAR(caster.transmittance(segments[k].a, segments[k].b), expected[k], 1e-4);
            blocked += expected[k] == 0.0F;
            dimmed += expected[k] > 0.0F && expected[k] < 1.0F;
            seen += expected[k] == 1.0F;
        }
    }
    EXPECT_GT(blocked, 10000);
    EXPECT_GT(dimmed, 500);
    EXPECT_GT(seen, 10000);
}

TEST(OuterPlanes, StopLightThatComesFromBehindThem) {
    // One wall alone is a plane with nothing beyond it, whichever side one calls that.
    std::vector<CasterTriangle> wall;
    add_rectangle(wall, {turned(0, 0, 0), turned(4, 0, 0), turned(4, 0, 3), turned(0, 0, 3)});
    ASSERT_FALSE(OuterPlanes(pieces_of(wall)).empty());
    const RayCaster alone(wall);
    EXPECT_EQ(alone.transmittance(turned(2, -1, 1), turned(2, 1, 1)), 0.0);
    EXPECT_EQ(alone.transmittance(turned(2, 1, 1), turned(2, -1, 1)), 0.0);
    EXPECT_EQ(alone.transmittance(turned(1, 1, 1), turned(2, 1, 1)), 1.0);
    EXPECT_EQ(alone.transmittance(turned(1, -1, 1), turned(2, -1, 1)), 1.0);

    // A hall of 200 m: a millimetre and an offset behind its floor and its walls.
    std::vector<CasterTriangle> hall;
    add_box(hall, {0, 0, 0}, {200, 150, 6});
    const RayCaster caster(hall);
    const Point3 inside = turned(90, 70, 2);
    const Point3 below = caster.offset_point(turned(91, 71, 0), Vector3{0, 0, -1});
    const std::array<SightSegment, 4> segments{{{below, inside},
                                                {turned(91, 71, -1e-3), inside},
                                                {turned(200.001, 70, 2), inside},
                                                {inside, turned(20, 10, 1)}}};
    std::array<float, 4> seen{};
    caster.transmittance16(segments, 0xfU, seen, RayOrder::scattered);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(seen[k], k == 3 ? 1.0F : 0.0F) << k;
        EXPECT_EQ(caster.transmittance(segments[k].a, segments[k].b), k == 3 ? 1.0 : 0.0) << k;
    }
}

TEST(OuterPlanes, MayBeOfGlass) {
    std::vector<CasterTriangle> box;
    add_box(box, {0, 0, 0}, {4, 3, 2});
    for (CasterTriangle& t : box)
        t.is_pane = true;
    const RayCaster caster(box);
    EXPECT_EQ(caster.transmittance(turned(1, 1, 1), turned(3, 2, 1)), 1.0);
    const double through = caster.transmittance(turned(1, 1, 1), turned(1, 1, 3));
    EXPECT_GT(through, 0.5);
    EXPECT_LT(through, 1.0);
}

} // namespace
} // namespace isolux
