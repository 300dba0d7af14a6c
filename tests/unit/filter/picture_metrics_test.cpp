#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/filter/picture_metrics.h"

#include "support/normal_draws.h"
#include "support/statistics.h"

namespace isolux::test {
namespace {

constexpr PictureSize size{24, 18};

Plane constant(double v) { return Plane(size.pixels(), static_cast<float>(v)); }

Plane wavy() {
    Plane p(size.pixels());
    for (std::size_t i = 0; i < p.size(); ++i)
        p[i] = static_cast<float>(0.5 + 0.25 * std::sin(0.7 * static_cast<double>(i % 24))
                                  + 0.2 * std::cos(0.4 * static_cast<double>(i / 24)));
    return p;
}

TEST(Ssim, OfAPictureWithItselfIsOne) {
    for (const SsimWindow w : {SsimWindow::gaussian_11, SsimWindow::uniform_7})
        EXPECT_NEAR(*ssim(size, wavy(), wavy(), w, 1.0), 1.0, 1e-9);
}

TEST(Ssim, OfConstantPicturesIsTheLuminanceTerm) {
    for (const SsimWindow w : {SsimWindow::gaussian_11, SsimWindow::uniform_7}) {
        const double c1 = 1e-4;
        EXPECT_NEAR(*ssim(size, constant(0.25), constant(0.75), w, 1.0),
                    (2.0 * 0.25 * 0.75 + c1) / (0.25 * 0.25 + 0.75 * 0.75 + c1),
                    1e-9);
    }
}

/// A shift by 1/8 keeps (co)variances: each window has the luminance term of its own mean.
TEST(Ssim, OfAShiftedPictureIsTheMeanLuminanceTerm) {
    Plane shifted = wavy();
    Plane flat = constant(0.5);
    for (float& v : shifted)
        v += 0.125F;
    const double shift = 0.125;
    const double value = *ssim(size, flat, constant(0.5 + shift), SsimWindow::uniform_7, 1.0);
    EXPECT_NEAR(value, (2.0 * 0.5 * 0.625 + 1e-4) / (0.25 + 0.625 * 0.625 + 1e-4), 1e-9);
    EXPECT_LT(*ssim(size, wavy(), shifted, SsimWindow::uniform_7, 1.0), 1.0);
}

/// Two columns of values, a and b = 1 - a, alternate: m = 1/2 almost, covariance = -variance.
/// 7 x 7 box with sample covariance: 4 or 3 of 7 columns are high.
TEST(Ssim, OfAnInvertedPatternFollowsTheSampleCovariance) {
    Plane a(size.pixels());
    Plane b(size.pixels());
    for (std::size_t i = 0; i < a.size(); ++i) {
        a[i] = i % 2 == 0 ? 0.75F : 0.25F;
        b[i] = 1.0F - a[i];
    }
    const double c1 = 1e-4;
    const double c2 = 9e-4;
    const double ma = (4.0 * 0.75 + 3.0 * 0.25) / 7.0;
    const double mb = 1.0 - ma;
    const double variance = 49.0 / 48.0 * 0.25 * (4.0 / 7.0) * (3.0 / 7.0);
    const double expected = (2.0 * ma * mb + c1) * (-2.0 * variance + c2)
                            / ((ma * ma + mb * mb + c1) * (2.0 * variance + c2));
    EXPECT_NEAR(*ssim(size, a, b, SsimWindow::uniform_7, 1.0), expected, 1e-9);
}

TEST(Ssim, NeedsAWindow) {
    const PictureSize small{10, 30};
    const Plane p(small.pixels(), 0.5F);
    EXPECT_FALSE(ssim(small, p, p, SsimWindow::gaussian_11, 1.0));
    EXPECT_TRUE(ssim(small, p, p, SsimWindow::uniform_7, 1.0));
}

TEST(LogLuminanceSsim, DoesNotDependOnTheUnit) {
    Plane a = wavy();
    Plane b = wavy();
    NormalDraws draw(1);
    for (float& v : a)
        v *= static_cast<float>(std::exp(0.1 * draw()));
    const double value = *log_luminance_ssim(size, a, b);
    for (Plane* p : {&a, &b})
        for (float& v : *p)
            v *= 1024.0F;
    // logarithms shift: only the luminance term could notice, by its constant
    EXPECT_GT(value, 0.1);
    EXPECT_LT(value, 1.0);
    EXPECT_NEAR(*log_luminance_ssim(size, b, b), 1.0, 1e-9);
    EXPECT_FALSE(log_luminance_ssim(size, b, constant(3.0)));
    EXPECT_FALSE(log_luminance_ssim(size, b, constant(0.0)));
}

TEST(PictureErrors, OfConstantPicturesHaveClosedForms) {
    const Reference reference{constant(2.0), std::nullopt, std::nullopt};
    EXPECT_NEAR(mean_squared_error(constant(3.0), reference).value, 1.0, 1e-12);
    EXPECT_NEAR(relative_squared_error(constant(3.0), reference).value, 1.0 / 4.04, 1e-12);
    EXPECT_NEAR(
        peak_signal_to_noise(constant(0.5), constant(0.75)), 20.0 * std::log10(4.0), 1e-9);
    EXPECT_TRUE(std::isinf(peak_signal_to_noise(wavy(), wavy())));
    const Plane encoded = display_encoded(constant(2.0), 2.0);
    EXPECT_NEAR(encoded[0], std::pow(0.25, 1.0 / 2.2), 1e-7);
    EXPECT_EQ(display_encoded(constant(9.0), 2.0)[0], 1.0F);
    EXPECT_EQ(median_of({4.0F, 1.0F, 3.0F, 2.0F}), 2.5);
    EXPECT_EQ(median_of({4.0F, 1.0F, 3.0F}), 3.0);
}

/// With the reference's halves its own noise drops out; without, it is added.
TEST(PictureErrors, DoNotContainTheNoiseOfAReferenceInHalves) {
    constexpr double noise = 0.2;
    constexpr double error = 0.1;
    const auto run = [&](std::size_t seed, bool halves) {
        NormalDraws draw(seed);
        Plane a = wavy();
        Reference b{wavy(), wavy(), wavy()};
        for (std::size_t i = 0; i < a.size(); ++i) {
            a[i] += static_cast<float>(error * draw());
            (*b.half_1)[i] += static_cast<float>(noise * draw());
            (*b.half_2)[i] += static_cast<float>(noise * draw());
            b.mean[i] = 0.5F * ((*b.half_1)[i] + (*b.half_2)[i]);
        }
        if (!halves)
            b.half_1.reset();
        return mean_squared_error(a, b).value;
    };
    const Estimate with = over_seeds([&](std::size_t s) { return run(s, true); });
    const Estimate without = over_seeds([&](std::size_t s) { return run(s, false); });
    EXPECT_LT(std::abs(z_score(with, error * error)), z_limit);
    EXPECT_LT(std::abs(z_score(without, error * error + 0.5 * noise * noise)), z_limit);
    EXPECT_GT(std::abs(z_score(without, error * error)), z_limit);
}

TEST(PictureErrors, AreNotTrustedNextToANoisyReference) {
    SquaredError e{1.0, 0.2};
    EXPECT_FALSE(e.is_trustworthy());
    e.reference_noise = 0.05;
    EXPECT_TRUE(e.is_trustworthy());
}

TEST(PictureErrors, MeasureTheBiasOfAFilterFromHalvesAlone) {
    const Estimate bias = over_seeds([&](std::size_t s) {
        NormalDraws draw(s);
        Plane b1 = constant(1.0);
        Plane b2 = constant(1.0);
        Plane f1(b1.size());
        Plane f2(b1.size());
        for (std::size_t i = 0; i < b1.size(); ++i) {
            b1[i] += static_cast<float>(0.3 * draw());
            b2[i] += static_cast<float>(0.3 * draw());
            f1[i] = b1[i] + 0.25F;
            f2[i] = b2[i] + 0.25F;
        }
        return squared_bias(f1, b1, f2, b2);
    });
    EXPECT_NEAR(bias.mean, 0.0625, 1e-6);
}

/// The table of the second source in METHODS "Similarity in percent": printed percentages and
/// the SSIM they stand for.
TEST(SimilarityPercent, ConvertsThePrintedTable) {
    const std::vector<std::pair<double, double>> table{{74.04, 0.481},
                                                       {81.48, 0.630},
                                                       {88.01, 0.760},
                                                       {92.85, 0.857},
                                                       {95.51, 0.910},
                                                       {100.00, 1.000},
                                                       {99.80, 0.996},
                                                       {99.76, 0.995},
                                                       {99.73, 0.995},
                                                       {99.71, 0.994}};
    for (const auto& [percent, value] : table) {
        EXPECT_NEAR(ssim_of_similarity(percent), value, 1e-3);
        EXPECT_NEAR(similarity_percent(ssim_of_similarity(percent)), percent, 1e-9);
    }
}

/// 1/SSIM - 1 of that table falls as iterations^-0.91, to 2 % over the whole table.
TEST(SimilarityPercent, OfThePrintedTableFallsAsAPowerOfTheIterations) {
    const std::array<double, 5> iterations{1000, 2000, 4000, 8000, 14000};
    const std::array<double, 5> percent{74.04, 81.48, 88.01, 92.85, 95.51};
    double x = 0.0;
    double y = 0.0;
    double xx = 0.0;
    double xy = 0.0;
    const auto log_noise = [&](std::size_t i) {
        return std::log(1.0 / ssim_of_similarity(percent[i]) - 1.0);
    };
    for (std::size_t k = 0; k < 5; ++k) {
        x += std::log(iterations[k]) / 5.0;
        y += log_noise(k) / 5.0;
        xx += std::pow(std::log(iterations[k]), 2.0) / 5.0;
        xy += std::log(iterations[k]) * log_noise(k) / 5.0;
    }
    const double slope = (xy - x * y) / (xx - x * x);
    EXPECT_NEAR(slope, -0.91, 0.005); // to the digits stated
    for (std::size_t k = 0; k < 5; ++k)
        EXPECT_NEAR(log_noise(k), y + slope * (std::log(iterations[k]) - x), 0.02);
}

} // namespace
} // namespace isolux::test
