#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/response.h"
#include "isolux/transport/vertex_kernel.h"

namespace isolux {
namespace {

constexpr std::size_t receivers = 5;

/// Three blocks of random vertices about the origin, the last one not full.
std::vector<VertexBlock> make_blocks() {
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> u(-1.0F, 1.0F);
    std::vector<VertexBlock> blocks(3);
    for (VertexBlock& b : blocks) {
        b.rows = &b == &blocks.back() ? 5 : 16;
        b.lower = {-3.0F, -3.0F, -3.0F};
        b.upper = {3.0F, 3.0F, 3.0F};
        for (std::size_t i = 0; i < b.rows * VertexBlock::columns; ++i) {
            b.x[i] = 3.0F * u(engine), b.y[i] = 3.0F * u(engine), b.z[i] = 3.0F * u(engine);
            const UnitVector3 n(Vector3{u(engine), u(engine), u(engine) + 0.01F});
            b.nx[i] = static_cast<float>(n.x()), b.ny[i] = static_cast<float>(n.y()),
            b.nz[i] = static_cast<float>(n.z());
            b.strength[i] = 1.0F + u(engine);
            b.rival[i] = 0.5F * (1.0F + u(engine));
        }
    }
    return blocks;
}

Receiver make_receiver(IlluminanceKind kind, std::size_t i) {
    const double t = static_cast<double>(i);
    return {{0.3 * t - 0.6, 0.2 * t, 0.1 - 0.2 * t},
            UnitVector3({0.2 * t, -0.3, 1.0}),
            kind,
            UnitVector3({1.0, 0.4, 0.1 * t})};
}

KernelReceiver to_kernel(const Receiver& r) {
    const Vector3 f = Vector3(r.reference) - dot(r.reference, r.axis) * Vector3(r.axis);
    const UnitVector3 across(f);
    const auto narrow = [](double x, double y, double z) {
        return std::array<float, 3>{
            static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    };
    return {narrow(r.point.x, r.point.y, r.point.z),
            narrow(r.axis.x(), r.axis.y(), r.axis.z()),
            narrow(across.x(), across.y(), across.z())};
}

/// METHODS eq. (5), (9), (10) straight from their definitions, in double.
double expected(
    const VertexBlock& b, std::size_t i, const Receiver& r, float rays, Weighting weighting) {
    const Vector3 d = Point3{b.x[i], b.y[i], b.z[i]} - r.point;
    const UnitVector3 w(d);
    const double cos_vertex = std::max(0.0, -dot(Vector3{b.nx[i], b.ny[i], b.nz[i]}, w));
    const double solid = cos_vertex / length_squared(d);
    const double value = b.strength[i] * evaluate_response(r, w) * solid;
    if (weighting == Weighting::alone)
        return value;
    // rival = n2 / (pi n1 p1) of one gather ray
    const double gather = std::numbers::pi * rays * b.rival[i] * pdf_response(r, w) * solid;
    return value / (1.0 + gather);
}

struct Case {
    IlluminanceKind kind;
    Weighting weighting;
};

class VertexKernel : public testing::TestWithParam<Case> {};

TEST_P(VertexKernel, AgreesWithTheDefinitionInDoublePrecision) {
    const auto [kind, weighting] = GetParam();
    const std::vector<VertexBlock> blocks = make_blocks();
    std::vector<Receiver> exact;
    std::vector<KernelReceiver> points;
    for (std::size_t r = 0; r < receivers; ++r) {
        exact.push_back(make_receiver(kind, r));
        points.push_back(to_kernel(exact.back()));
        points.back().rays = static_cast<float>(3 * r); // the first one gathers nothing
    }
    std::vector<float> u(receivers * blocks.size() * VertexBlock::size, -1.0F);
    std::vector<float> sums(receivers * blocks.size() * VertexBlock::columns, -1.0F);
    weigh_vertices(blocks, kind, weighting, points, u, sums);
    for (std::size_t r = 0; r < receivers; ++r)
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            const std::size_t place = r * blocks.size() + b;
            std::vector<double> columns(VertexBlock::columns, 0.0);
            for (std::size_t i = 0; i < blocks[b].rows * VertexBlock::columns; ++i) {
                const double e = expected(blocks[b], i, exact[r], points[r].rays, weighting);
                // Single precision: the cosines lose up to 1e-6 of a unit.
                ASSERT_NEAR(u[place * VertexBlock::size + i], e, 1e-5 * e + 2e-6) << i;
                columns[i % VertexBlock::columns] += e;
            }
            for (std::size_t c = 0; c < VertexBlock::columns; ++c)
                EXPECT_NEAR(sums[place * VertexBlock::columns + c],
                            columns[c],
                            1e-5 * columns[c] + 2e-5);
        }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds,
    VertexKernel,
    testing::Values(Case{IlluminanceKind::planar, Weighting::alone},
                    Case{IlluminanceKind::planar, Weighting::balanced},
                    Case{IlluminanceKind::cylindrical, Weighting::alone},
                    Case{IlluminanceKind::cylindrical, Weighting::balanced},
                    Case{IlluminanceKind::semi_cylindrical, Weighting::balanced},
                    Case{IlluminanceKind::hemispherical, Weighting::balanced},
                    Case{IlluminanceKind::mean_spherical, Weighting::balanced}));

TEST(VertexKernelAlone, GivesAReceiverTheSameBitsInAnyCompany) {
    const std::vector<VertexBlock> blocks = make_blocks();
    std::vector<KernelReceiver> points;
    for (std::size_t r = 0; r < receivers; ++r)
        points.push_back(to_kernel(make_receiver(IlluminanceKind::planar, r)));
    const std::size_t one = blocks.size() * VertexBlock::columns;
    std::vector<float> u(receivers * blocks.size() * VertexBlock::size);
    std::vector<float> together(receivers * one), alone(one);
    weigh_vertices(blocks, IlluminanceKind::planar, Weighting::balanced, points, u, together);
    for (std::size_t r = 0; r < receivers; ++r) {
        weigh_vertices(
            blocks, IlluminanceKind::planar, Weighting::balanced, {&points[r], 1}, u, alone);
        for (std::size_t k = 0; k < one; ++k)
            ASSERT_EQ(together[r * one + k], alone[k]);
    }
}

TEST(VertexKernelAlone, SkipsBlocksThatCannotLightAReceiver) {
    std::vector<VertexBlock> blocks = make_blocks();
    blocks.resize(1);
    VertexBlock& b = blocks.front();
    for (std::size_t i = 0; i < VertexBlock::size; ++i) // all below, looking up
        b.z[i] = -1.0F, b.nx[i] = b.ny[i] = 0.0F, b.nz[i] = 1.0F;
    b.lower[2] = b.upper[2] = -1.0F;
    b.common_normal = {0.0F, 0.0F, 1.0F};
    const auto total = [&](const KernelReceiver& r) {
        std::vector<float> u(VertexBlock::size, 77.0F);
        std::vector<float> sums(VertexBlock::columns, 77.0F);
        weigh_vertices(blocks, IlluminanceKind::planar, Weighting::alone, {&r, 1}, u, sums);
        float sum = 0.0F;
        for (const float s : sums)
            sum += s;
        return sum;
    };
    EXPECT_EQ(total({{0, 0, 0}, {0, 0, 1}, {}}), 0.0F);  // they lie behind its plane
    EXPECT_EQ(total({{0, 0, -2}, {0, 0, 1}, {}}), 0.0F); // it lies behind theirs
    EXPECT_GT(total({{0, 0, 0}, {0, 0, -1}, {}}), 0.0F);
}

} // namespace
} // namespace isolux
