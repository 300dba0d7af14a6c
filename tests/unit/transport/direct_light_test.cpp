#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/estimate.h"
#include "isolux/base/polygon.h"
#include "isolux/transport/direct_light.h"

#include "support/test_scene.h"

namespace isolux {
namespace {

constexpr std::size_t replicates = 16;
constexpr std::uint32_t units = 64;
constexpr double luminance = 1000.0; // cd/m2, of a panel of 1 m2

/// A sheet hides what lies beyond `edge` of the panel, along x or along y.
struct Shadow {
    double edge;
    bool is_along_x;
};

/// A panel 2 m above the receiver, a black sheet halfway.
class DirectLightPastAnEdge : public testing::TestWithParam<Shadow> {
protected:
    DirectLightPastAnEdge() {
        const double e = 0.5 * GetParam().edge;
        const Point3 corner = GetParam().is_along_x ? Point3{e, -5, 1} : Point3{-5, e, 1};
        test::Builder builder;
        builder.add_quad(corner, {10, 0, 0}, {0, 10, 0}, builder.add_diffuse(0));
        builder.add_panel({-0.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}, luminance * std::numbers::pi);
        scene_.push_back(builder.build());
    }

    /// Of the part of the panel below `edge`, lx.
    [[nodiscard]] double light_below(double edge) const {
        const double x = GetParam().is_along_x ? edge : 0.5;
        const double y = GetParam().is_along_x ? 0.5 : edge;
        const std::vector<Point3> part{{-0.5, -0.5, 2}, {x, -0.5, 2}, {x, y, 2}, {-0.5, y, 2}};
        return luminance * projected_solid_angle(part, receiver_.point, receiver_.axis);
    }

    /// Mean of `count` units for each replicate, lx.
    [[nodiscard]] Estimate estimate(std::uint32_t count) const {
        const Emission emission(scene_.front());
        const MirrorImages images(scene_.front());
        const DirectLight direct(scene_.front(), emission, images);
        std::vector<double> sums(replicates, 0.0);
        std::vector<Rgb> values(replicates);
        std::uint64_t rays = 0;
        for (std::uint32_t unit = 0; unit < count; ++unit) {
            direct.estimate(receiver_, 0, 1, unit, 0, values, rays);
            for (std::size_t r = 0; r < replicates; ++r)
                sums[r] += luminance_sum(values[r]) / count;
        }
        return estimate_from_replicates(sums);
    }

    Receiver receiver_{{0, 0, 0}, UnitVector3::from_unit({0, 0, 1})};
    std::vector<Scene> scene_;
};

TEST_P(DirectLightPastAnEdge, IsThatOfTheVisiblePartOfThePanel) {
    const double expected = light_below(GetParam().edge);
    const Estimate e = estimate(units);
    EXPECT_LT(std::abs(e.mean - expected), 7.0 * e.standard_error)
        << e.mean << " +- " << e.standard_error << " lx, exact " << expected;
}

/// At least one look at the panel a unit: of independent looks the error would be that of a
/// coin. A scrambled net is at most sqrt(e) worse, in fact better; 16 replicates know their own
/// error to a fifth.
TEST_P(DirectLightPastAnEdge, HasAnErrorThatShrinksWithTheUnits) {
    const double whole = light_below(0.5);
    const double share = light_below(GetParam().edge) / whole;
    const double coin = whole * std::sqrt(share * (1.0 - share) / (units * replicates));
    EXPECT_LT(estimate(units).standard_error, coin);
}

INSTANTIATE_TEST_SUITE_P(Edges,
                         DirectLightPastAnEdge,
                         testing::Values(Shadow{-0.25, true},
                                         Shadow{-0.25, false},
                                         Shadow{0.25, true},
                                         Shadow{0.25, false},
                                         Shadow{0.45, true},
                                         Shadow{0.45, false}));

} // namespace
} // namespace isolux
