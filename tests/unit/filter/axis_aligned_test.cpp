#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/parallel.h"
#include "isolux/filter/axis_aligned.h"
#include "isolux/filter/filter_sites.h"
#include "isolux/filter/gaussian_filter.h"
#include "isolux/filter/recompose.h"

#include "support/filter_scene.h"
#include "support/normal_draws.h"

namespace isolux::test {
namespace {

constexpr double pi = 3.14159265358979323846;

FilterSettings fixed_width(double k_mu) {
    FilterSettings s;
    s.k_mu_shadow = k_mu;
    s.k_mu_indirect = k_mu;
    s.choose_width = false;
    return s;
}

Plane row_of(const Plane& plane, PictureSize size, std::size_t y) {
    const auto first = plane.begin() + static_cast<std::ptrdiff_t>(y * size.columns);
    return {first, first + static_cast<std::ptrdiff_t>(size.columns)};
}

/// Largest difference of the filtered penumbra of `profile` (a function of the distance from
/// the shadow's edge in m) from the penumbra itself, and from `expected`.
struct PenumbraError {
    double bias = 0.0;
    double from_expected = 0.0;
};

PenumbraError filter_penumbra(double k_mu,
                              const std::function<double(double)>& profile,
                              const std::function<double(double)>& expected) {
    constexpr double sigma = 0.2;
    constexpr double slope = 1.0;
    const double beta = sigma * slope / k_mu;
    const double step = beta / 12.0; // twelve pixels a standard deviation
    const auto columns = static_cast<std::size_t>(2.0 * 4.0 * sigma / step);
    PixelBuffers buffers = make_floor_buffers({columns, 3}, step, {make_light(sigma, 2.0)});
    LightLayer& light = buffers.lights[0];
    std::fill(light.slope_min.begin(), light.slope_min.end(), static_cast<float>(slope));
    const Plane v = over_floor(buffers, [&](double x, double) { return profile(x); });
    const FilterSites sites =
        make_shadow_sites(buffers.geometry, buffers.size, light, fixed_width(k_mu));
    const Plane filtered = row_of(filter_halves(sites, {v, v}, 50).a, buffers.size, 1);
    PenumbraError error;
    for (std::size_t i = columns / 8; i < columns - columns / 8; ++i) {
        const double x = buffers.geometry.position.x[i];
        error.bias = std::max(error.bias, std::abs(filtered[i] - profile(x)));
        error.from_expected =
            std::max(error.from_expected, std::abs(filtered[i] - expected(x)));
    }
    return error;
}

TEST(AxisAlignedFilter, LeavesAConstantPictureUnchanged) {
    NormalDraws draw(1);
    PixelBuffers buffers = make_floor_buffers({61, 47}, 0.01, {make_light(0.3, 2.0)});
    for (std::size_t i = 0; i < buffers.size.pixels(); ++i) {
        buffers.lights[0].slope_min[i] = static_cast<float>(std::exp(draw()));
        buffers.lights[0].visible_a[i] = buffers.lights[0].visible_b[i] = 0.5F;
        buffers.indirect.z_min[i] = static_cast<float>(std::exp(2.0 * draw() - 2.0));
        buffers.indirect.a.set(i, Rgb{3.0, 2.0, 1.0});
        buffers.indirect.b.set(i, Rgb{3.0, 2.0, 1.0});
        buffers.geometry.lens_shift_min[i] = static_cast<float>(10.0 * draw.uniform());
    }
    for (const bool choose : {false, true}) {
        FilterSettings settings;
        settings.choose_width = choose;
        const FilteredPicture picture = filter_picture(buffers, settings);
        for (std::size_t i = 0; i < buffers.size.pixels(); ++i) {
            ASSERT_NEAR(picture.colour.x[i], 3.5, 3.5e-6) << i;
            ASSERT_NEAR(picture.colour.y[i], 2.5, 2.5e-6) << i;
            ASSERT_NEAR(picture.colour.z[i], 1.5, 1.5e-6) << i;
            ASSERT_NEAR(picture.standard_error[i], 0.0, 1e-5) << i;
        }
    }
}

/// The penumbra of a light of Gaussian profile is a normal distribution of standard deviation
/// sigma s; filtered, one that is wider by sqrt(1 + 1/(k mu)^2).
TEST(AxisAlignedFilter, WidensAGaussianPenumbraByTheStatedShare) {
    const std::vector<std::pair<double, double>> table{
        {2.0, 0.027}, {3.0, 0.013}, {6.0, 0.0033}};
    for (const auto& [k_mu, bias] : table) {
        const double wider = 0.2 * std::sqrt(1.0 + 1.0 / (k_mu * k_mu));
        const PenumbraError e = filter_penumbra(
            k_mu,
            [](double x) { return normal_cdf(x / 0.2); },
            [wider](double x) { return normal_cdf(x / wider); });
        EXPECT_NEAR(e.bias, bias, 0.05 * bias) << "k mu = " << k_mu;
        EXPECT_LT(e.from_expected, 0.05 * bias) << "k mu = " << k_mu;
    }
}

/// The penumbra of a uniform strip is a ramp; worst at its two kinks.
TEST(AxisAlignedFilter, BlursTheRampOfAUniformStripByTheStatedShare) {
    const std::vector<std::pair<double, double>> table{
        {2.0, 0.058}, {3.0, 0.038}, {6.0, 0.019}};
    for (const auto& [k_mu, bias] : table) {
        const auto ramp = [](double x) {
            return std::clamp(0.5 + x / (0.2 * sqrt_12), 0.0, 1.0);
        };
        EXPECT_NEAR(filter_penumbra(k_mu, ramp, ramp).bias, bias, 0.05 * bias)
            << "k mu = " << k_mu;
    }
}

/// White noise of variance 1 is left with the sum of the squared weights: the energy of the
/// response to one lit pixel.
TEST(AxisAlignedFilter, ReducesWhiteNoiseByFourPiWidthsSquared) {
    for (const double b : {1.0, 2.0, 4.0}) {
        PixelBuffers buffers = make_floor_buffers({41, 41}, 0.01);
        const double z = b * 0.01 * 3.0 * 2.8; // eq. (95) with k mu = 3
        std::fill(buffers.indirect.z_min.begin(),
                  buffers.indirect.z_min.end(),
                  static_cast<float>(z));
        FilterSettings settings = fixed_width(3.0);
        settings.floor_pixels = 0.0;
        const FilterSites sites =
            make_indirect_sites(buffers.geometry, buffers.size, buffers.indirect, settings);
        Plane lit(buffers.size.pixels(), 0.0F);
        lit[20 * 41 + 20] = 1.0F;
        const Plane response = filter_halves(sites, {lit, lit}, 50).a;
        double energy = 0.0;
        for (const float r : response)
            energy += static_cast<double>(r) * r;
        EXPECT_NEAR(energy, 1.0 / (4.0 * pi * b * b), 0.03 / (4.0 * pi * b * b)) << "b = " << b;
        EXPECT_NEAR(sites.columns[0], b, 1e-4 * b);
    }
}

/// Two passes against the exact two-dimensional filter, the slope doubling over the picture.
TEST(AxisAlignedFilter, IsSeparableEnoughWhereWidthsChange) {
    constexpr double sigma = 0.15;
    PixelBuffers buffers = make_floor_buffers({96, 80}, 0.004, {make_light(sigma, 2.0)});
    LightLayer& light = buffers.lights[0];
    const auto slope = [](double x, double y) { return 1.5 + (x - y) / 0.7; };
    light.slope_min = over_floor(buffers, slope);
    const Plane v = over_floor(buffers, [&](double x, double y) {
        return normal_cdf((0.8 * x + 0.6 * y) / (sigma * slope(x, y)));
    });
    const FilterSites sites =
        make_shadow_sites(buffers.geometry, buffers.size, light, fixed_width(6.0));
    const Plane filtered = filter_halves(sites, {v, v}, 50).a;
    double worst = 0.0;
    for (std::size_t y = 30; y < 50; y += 3) {
        for (std::size_t x = 36; x < 60; x += 3) {
            const std::size_t i = y * 96 + x;
            double sum = 0.0;
            double weights = 0.0;
            const double beta = sigma / sites.narrowness[i];
            for (std::size_t j = 0; j < v.size(); ++j) {
                const double dx =
                    buffers.geometry.position.x[j] - buffers.geometry.position.x[i];
                const double dy =
                    buffers.geometry.position.y[j] - buffers.geometry.position.y[i];
                const double w = std::abs(dx) > 3.0 * beta || std::abs(dy) > 3.0 * beta
                                     ? 0.0
                                     : std::exp(-0.5 * (dx * dx + dy * dy) / (beta * beta));
                sum += w * v[j];
                weights += w;
            }
            worst = std::max(worst, std::abs(filtered[i] - sum / weights));
        }
    }
    EXPECT_LT(worst, 1e-3);
}

TEST(AxisAlignedFilter, NeverMixesSurfaces) {
    PixelBuffers buffers = make_floor_buffers({40, 30}, 0.01);
    for (std::size_t i = 0; i < buffers.size.pixels(); ++i) {
        const std::size_t part = i % 40 / 10; // another object, another normal, another height
        buffers.geometry.first.object[i] = part == 1 ? 2 : 1;
        if (part == 2)
            buffers.geometry.first.normal.set(i, Vector3{0.0, 0.6, 0.8});
        if (part == 3)
            buffers.geometry.position.z[i] = 0.1F;
        const double e = 1.0 + static_cast<double>(part);
        buffers.indirect.z_min[i] = 1.0F;
        buffers.indirect.a.set(i, Rgb::grey(e));
        buffers.indirect.b.set(i, Rgb::grey(e));
    }
    const FilteredPicture picture = filter_picture(buffers, preview_filter());
    for (std::size_t i = 0; i < buffers.size.pixels(); ++i)
        ASSERT_NEAR(picture.colour.x[i], 1.0 + static_cast<double>(i % 40 / 10), 1e-5) << i;
}

/// A shadow on a wall next to a light: along the wall d1 changes, and the parallel projection
/// of the wall on the light's plane is a line. Down there the filter must not run away.
TEST(AxisAlignedFilter, ProjectsFromTheLightsCentre) {
    PixelBuffers buffers = make_floor_buffers({1, 200}, 0.01, {make_light(0.05, 2.2)});
    for (std::size_t i = 0; i < 200; ++i) {
        buffers.geometry.position.set(i,
                                      Vector3{1.0, 0.0, 1.0 - 0.01 * static_cast<double>(i)});
        buffers.geometry.first.normal.set(i, Vector3{-1.0, 0.0, 0.0});
        buffers.geometry.column_step.set(i, Vector3{0.0, 0.01, 0.0});
        buffers.geometry.row_step.set(i, Vector3{0.0, 0.0, -0.01});
        buffers.lights[0].slope_min[i] = 1.0F;
    }
    Plane v(200);
    for (std::size_t i = 0; i < 200; ++i)
        v[i] = i < 100 ? 0.0F : 1.0F;
    const FilterSites sites =
        make_shadow_sites(buffers.geometry, buffers.size, buffers.lights[0], fixed_width(6.0));
    const Plane filtered = filter_halves(sites, {v, v}, 50).a;
    EXPECT_LT(filtered[90], 1e-3);
    EXPECT_GT(filtered[110], 1.0 - 1e-3);
}

TEST(AxisAlignedFilter, RecomposesAPixelThatShowsTwoSurfaces) {
    PixelBuffers buffers = make_floor_buffers({20, 9}, 0.01);
    PixelGeometry& g = buffers.geometry;
    for (std::size_t i = 0; i < buffers.size.pixels(); ++i) {
        const std::size_t x = i % 20;
        g.first.object[i] = x < 10 ? 1 : 2;
        const double e = x < 10 ? 100.0 : 10.0;
        buffers.indirect.a.set(i, Rgb::grey(e));
        buffers.indirect.b.set(i, Rgb::grey(e));
        buffers.indirect.z_min[i] = 1.0F;
        if (x != 9)
            continue;
        g.second.object[i] = 2;
        g.second.normal.set(i, Vector3{0.0, 0.0, 1.0});
        for (Planes3* k : {&g.first.reflected_a, &g.first.reflected_b})
            k->set(i, Rgb::grey(0.6));
        for (Planes3* k : {&g.second.reflected_a, &g.second.reflected_b})
            k->set(i, Rgb{0.2, 0.3, 0.4});
    }
    const FilteredPicture picture = filter_picture(buffers, picture_filter());
    const std::size_t edge = 4 * 20 + 9;
    EXPECT_NEAR(picture.colour.x[edge], 0.6 * 100.0 + 0.2 * 10.0, 1e-4);
    EXPECT_NEAR(picture.colour.z[edge], 0.6 * 100.0 + 0.4 * 10.0, 1e-4);
}

TEST(AxisAlignedFilter, CopiesFullyLitPixelsAndContacts) {
    PixelBuffers buffers = make_floor_buffers({30, 30}, 0.01, {make_light(0.2, 2.0)});
    NormalDraws draw(3);
    LightLayer& light = buffers.lights[0];
    for (std::size_t i = 0; i < buffers.size.pixels(); ++i) {
        light.visible_a[i] = static_cast<float>(draw.uniform());
        light.visible_b[i] = light.visible_a[i];
        light.slope_min[i] = i % 30 < 10 ? 0.0F : -1.0F; // contact, then nothing in the way
    }
    const FilterSites sites =
        make_shadow_sites(buffers.geometry, buffers.size, light, fixed_width(6.0));
    const Plane out = filter_halves(sites, {light.visible_a, light.visible_b}, 50).a;
    for (std::size_t i = 0; i < out.size(); ++i)
        ASSERT_EQ(out[i], light.visible_a[i]) << i;
    EXPECT_GT(sites.narrowness[12], 0.0F) << "five pixels beside the contact: filled in";
    EXPECT_EQ(sites.narrowness[18], 0.0F);
}

TEST(AxisAlignedFilter, KeepsTheCovarianceOfTextureAndLightWhereAsked) {
    const Plane k{0.2F, 0.8F};
    const Plane E{100.0F, 50.0F};
    const Plane covariance{3.0F, -2.0F};
    const Plane out = recompose_with_covariance(k, E, covariance);
    EXPECT_FLOAT_EQ(out[0], 23.0F);
    EXPECT_FLOAT_EQ(out[1], 38.0F);
}

/// Pixels out of focus: noise falls as the lens allows, and what the filter adds to an edge
/// that the lens has blurred already stays below the table of METHODS eq. (96).
TEST(AxisAlignedFilter, SmoothsWhatIsOutOfFocusAndKeepsWhatIsSharp) {
    NormalDraws draw(4);
    PixelBuffers buffers = make_floor_buffers({80, 60}, 0.01);
    for (std::size_t i = 0; i < buffers.size.pixels(); ++i) {
        buffers.geometry.first.object[i] = 0; // everything in the remainder
        buffers.geometry.lens_shift_min[i] = i % 80 < 40 ? 0.0F : 24.0F;
        buffers.remainder_a.set(i, Rgb::grey(1.0 + 0.5 * draw()));
        buffers.remainder_b.set(i, Rgb::grey(1.0 + 0.5 * draw()));
    }
    const FilteredPicture picture = filter_picture(buffers, picture_filter());
    double sharp = 0.0;
    double soft = 0.0;
    for (std::size_t y = 15; y < 45; ++y)
        for (std::size_t x = 0; x < 20; ++x) {
            sharp += std::pow(picture.colour.x[y * 80 + x + 10] - 1.0, 2.0) / 600.0;
            soft += std::pow(picture.colour.x[y * 80 + x + 50] - 1.0, 2.0) / 600.0;
        }
    EXPECT_NEAR(sharp, 0.125, 0.125 * 0.3);           // 600 values: 6 % a standard deviation
    EXPECT_LT(soft, 0.125 / (4.0 * pi * 16.0) * 3.0); // width 24/2/3 = 4 pixels
}

/// The same bits for 1, 2 and 7 threads.
TEST(AxisAlignedFilter, GivesTheSameBitsForAnyNumberOfThreads) {
    NormalDraws draw(5);
    PixelBuffers buffers = make_floor_buffers({70, 50}, 0.01, {make_light(0.3, 2.0)});
    for (std::size_t i = 0; i < buffers.size.pixels(); ++i) {
        LightLayer& light = buffers.lights[0];
        light.slope_min[i] = static_cast<float>(0.3 + draw.uniform());
        light.visible_a[i] = static_cast<float>(draw.uniform());
        light.visible_b[i] = static_cast<float>(draw.uniform());
        buffers.indirect.z_min[i] = static_cast<float>(0.2 + draw.uniform());
        buffers.indirect.a.set(i, Rgb{draw.uniform(), draw.uniform(), draw.uniform()});
        buffers.indirect.b.set(i, Rgb{draw.uniform(), draw.uniform(), draw.uniform()});
    }
    std::vector<Planes3> pictures;
    for (const std::size_t threads : {1U, 2U, 7U}) {
        const ThreadLimit limit(threads);
        pictures.push_back(filter_picture(buffers, picture_filter()).colour);
    }
    for (std::size_t k = 1; k < pictures.size(); ++k) {
        EXPECT_EQ(pictures[k].x, pictures[0].x);
        EXPECT_EQ(pictures[k].y, pictures[0].y);
        EXPECT_EQ(pictures[k].z, pictures[0].z);
    }
}

} // namespace
} // namespace isolux::test
