#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/sampling/random_stream.h"
#include "isolux/transport/luminaire_pick.h"

namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;

struct Light {
    LightBounds bounds;
    Point3 centre;
    double size = 0.0;
};

/// Anywhere in 20 m, of any strength; every fifth is off.
std::vector<Light> random_lights(std::size_t count) {
    const RandomStream stream(8, StreamPurpose::test, static_cast<std::uint32_t>(count));
    std::vector<Light> lights(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = stream.uniform4(i, 0);
        const auto y = stream.uniform4(i, 1);
        Light& l = lights[i];
        l.centre = {500.0 + 20.0 * x[0], 20.0 * x[1], 3.0 + x[2]};
        l.size = 2.0 * x[3];
        l.bounds.axis = UnitVector3(Vector3{y[0] - 0.5, y[1] - 0.5, y[2] - 1.0});
        l.bounds.flux = i % 5 == 3 ? 0.0 : 100.0 + 5000.0 * y[3];
        for (std::size_t k = 0; k < LightBounds::bands / 2; ++k)
            l.bounds.largest[k] =
                l.bounds.flux * stream.uniform(i, 8 + static_cast<std::uint32_t>(k));
    }
    return lights;
}

LuminairePick pick_of(const std::vector<Light>& lights) {
    const auto tables = std::make_shared<GlowTables>();
    LuminairePick pick(tables);
    for (const Light& l : lights)
        pick.add(tables->add(l.bounds), l.bounds.axis, l.centre, l.size);
    return pick;
}

/// METHODS 3.4 in double precision. Below 0 where a rounded cosine might say something else.
double weight(const Light& l, const Point3& place) {
    const Vector3 d = place - l.centre;
    const double cells = 16.0 * (1.0 + dot(l.bounds.axis, d) / length(d));
    if (std::abs(cells - std::round(cells)) < 1e-4)
        return -1.0;
    double largest = 0.0;
    for (double c = std::floor(cells); c <= std::floor(cells) + 1.0; c += 1e-3) {
        const double angle = std::acos(std::clamp(c / 16.0 - 1.0, -1.0, 1.0));
        const auto band = static_cast<std::size_t>(angle / pi * LightBounds::bands);
        largest = std::max(largest, l.bounds.largest[std::min(band, LightBounds::bands - 1)]);
    }
    return (largest + 0.1 * l.bounds.flux / (4.0 * pi))
           / (length_squared(d) + 0.25 * l.size * l.size + 1e-4);
}

Point3 random_place(std::uint64_t i) {
    const auto x = RandomStream(9, StreamPurpose::test, 1).uniform4(i, 0);
    return {495.0 + 30.0 * x[0], -5.0 + 30.0 * x[1], 5.0 * x[2]};
}

TEST(LuminairePick, WeighsByIntensityOverSquaredDistance) {
    const std::vector<Light> lights = random_lights(29);
    const LuminairePick pick = pick_of(lights);
    int compared = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const Point3 place = random_place(i);
        double sum = 0.0;
        double least = 0.0;
        for (const Light& l : lights) {
            const double w = weight(l, place);
            sum += w;
            least = std::min(least, w);
        }
        if (least < 0.0)
            continue;
        ++compared;
        for (std::size_t l = 0; l < lights.size(); ++l) {
            const double p = weight(lights[l], place) / sum;
            ASSERT_NEAR(pick.probability(place, l), p, 2e-5 * p) << i << " " << l;
        }
    }
    EXPECT_GT(compared, 200);
}

TEST(LuminairePick, DrawsAsOftenAsItSays) {
    constexpr int draws = 20000;
    for (const std::size_t count : {1U, 2U, 8U, 9U, 29U, 64U}) {
        const LuminairePick pick = pick_of(random_lights(count));
        for (std::uint64_t i = 0; i < 10; ++i) {
            const Point3 place = random_place(i);
            std::vector<int> drawn(count, 0);
            for (int k = 0; k < draws; ++k) {
                const LuminairePick::Pick p = pick.pick(place, (k + 0.5) / draws);
                ASSERT_EQ(p.probability, pick.probability(place, p.entry));
                ++drawn[p.entry];
            }
            for (std::size_t l = 0; l < count; ++l)
                ASSERT_NEAR(drawn[l], draws * pick.probability(place, l), 1.0 + 1e-6) << l;
        }
    }
}

/// What is left of a number after a draw is spread evenly over [0, 1) for every entry: moments
/// of a grid of numbers, to their rounding.
TEST(LuminairePick, LeavesANumberToGoOnWith) {
    constexpr int draws = 200000;
    const LuminairePick pick = pick_of(random_lights(9));
    const Point3 place = random_place(1);
    std::vector<std::vector<double>> rests(9);
    for (int k = 0; k < draws; ++k) {
        const LuminairePick::Pick p = pick.pick(place, (k + 0.5) / draws);
        ASSERT_GE(p.rest, 0.0);
        ASSERT_LT(p.rest, 1.0);
        rests[p.entry].push_back(p.rest);
    }
    int compared = 0;
    for (const std::vector<double>& rest : rests) {
        if (rest.size() < 300)
            continue;
        ++compared;
        double mean = 0.0;
        double square = 0.0;
        for (const double r : rest) {
            mean += r / static_cast<double>(rest.size());
            square += r * r / static_cast<double>(rest.size());
        }
        EXPECT_NEAR(mean, 0.5, 2e-3);
        EXPECT_NEAR(square, 1.0 / 3.0, 2e-3);
    }
    EXPECT_GE(compared, 4);
}

TEST(LuminairePick, NeverDrawsWhatIsOff) {
    const LuminairePick pick = pick_of(random_lights(64));
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const double u = RandomStream(9, StreamPurpose::test, 2).uniform(i, 0);
        const Point3 place = random_place(i);
        for (const double v : {u, std::nextafter(1.0, 0.0)})
            ASSERT_NE(pick.pick(place, v).entry % 5, 3U);
        ASSERT_EQ(pick.probability(place, 3), 0.0);
    }
}

} // namespace
} // namespace isolux
