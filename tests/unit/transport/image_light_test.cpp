#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/image_light.h"

#include "support/replicates.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

/// A mirror wall, a smaller mirror across, a pane, a box that shades some images; a panel, a
/// point source, and a panel that looks away.
Scene mirrors() {
    test::Builder b;
    const MaterialId grey = b.add_diffuse(0.5);
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.1), 0.8}, Sides::both});
    const MaterialId dim = b.add_material({"dim", Opaque{Rgb::grey(0.1), 0.3}, Sides::both});
    const MaterialId glass = b.add_material({"glass", ClearPane{}, Sides::both});
    b.add_room({0, 0, 0}, {4, 3, 2.5}, grey, grey, grey);
    b.add_quad({0.05, 0, 0}, {0, 3, 0}, {0, 0, 2.5}, mirror);
    b.add_quad({3.9, 0.5, 0.2}, {0, 0, 1.8}, {0, 1.5, 0}, dim);
    b.add_quad({1, 2.5, 0}, {2, 0, 0}, {0, 0, 2}, glass);
    b.add_quad({0.9, 1.0, 0.6}, {0, 0.5, 0}, {0, 0, 1}, grey);
    b.add_panel({2.4, 1.0, 2.4}, {0, 0.5, 0}, {0.5, 0, 0}, 3000.0);
    b.add_panel({0.6, 0.2, 0.5}, {0.3, 0, 0}, {0, 0, 0.3}, 900.0);
    b.add_point({1.5, 2.0, 2.2}, b.add_isotropic_type(1500.0));
    return b.build();
}

/// A surface as it is met.
struct Place {
    Point3 at;
    UnitVector3 normal;
};

std::vector<Place> places() {
    return {{{2.0, 1.2, 0.001}, UnitVector3({0, 0, 1})},
            {{1.2, 0.7, 1.3}, UnitVector3({-1, 0, 0})},
            {{3.0, 2.999, 1.0}, UnitVector3({0, -1, 0})},
            {{0.3, 1.5, 2.499}, UnitVector3({0, 0, -1})}};
}

constexpr int batches = 64;
constexpr int in_a_batch = 1000;

/// One estimate a batch, of 1000 values each.
template <class Value> Estimate mean_of(std::uint64_t seed, Value&& value) {
    std::vector<double> means;
    for (int b = 0; b < batches; ++b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < in_a_batch; ++i) {
            // Samples of one point would be spread evenly; these are independent.
            const PointRandomness random{
                seed, StreamPurpose::gather, static_cast<std::uint32_t>(b), i};
            NumberSequence numbers(random, 0);
            sum += value(numbers);
        }
        means.push_back(sum / in_a_batch);
    }
    return estimate_from_replicates(means);
}

class ImageEvent : public testing::Test {
protected:
    /// METHODS eq. (146)
    [[nodiscard]] double chosen(const Place& p, NumberSequence& numbers) {
        return luminance_sum(
            sample_image_event(scene, emission, images, p.at, p.normal, numbers, rays)
                .illuminance);
    }

    /// METHODS eq. (34), chain by chain, one place on a luminaire each.
    [[nodiscard]] double all_chains(const Place& p, NumberSequence& numbers) {
        double sum = 0.0;
        for (const std::vector<std::uint32_t>& chain : images.chains()) {
            const double u_luminaire = numbers.next();
            const double u = numbers.next();
            const TowardsSample sample = emission.sample_towards(
                image_of(images, chain, p.at), u_luminaire, u, numbers.next());
            if (!(sample.density > 0.0))
                continue;
            const ImageLight light =
                trace_image(scene, emission, images, chain, p.at, sample, rays);
            if (light.strength > 0.0)
                sum += light.strength * std::max(0.0, dot(p.normal, light.arrival))
                       / sample.density * luminance_sum(emission.colour(sample.from.luminaire));
        }
        return sum;
    }

    Scene scene = mirrors();
    Emission emission{scene};
    MirrorImages images{scene};
    std::uint64_t rays = 0;
};

TEST_F(ImageEvent, HasTheMeanOfAllChains) {
    ASSERT_GT(images.chains().size(), 8U); // more than there are candidates
    for (const Place& p : places()) {
        const Estimate a = mean_of(1, [&](NumberSequence& n) { return chosen(p, n); });
        const Estimate b = mean_of(2, [&](NumberSequence& n) { return all_chains(p, n); });
        EXPECT_LT(std::abs(test::z_score(a, b)), test::z_limit)
            << a.mean << " +- " << a.standard_error << ", " << b.mean << " +- "
            << b.standard_error;
        // Power: 4 % would be seen.
        EXPECT_LT(std::hypot(a.standard_error, b.standard_error), 0.006 * b.mean);
    }
}

/// What the choice is for: the first chain and luminaire that come are mostly not those that
/// matter.
TEST_F(ImageEvent, VariesLessThanTheFirstThatComes) {
    const auto first = [&](const Place& p, NumberSequence& numbers) {
        const auto [chain, probability] = images.draw_chain(numbers.next());
        if (chain == nullptr)
            return 0.0;
        const double u_luminaire = numbers.next();
        const double u = numbers.next();
        const TowardsSample sample = emission.sample_towards(
            image_of(images, *chain, p.at), u_luminaire, u, numbers.next());
        if (!(sample.density > 0.0))
            return 0.0;
        const ImageLight light =
            trace_image(scene, emission, images, *chain, p.at, sample, rays);
        return light.strength * std::max(0.0, dot(p.normal, light.arrival))
               / (probability * sample.density)
               * luminance_sum(emission.colour(sample.from.luminaire));
    };
    for (const Place& p : places()) {
        const Estimate a = mean_of(3, [&](NumberSequence& n) { return chosen(p, n); });
        const Estimate b = mean_of(4, [&](NumberSequence& n) { return first(p, n); });
        EXPECT_LT(2.0 * a.standard_error, b.standard_error) << a.mean << ' ' << b.mean;
    }
}

TEST_F(ImageEvent, FromBehindIsNotEvenTraced) {
    const Place faces_out{{2.0, 1.2, 2.499}, UnitVector3({0, 0, 1})};
    const Estimate a = mean_of(5, [&](NumberSequence& n) { return chosen(faces_out, n); });
    EXPECT_EQ(a.mean, 0.0);
    EXPECT_EQ(rays, 0U);
}

} // namespace
} // namespace isolux
