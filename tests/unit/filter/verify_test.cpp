#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/filter/layer_filter.h"
#include "isolux/filter/verify.h"

#include "support/filter_scene.h"
#include "support/normal_draws.h"
#include "support/statistics.h"

namespace isolux::test {
namespace {

constexpr PictureSize size{48, 40};
constexpr double noise = 0.4;

double truth(double x, double y) {
    return 2.0 + std::sin(9.0 * x) + std::cos(7.0 * y) + (x > 0.03 ? 1.0 : 0.0);
}

struct Trial {
    Plane truth;
    Halves raw;
    Halves filtered;
};

double mean(const Plane& values) {
    double sum = 0.0;
    for (const float v : values)
        sum += v;
    return sum / static_cast<double>(values.size());
}

FilterSites sites_of(const PixelBuffers& buffers, double k_mu) {
    FilterSettings settings;
    settings.k_mu_indirect = k_mu;
    return make_indirect_sites(buffers.geometry, size, buffers.indirect, settings);
}

/// @param common  noise that both halves share; there should be none
Trial run(std::size_t seed, double k_mu, double common = 0.0) {
    PixelBuffers buffers = make_floor_buffers(size, 0.01);
    std::fill(buffers.indirect.z_min.begin(), buffers.indirect.z_min.end(), 0.3F);
    Trial r;
    r.truth = over_floor(buffers, truth);
    r.raw = {r.truth, r.truth};
    NormalDraws draw(seed);
    for (std::size_t i = 0; i < size.pixels(); ++i) {
        const double shared = common * draw();
        r.raw.a[i] += static_cast<float>(noise * draw() + shared);
        r.raw.b[i] += static_cast<float>(noise * draw() + shared);
    }
    r.filtered = filter_halves(sites_of(buffers, k_mu), r.raw, 50);
    return r;
}

double squared_error(const Plane& a, const Plane& b, const Plane& truth_) {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth_.size(); ++i)
        sum += std::pow(0.5 * (static_cast<double>(a[i]) + b[i]) - truth_[i], 2.0);
    return sum / static_cast<double>(truth_.size());
}

TEST(FilterThenVerify, MeasuresTheErrorWithoutKnowingTheTruth) {
    for (const double k_mu : {3.0, 6.0}) {
        const Estimate difference = over_seeds([&](std::size_t s) {
            const Trial r = run(s, k_mu);
            return mean(squared_errors(r.raw, r.filtered).filtered)
                   - squared_error(r.filtered.a, r.filtered.b, r.truth);
        });
        EXPECT_LT(std::abs(z_score(difference, 0.0)), z_limit) << "k mu = " << k_mu;
    }
}

TEST(FilterThenVerify, MeasuresTheErrorOfOneHalfAgainstTheOther) {
    const Estimate difference = over_seeds([&](std::size_t s) {
        const Trial r = run(s, 3.0);
        const Plane variance(size.pixels(), static_cast<float>(noise * noise));
        const double measured =
            mean(squared_error_of_half(r.raw, r.filtered, {variance, variance}));
        return measured
               - 0.5
                     * (squared_error(r.filtered.a, r.filtered.a, r.truth)
                        + squared_error(r.filtered.b, r.filtered.b, r.truth));
    });
    EXPECT_LT(std::abs(z_score(difference, 0.0)), z_limit);
}

TEST(FilterThenVerify, MeasuresTheErrorOfTheUnfilteredPicture) {
    const Estimate difference = over_seeds([&](std::size_t s) {
        const Trial r = run(s, 3.0);
        return mean(squared_errors(r.raw, r.filtered).raw)
               - squared_error(r.raw.a, r.raw.b, r.truth);
    });
    EXPECT_LT(std::abs(z_score(difference, 0.0)), z_limit);
}

/// Planted: halves that share a third of their noise must be caught by the test above.
TEST(FilterThenVerify, IsFooledByHalvesThatShareNoise) {
    const Estimate difference = over_seeds([&](std::size_t s) {
        const Trial r = run(s, 3.0, 0.15);
        return mean(squared_errors(r.raw, r.filtered).raw)
               - squared_error(r.raw.a, r.raw.b, r.truth);
    });
    EXPECT_GT(std::abs(z_score(difference, 0.0)), z_limit);
}

TEST(FilterThenVerify, WindowMeanIsTheMeanOfSitesInTheWindow) {
    FilterSites sites;
    sites.size = {5, 4};
    sites.object.assign(20, 1);
    sites.object[6] = 0;
    Plane values(20);
    for (std::size_t i = 0; i < 20; ++i)
        values[i] = static_cast<float>(i);
    const Plane mean_of_three = window_mean(sites, values, 3);
    EXPECT_FLOAT_EQ(mean_of_three[0], (0 + 1 + 5) / 3.0F);
    EXPECT_FLOAT_EQ(mean_of_three[7], (1 + 2 + 3 + 7 + 8 + 11 + 12 + 13) / 8.0F);
    EXPECT_FLOAT_EQ(mean_of_three[19], (13 + 14 + 18 + 19) / 4.0F);
}

struct ErrorOfCount {
    double fixed = 0.0;
    double chosen = 0.0;
    double raw = 0.0;
};

/// Mean square error over the middle of a square picture: at its rim the filter sees one side.
double middle_error(const Plane& a, const Plane& b, const Plane& truth_, std::size_t side) {
    const std::size_t margin = side / 4;
    double sum = 0.0;
    for (std::size_t y = margin; y < side - margin; ++y)
        for (std::size_t x = margin; x < side - margin; ++x) {
            const std::size_t i = y * side + x;
            sum += std::pow(0.5 * (static_cast<double>(a[i]) + b[i]) - truth_[i], 2.0);
        }
    return sum / std::pow(static_cast<double>(side - 2 * margin), 2.0);
}

/// Root mean square errors of a smooth irradiance at n samples a pixel. The rule's width at 16
/// samples is 7.7 pixels, its bias a tenth of the wave's height.
ErrorOfCount errors_at(double n) {
    constexpr std::size_t runs = 4;
    constexpr std::size_t side = 96;
    ErrorOfCount sum;
    for (std::size_t s = 0; s < runs; ++s) {
        PixelBuffers buffers = make_floor_buffers({side, side}, 0.01);
        std::fill(buffers.indirect.z_min.begin(), buffers.indirect.z_min.end(), 0.3F);
        const Plane exact = over_floor(
            buffers, [](double x, double y) { return 2.0 + std::sin(5.0 * x + 3.0 * y); });
        Halves raw{exact, exact};
        NormalDraws draw(100 * s + static_cast<std::size_t>(n));
        const double sigma = 6.0 / std::sqrt(0.5 * n);
        for (std::size_t i = 0; i < exact.size(); ++i) {
            raw.a[i] += static_cast<float>(sigma * draw());
            raw.b[i] += static_cast<float>(sigma * draw());
        }
        FilterSettings settings;
        settings.k_mu_indirect = 1.4;
        settings.samples = n;
        const FilterSites sites =
            make_indirect_sites(buffers.geometry, buffers.size, buffers.indirect, settings);
        const FilteredLayer layer = filter_layer(sites, raw, settings, true);
        sum.fixed += middle_error(layer.fixed.a, layer.fixed.b, exact, side) / runs;
        sum.chosen += middle_error(layer.mean, layer.mean, exact, side) / runs;
        sum.raw += middle_error(raw.a, raw.b, exact, side) / runs;
    }
    return {std::sqrt(sum.fixed), std::sqrt(sum.chosen), std::sqrt(sum.raw)};
}

/// METHODS eq. (101): bias and noise vanish together.
TEST(FilterThenVerify, ConvergesAsSamplesGrowAndIsNeverWorseThanUnfiltered) {
    double sum_x = 0.0;
    double sum_y = 0.0;
    double sum_xx = 0.0;
    double sum_xy = 0.0;
    double counts = 0.0;
    for (double n = 16.0; n <= 4096.0; n *= 4.0, counts += 1.0) {
        const ErrorOfCount e = errors_at(n);
        EXPECT_LE(e.chosen, 1.05 * e.raw) << n;
        const double x = std::log(n);
        const double y = std::log(e.fixed);
        sum_x += x;
        sum_y += y;
        sum_xx += x * x;
        sum_xy += x * y;
    }
    const double slope = (counts * sum_xy - sum_x * sum_y) / (counts * sum_xx - sum_x * sum_x);
    EXPECT_LE(slope, -0.3);
}

} // namespace
} // namespace isolux::test
