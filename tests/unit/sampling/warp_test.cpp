#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/polygon.h"
#include "isolux/sampling/random_stream.h"
#include "isolux/sampling/warp.h"

#include "support/statistics.h"

namespace isolux {
namespace {

using std::numbers::pi;

constexpr std::uint32_t draws = 1 << 16;
constexpr double last = 1.0 - 0x1.0p-32; // the largest number a stream gives

/// Counts which cell `cell_of(u, v)` a uniform pair falls into and compares with the
/// probabilities of the cells. Cells too rare for the chi-square test are pooled.
template <class F>
double cell_tail(const std::vector<double>& probability, F&& cell_of, std::uint32_t seed = 0) {
    const RandomStream stream(seed, StreamPurpose::test, 0);
    std::vector<double> counts(probability.size());
    for (std::uint32_t i = 0; i < draws; ++i)
        counts[cell_of(stream.uniform(i, 0), stream.uniform(i, 1))] += 1.0;
    std::vector<double> observed{0.0}, expected{0.0};
    for (std::size_t c = 0; c < counts.size(); ++c) {
        const double e = probability[c] * draws;
        if (e == 0.0) {
            EXPECT_EQ(counts[c], 0.0) << "impossible cell " << c;
        } else if (e < 20.0) {
            observed[0] += counts[c];
            expected[0] += e;
        } else {
            observed.push_back(counts[c]);
            expected.push_back(e);
        }
    }
    if (expected[0] < 5.0) {
        observed.erase(observed.begin());
        expected.erase(expected.begin());
    }
    return test::chi_square_tail(observed, expected);
}

std::size_t part(double x, std::size_t parts) {
    return static_cast<std::size_t>(
        std::clamp(x * static_cast<double>(parts), 0.0, parts - 1.0));
}

double area_of(const std::vector<Point3>& p) {
    Vector3 sum;
    for (std::size_t k = 2; k < p.size(); ++k)
        sum = sum + cross(p[k - 1] - p[0], p[k] - p[0]);
    return 0.5 * length(sum);
}

double azimuth_part(const Vector3& w) { return 0.5 + std::atan2(w.y, w.x) / (2.0 * pi); }

TEST(CosineHemisphere, HasItsDensity) {
    // sin^2 of the polar angle is uniform under cos/pi: 16 x 16 cells of equal probability.
    const std::vector<double> equal(256, 1.0 / 256.0);
    EXPECT_GT(cell_tail(equal,
                        [](double u, double v) {
                            const Vector3 w = sample_cosine_hemisphere(u, v);
                            EXPECT_NEAR(length(w), 1.0, 1e-15);
                            EXPECT_GT(w.z, 0.0);
                            return 16 * part(1.0 - w.z * w.z, 16) + part(azimuth_part(w), 16);
                        }),
              test::chi_square_false_alarm);
}

TEST(CosineHemisphere, DensityIntegratesToOneAndIsZeroBelow) {
    constexpr int n = 1000; // midpoint rule in the cosine: exact for a linear function
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        sum += pdf_cosine_hemisphere((i + 0.5) / n) * 2.0 * pi / n;
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_EQ(pdf_cosine_hemisphere(-0.5), 0.0);
}

TEST(Sphere, IsUniform) {
    const std::vector<double> equal(256, 1.0 / 256.0);
    EXPECT_GT(cell_tail(equal,
                        [](double u, double v) {
                            const Vector3 w = sample_sphere(u, v);
                            EXPECT_NEAR(length(w), 1.0, 1e-15);
                            return 16 * part(0.5 + 0.5 * w.z, 16) + part(azimuth_part(w), 16);
                        }),
              test::chi_square_false_alarm);
}

TEST(SamplePolygon, IsUniformOverTheArea) {
    const std::vector<std::vector<Point3>> shapes = {
        {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1}},                 // rectangle
        {{0, 0, 1}, {2, 0.5, 1}, {1, 2, 1}},                          // triangle
        {{0, 0, 1}, {2, 0, 1}, {1.5, 1, 1}, {0.2, 0.9, 1}},           // quadrilateral
        {{0.5, 0, 1}, {1.5, 0, 1}, {2, 1, 1}, {1, 2, 1}, {0, 1, 1}}}; // pentagon
    for (const std::vector<Point3>& shape : shapes) {
        constexpr std::size_t side = 8; // cells over the square [0, 2] x [0, 2]
        std::vector<double> probability(side * side);
        for (std::size_t i = 0; i < side; ++i)
            for (std::size_t j = 0; j < side; ++j) {
                const double x = 2.0 * static_cast<double>(i) / side;
                const double y = 2.0 * static_cast<double>(j) / side;
                auto cell = clip_to_half_space(shape, {x, 0, 0}, {1, 0, 0});
                cell = clip_to_half_space(cell, {x + 2.0 / side, 0, 0}, {-1, 0, 0});
                cell = clip_to_half_space(cell, {0, y, 0}, {0, 1, 0});
                cell = clip_to_half_space(cell, {0, y + 2.0 / side, 0}, {0, -1, 0});
                probability[i * side + j] = cell.empty() ? 0.0 : area_of(cell) / area_of(shape);
            }
        EXPECT_GT(cell_tail(probability,
                            [&](double u, double v) {
                                const Point3 p = sample_polygon(shape, u, v);
                                EXPECT_NEAR(p.z, 1.0, 1e-15);
                                return side * part(p.x / 2.0, side) + part(p.y / 2.0, side);
                            }),
                  test::chi_square_false_alarm)
            << shape.size() << " corners";
    }
}

TEST(SampleFan, GoesToTheSamePlacesAsThePolygon) {
    const std::vector<Point3> p = {{0.5, 0, 1}, {1.5, 0, 1}, {2, 1, 1}, {1, 2, 1}, {0, 1, 1}};
    std::vector<double> running;
    for (std::size_t k = 1; k + 1 < p.size(); ++k)
        running.push_back((running.empty() ? 0.0 : running.back())
                          + 0.5 * length(cross(p[k] - p[0], p[k + 1] - p[0])));
    for (const double u : {0.0, 0.1, 0.3, 0.5, 0.77, 0x1.fffffffffffffp-1})
        for (const double v : {0.0, 0.4, 0.9})
            EXPECT_LT(distance(sample_fan(p, running, u, v), sample_polygon(p, u, v)), 1e-7)
                << u << ' ' << v;
}

TEST(SamplePolygon, OfAParallelogramKeepsNeighboursTogether) {
    const std::vector<Point3> p = {{1, 1, 0}, {3, 1, 1}, {4, 3, 1}, {2, 3, 0}};
    EXPECT_LT(distance(sample_polygon(p, 0.25, 0.5), {2.0, 2.0, 0.25}), 1e-14);
}

struct View {
    Point3 corner;
    Vector3 edge_u;
    Vector3 edge_v;
    Point3 eye;
};

/// Near, far, askew, oblique, and with the foot of the perpendicular inside or outside.
const std::vector<View> views = {
    {{-0.5, -0.5, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}},
    {{-0.5, -0.5, 1}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.2, 0.98}},
    {{2, 3, 0.2}, {1.5, 0, 0}, {0, 0.4, 0}, {0, 0, 0}},
    {{1, 0, 0}, {0, 2, 0}, {0, 0, 2.5}, {0, 0, 0}},
    {{0.2, -0.3, 0.7}, {0.6, 0.8, 0}, {-0.4, 0.3, 1.2}, {-1.1, 0.4, -0.2}},
    {{-3, -40, 2}, {6, 0, 0}, {0, 80, 0}, {0.5, 35, 0}},
    {{10, 10, 10}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 0}},
};

std::vector<Point3> outline(const View& w) {
    return {w.corner, w.corner + w.edge_u, w.corner + w.edge_u + w.edge_v, w.corner + w.edge_v};
}

Point3 at(const View& w, double s, double t) { return w.corner + s * w.edge_u + t * w.edge_v; }

TEST(SphericalRectangle, HasTheSolidAngleOfThePolygon) {
    for (const View& w : views) {
        const SphericalRectangle r(w.corner, w.edge_u, w.edge_v, w.eye);
        EXPECT_NEAR(r.solid_angle(), solid_angle(outline(w), w.eye), 1e-13);
    }
}

TEST(SphericalRectangle, IsUniformInSolidAngle) {
    constexpr std::size_t side = 8;
    for (std::size_t k = 0; k < views.size(); ++k) {
        const View& w = views[k];
        const SphericalRectangle r(w.corner, w.edge_u, w.edge_v, w.eye);
        std::vector<double> probability(side * side);
        for (std::size_t i = 0; i < side; ++i)
            for (std::size_t j = 0; j < side; ++j) {
                const View cell{at(w, double(i) / side, double(j) / side),
                                w.edge_u / double(side),
                                w.edge_v / double(side),
                                w.eye};
                probability[i * side + j] = solid_angle(outline(cell), w.eye) / r.solid_angle();
            }
        EXPECT_GT(cell_tail(probability,
                            [&](double u, double v) {
                                const Vector3 d = r.sample(u, v) - w.corner;
                                const double s = dot(d, w.edge_u) / length_squared(w.edge_u);
                                const double t = dot(d, w.edge_v) / length_squared(w.edge_v);
                                EXPECT_LE(std::abs(s - 0.5), 0.5 + 1e-12);
                                EXPECT_LE(std::abs(t - 0.5), 0.5 + 1e-12);
                                return side * part(s, side) + part(t, side);
                            }),
                  test::chi_square_false_alarm)
            << "view " << k;
    }
}

TEST(SphericalRectangle, AgreesWithAreaSamplingForASmoothFunction) {
    // Luminance 1 + x^2 of the point seen, weighted by the receiver's cosine.
    const auto f = [](const Point3& p) { return 1.0 + p.x * p.x; };
    for (std::size_t k = 0; k < views.size(); ++k) {
        const View& w = views[k];
        const UnitVector3 n(Vector3{0.3, 0.2, 0.9});
        const SphericalRectangle r(w.corner, w.edge_u, w.edge_v, w.eye);
        const UnitVector3 face(cross(w.edge_u, w.edge_v));
        const double area = length(cross(w.edge_u, w.edge_v));
        const Estimate difference = test::over_seeds([&](std::size_t seed) {
            const RandomStream stream(seed, StreamPurpose::test, 1);
            double sum = 0.0;
            constexpr int count = 512;
            for (int i = 0; i < count; ++i) {
                const auto x = stream.uniform4(static_cast<std::uint64_t>(i), 0);
                const Point3 p = r.sample(x[0], x[1]);
                const Vector3 d = p - w.eye;
                sum += r.solid_angle() * f(p) * std::max(0.0, dot(n, d) / length(d));
                const Point3 q = at(w, x[2], x[3]);
                const Vector3 e = q - w.eye;
                const double e2 = length_squared(e);
                sum -=
                    area * f(q) * std::abs(dot(face, e)) * std::max(0.0, dot(n, e)) / (e2 * e2);
            }
            return sum / count;
        });
        EXPECT_LT(std::abs(test::z_score(difference, 0.0)), test::z_limit) << "view " << k;
    }
}

TEST(SphericalRectangle, MeanInverseDensityIsTheArea) {
    // Density per area of the sample is cos/(Omega d^2).
    for (std::size_t k = 0; k < views.size(); ++k) {
        const View& w = views[k];
        if (k == 1 || k == 5)
            continue; // seen at grazing angles 1/density has no useful variance
        const SphericalRectangle r(w.corner, w.edge_u, w.edge_v, w.eye);
        const UnitVector3 face(cross(w.edge_u, w.edge_v));
        const Estimate mean = test::over_seeds([&](std::size_t seed) {
            const RandomStream stream(seed, StreamPurpose::test, 2);
            double sum = 0.0;
            constexpr int count = 512;
            for (int i = 0; i < count; ++i) {
                const auto x = stream.uniform4(static_cast<std::uint64_t>(i), 0);
                const Vector3 d = r.sample(x[0], x[1]) - w.eye;
                sum += r.solid_angle() * std::pow(length(d), 3) / std::abs(dot(face, d));
            }
            return sum / count;
        });
        const double area = length(cross(w.edge_u, w.edge_v));
        EXPECT_LT(std::abs(test::z_score(mean, area)), test::z_limit) << "view " << k;
    }
}

TEST(SphericalRectangle, EndsOfTheUnitSquareStayOnTheRectangle) {
    for (const View& w : views)
        for (const double u : {0.0, 0.5, last})
            for (const double v : {0.0, 0.5, last}) {
                const Point3 p =
                    SphericalRectangle(w.corner, w.edge_u, w.edge_v, w.eye).sample(u, v);
                const Vector3 d = p - w.corner;
                const double s = dot(d, w.edge_u) / length_squared(w.edge_u);
                const double t = dot(d, w.edge_v) / length_squared(w.edge_v);
                EXPECT_TRUE(s > -1e-12 && s < 1 + 1e-12 && t > -1e-12 && t < 1 + 1e-12);
                EXPECT_LT(std::abs(t - v), v == 0.5 ? 0.5 : 1e-6) << "v runs along edge_v";
            }
}

TEST(SphericalRectangle, IsNearlyHalfASphereFromRightAboveIt) {
    for (const double height : {1e-9, 1e-6, 1e-3, 0.1, 0.3})
        for (const double x : {1e-4, 0.1, 0.5}) {
            const View w{{0, 0, 0}, {0, 1, 0}, {2, 0, 0}, {x, 0.3, height}};
            const SphericalRectangle r(w.corner, w.edge_u, w.edge_v, w.eye);
            EXPECT_NEAR(r.solid_angle(),
                        solid_angle(outline(w), w.eye),
                        std::max(1e-13, 1e-15 / height));
        }
}

TEST(SphericalRectangle, IsAlmostNothingFromFarAway) {
    for (const double away : {1e3, 1e5, 1e7, 1e9, 1e11})
        for (const double aside : {0.0, 0.5, 30.0}) {
            const SphericalRectangle r({aside, -0.4, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, away});
            EXPECT_NEAR(r.solid_angle(), 1.0 / (away * away), 2e-3 / (away * away) + 2e-15);
        }
}

TEST(SphericalRectangle, SeenFromItsPlaneIsNothing) {
    EXPECT_EQ(SphericalRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 3, 0}).solid_angle(),
              0.0);
    EXPECT_EQ(SphericalRectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}).solid_angle(),
              0.0);
}

struct Corners {
    Point3 a, b, c;
};

/// Seen from the origin: an octant, a small one, a slender one, one over the half sphere, both
/// senses of rotation.
const std::vector<Corners> triangles = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {{1, 0.1, 5}, {0.7, 0.4, 5}, {1.1, 0.5, 5}},
    {{-4, 0.1, 1}, {4, 0.2, 1}, {0.2, 1.3, 1}},
    {{-2, -1.5, 0.1}, {2.5, -1, 0.1}, {0.1, 3, 0.1}},
    {{0.3, -2, 0.4}, {0.5, 0.3, 0.9}, {-0.4, 0.6, 0.3}},
};

Point3 between(const Corners& t, double wb, double wc) {
    return t.a + wb * (t.b - t.a) + wc * (t.c - t.a);
}

TEST(SphericalTriangle, HasTheSolidAngleOfThePolygon) {
    const Point3 origin{};
    for (const Corners& t : triangles) {
        const SphericalTriangle s(
            UnitVector3(t.a - origin), UnitVector3(t.b - origin), UnitVector3(t.c - origin));
        EXPECT_NEAR(
            s.solid_angle(), solid_angle(std::vector<Point3>{t.a, t.b, t.c}, origin), 1e-13);
    }
    const UnitVector3 x(Vector3{1, 0, 0}), y(Vector3{0, 1, 0}), z(Vector3{0, 0, 1});
    EXPECT_NEAR(SphericalTriangle(x, y, z).solid_angle(), pi / 2, 1e-15);
    EXPECT_NEAR(
        SphericalTriangle(x, y, UnitVector3(Vector3{1, 1, 0})).solid_angle(), 0.0, 1e-15);
}

TEST(SphericalTriangle, IsUniformInSolidAngle) {
    // Cells: the flat triangle cut by lines parallel to two of its sides.
    constexpr std::size_t side = 6;
    const Point3 origin{};
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const Corners& t = triangles[k];
        const SphericalTriangle s(
            UnitVector3(t.a - origin), UnitVector3(t.b - origin), UnitVector3(t.c - origin));
        std::vector<double> probability(side * side);
        for (std::size_t i = 0; i < side; ++i)
            for (std::size_t j = 0; i + j < side; ++j) {
                const double x = double(i) / side, y = double(j) / side, h = 1.0 / side;
                std::vector<Point3> cell = {between(t, x, y),
                                            between(t, x + h, y),
                                            between(t, x + h, y + h),
                                            between(t, x, y + h)};
                if (i + j + 1 == side)
                    cell.erase(cell.begin() + 2);
                probability[i * side + j] = solid_angle(cell, origin) / s.solid_angle();
            }
        const Vector3 n = cross(t.b - t.a, t.c - t.a);
        EXPECT_GT(cell_tail(probability,
                            [&](double u, double v) {
                                const Vector3 w = s.sample(u, v);
                                EXPECT_NEAR(length(w), 1.0, 1e-14);
                                const Vector3 p =
                                    (dot(n, t.a - origin) / dot(n, w)) * w - (t.a - origin);
                                const double wb = dot(n, cross(p, t.c - t.a)) / dot(n, n);
                                const double wc = dot(n, cross(t.b - t.a, p)) / dot(n, n);
                                const std::size_t i = part(wb, side);
                                return side * i + std::min(part(wc, side), side - 1 - i);
                            }),
                  test::chi_square_false_alarm)
            << "triangle " << k;
    }
}

TEST(SphericalTriangle, MeanCosineIsTheProjectedSolidAngle) {
    const Point3 origin{};
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const Corners& t = triangles[k];
        const SphericalTriangle s(
            UnitVector3(t.a - origin), UnitVector3(t.b - origin), UnitVector3(t.c - origin));
        for (const UnitVector3& n :
             {UnitVector3(Vector3{0.1, 0.2, 1}), UnitVector3(Vector3{1, -0.5, 0.1})}) {
            const Estimate mean = test::over_seeds([&](std::size_t seed) {
                const RandomStream stream(seed, StreamPurpose::test, 3);
                double sum = 0.0;
                constexpr int count = 512;
                for (int i = 0; i < count; ++i) {
                    const auto x = stream.uniform4(static_cast<std::uint64_t>(i), 0);
                    sum += std::max(0.0, dot(n, s.sample(x[0], x[1])));
                }
                return s.solid_angle() * sum / count;
            });
            const double exact =
                projected_solid_angle(std::vector<Point3>{t.a, t.b, t.c}, origin, n);
            EXPECT_LT(std::abs(test::z_score(mean, exact)), test::z_limit) << "triangle " << k;
        }
    }
}

TEST(SphericalTriangle, EndsOfTheUnitSquareReachTheCorners) {
    const UnitVector3 a(Vector3{1, 0.2, 0.1}), b(Vector3{0, 1, 0.3}), c(Vector3{0.1, 0.2, 1});
    const SphericalTriangle s(a, b, c);
    EXPECT_LT(length(s.sample(0.0, 0.0) - Vector3(b)), 1e-12);
    EXPECT_LT(length(s.sample(0.5, 0.0) - Vector3(b)), 1e-12);
    // The corner formula divides 0 by 0 at u = 0; just above it the arc ends at A.
    EXPECT_LT(length(s.sample(0x1.0p-32, last) - Vector3(a)), 1e-4);
    EXPECT_LT(length(s.sample(0.0, last) - Vector3(a)), 1e-4);
    EXPECT_LT(length(s.sample(last, last) - Vector3(c)), 1e-4);
}

TEST(SolidAngle, OfBoxFacesSumsToTheWholeSphere) {
    const Point3 p[8] = {
        {0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}};
    const int faces[6][4] = {
        {0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    double sum = 0.0;
    for (const auto& f : faces)
        sum += solid_angle(std::vector<Point3>{p[f[0]], p[f[1]], p[f[2]], p[f[3]]},
                           {0.2, 1.9, 1.4});
    EXPECT_NEAR(sum, 4.0 * pi, 1e-13);
    EXPECT_EQ(solid_angle(std::vector<Point3>{p[0], p[1], p[2], p[3]}, {5, 5, 0}), 0.0);
}

TEST(SampleCumulative, DrawsByWeightAndNeverAnEmptyEntry) {
    const std::vector<double> weights = {0, 2, 0, 0, 5, 1, 0.5, 0};
    std::vector<double> cumulative, probability;
    double sum = 0.0;
    for (const double w : weights)
        cumulative.push_back(sum += w);
    for (const double w : weights)
        probability.push_back(w / sum);
    EXPECT_GT(
        cell_tail(probability,
                  [&](double u, double) { return sample_cumulative(cumulative, u).index; }),
        test::chi_square_false_alarm);
    EXPECT_EQ(sample_cumulative(cumulative, 0.0).index, 1u);
    EXPECT_EQ(sample_cumulative(cumulative, last).index, 6u);
    EXPECT_EQ(sample_cumulative(cumulative, std::nextafter(1.0, 0.0)).index, 6u);
}

TEST(CumulativeTable, DrawsWhatTheSumsAloneWouldGive) {
    const RandomStream stream(4, StreamPurpose::test, 0);
    for (const std::size_t entries : {1U, 2U, 3U, 64U, 1000U}) {
        std::vector<double> sums;
        double sum = 0.0;
        for (std::size_t i = 0; i < entries; ++i) {
            const auto x = stream.uniform4(i, static_cast<std::uint32_t>(entries));
            // many of nothing, some of much
            sums.push_back(sum += entries > 3 && x[0] < 0.7 ? 0.0 : std::pow(x[1], 9.0));
        }
        const CumulativeTable table(sums);
        const auto agrees = [&](double u) {
            const DiscreteSample a = table.sample(u);
            const DiscreteSample b = sample_cumulative(sums, u);
            return a.index == b.index && a.stretched == b.stretched;
        };
        for (std::uint32_t i = 0; i < 20000; ++i)
            ASSERT_TRUE(agrees(stream.uniform(i, 7))) << entries;
        for (std::size_t i = 0; i < entries; ++i) // right at the borders, and next to them
            for (const double u : {sums[i] / sum, std::nextafter(sums[i] / sum, 0.0)})
                ASSERT_TRUE(u >= 1.0 || agrees(u)) << entries;
        ASSERT_TRUE(agrees(0.0) && agrees(last)) << entries;
    }
}

TEST(SampleCumulative, StretchesTheRestToTheWholeInterval) {
    const std::vector<double> cumulative = {1, 4, 4, 8};
    EXPECT_DOUBLE_EQ(sample_cumulative(cumulative, 0.3125).stretched, 0.5); // 2.5 of [1, 4)
    EXPECT_DOUBLE_EQ(sample_cumulative(cumulative, 0.5).stretched, 0.0);
    EXPECT_LT(sample_cumulative(cumulative, std::nextafter(1.0, 0.0)).stretched, 1.0);
    const std::vector<double> equal(10, 0.1);
    EXPECT_GT(cell_tail(equal,
                        [&](double u, double) {
                            return part(sample_cumulative(cumulative, u).stretched, 10);
                        }),
              test::chi_square_false_alarm);
}

} // namespace
} // namespace isolux
