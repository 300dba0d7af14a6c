#include <cmath>
#include <numbers>
#include <optional>

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include "isolux/validate/inverse_square.h"

#include "support/printed.h"

namespace isolux {
namespace {

using std::numbers::pi;

const Point3 above{0, 0, 2};

IdealPointSource downwards(std::optional<double> exponent) {
    return {above, Lumen(1000.0), UnitVector3::from_unit({0, 0, -1}), exponent};
}

TEST(InverseSquare, GivesTheReferenceValuesOnPlanes) {
    const struct {
        Point3 point;
        Vector3 normal;
        double e[5]; // isotropic, then n = 1, 2, 4, 12
    } rows[] = {
        {{0, 0, 0}, {0, 0, 1}, {19.894368, 79.577472, 119.36621, 198.94368, 517.25356}},
        {{1, 0, 0}, {0, 0, 1}, {14.235251, 50.929582, 68.329204, 91.105606, 97.023826}},
        {{2, 1.5, 0.8}, {0, 0, 1}, {4.4779771, 7.7510393, 5.0311733, 1.5701971, 0.0050196349}},
        {{2, 0, 1}, {-1, 0, 0}, {14.235251, 25.464791, 17.082301, 5.6941004, 0.023687457}},
        {{0.5, 3, 0.5}, {0, -1, 0}, {6.1215955, 10.83096, 7.1862208, 2.3433329, 0.0089278327}},
        // printed as (-0.5185, 0.2074, 0.8296): (-2.5, 1, 4) normalised
        {{1.5, -1, 0.2}, {-2.5, 1, 4}, {11.928327, 33.7124, 35.729841, 29.728989, 4.8012547}},
        {{4, 0, 0}, {5, 0, 1}, {0, 0, 0, 0, 0}},
        {{6, 2, 0}, {0, 0, 1}, {0.54530706, 0.65766505, 0.29744021, 0.045066699, 8.003102e-06}},
        {{2, 0, 4}, {-1, 0, 0}, {7.0337212, 0, 0, 0, 0}},
    };

    const std::optional<double> exponents[] = {std::nullopt, 1.0, 2.0, 4.0, 12.0};
    for (const auto& row : rows)
        for (std::size_t k = 0; k < 5; ++k) {
            const double e = in_lux(point_source_illuminance(
                downwards(exponents[k]), {row.point, UnitVector3(row.normal)}));
            if (row.e[k] == 0.0)
                EXPECT_EQ(e, 0.0);
            else
                EXPECT_TRUE(test::agrees(e, row.e[k], 8))
                    << row.point.x << " " << row.point.y << " column " << k << ": " << e;
        }
}

TEST(InverseSquare, GivesTheReferenceValuesOfEveryKind) {
    const IdealPointSource source = downwards(1.0);
    const auto e = [&](IlluminanceKind kind) {
        return in_lux(point_source_illuminance(
            source, {{1.5, 0.5, 1.2}, UnitVector3::from_unit({0, 0, 1}), kind}));
    };
    EXPECT_TRUE(test::agrees(e(IlluminanceKind::cylindrical), 12.998731, 8));
    EXPECT_TRUE(test::agrees(e(IlluminanceKind::semi_cylindrical), 0.66705199, 8));
    EXPECT_TRUE(test::agrees(e(IlluminanceKind::planar), 20.661926, 8));
    EXPECT_TRUE(test::agrees(e(IlluminanceKind::mean_spherical), 11.441571, 8));
    EXPECT_TRUE(test::agrees(e(IlluminanceKind::hemispherical), 16.607052, 8));
    EXPECT_TRUE(test::agrees(
        e(IlluminanceKind::cylindrical) / e(IlluminanceKind::planar), 0.62911515, 8));
}

TEST(InverseSquare, EveryKindIsPiUnderUniformLuminance) {
    // Point sources spread over a far sphere, by a product rule that is exact for the
    // polynomials in cos and sin that occur, save |sin g|: 60 nodes leave 1e-4 of it there.
    using Rule = boost::math::quadrature::gauss<double, 60>;
    const UnitVector3 axis(Vector3{0.3, -0.2, 0.9});
    const Basis basis = make_basis(axis);
    for (const IlluminanceKind kind : {IlluminanceKind::planar,
                                       IlluminanceKind::cylindrical,
                                       IlluminanceKind::semi_cylindrical,
                                       IlluminanceKind::hemispherical,
                                       IlluminanceKind::mean_spherical}) {
        const Receiver receiver{{}, axis, kind, UnitVector3(Vector3{1, 2, -0.5})};
        const auto at_cosine = [&](double c) {
            double sum = 0.0;
            constexpr int azimuths = 16;
            for (int k = 0; k < azimuths; ++k) {
                const double phi = 2.0 * pi * k / azimuths;
                const double s = std::sqrt(1.0 - c * c);
                const Vector3 w = basis.to_world({s * std::cos(phi), s * std::sin(phi), c});
                sum += in_lux(point_source_illuminance({Point3{} + w, Lumen(4.0 * pi), {}, {}},
                                                       receiver))
                       * 2.0 * pi / azimuths;
            }
            return sum;
        };
        EXPECT_NEAR(Rule::integrate(at_cosine, -1.0, 0.0)
                        + Rule::integrate(at_cosine, 0.0, 1.0),
                    pi,
                    1e-4 * pi);
    }
}

TEST(InverseSquare, FluxOfACosinePowerIsTheGivenFlux) {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    for (const double n : {0.0, 1.0, 2.0, 7.0}) {
        const IdealPointSource s{{}, Lumen(500.0), UnitVector3::from_unit({0, 0, 1}), n};
        const double flux = Rule::integrate(
            [&](double c) {
                return 2.0 * pi
                       * in_candela(point_source_intensity(
                           s, UnitVector3(Vector3{std::sqrt(1 - c * c), 0, c})));
            },
            0.0,
            1.0);
        EXPECT_NEAR(flux, 500.0, 1e-9);
    }
}

} // namespace
} // namespace isolux
