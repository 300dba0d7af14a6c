#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/mirror_images.h"

#include "support/test_scene.h"

namespace isolux {
namespace {

/// A strong mirror and two panes, all in planes of their own.
Scene three_mirrors() {
    test::Builder b;
    const MaterialId glass = b.add_material({"glass", ClearPane{}, Sides::both});
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.0), 0.8}, Sides::both});
    const MaterialId grey = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {3, 3, 3}, grey, grey, grey);
    b.add_quad({0.1, 1, 1}, {0, 1, 0}, {0, 0, 1}, mirror);
    b.add_quad({1, 0.1, 1}, {1, 0, 0}, {0, 0, 1}, glass);
    b.add_quad({1, 2.9, 1}, {1, 0, 0}, {0, 0, 1}, glass);
    b.add_panel({1.2, 1.0, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 3000.0);
    return b.build();
}

TEST(MirrorImages, DrawStrongChainsMoreOften) {
    const Scene scene = three_mirrors();
    const MirrorImages images(scene);
    ASSERT_EQ(images.mirrors().size(), 3U);
    constexpr int draws = 100000;
    std::map<std::vector<std::uint32_t>, int> drawn;
    std::map<std::vector<std::uint32_t>, double> probability;
    int none = 0;
    for (int i = 0; i < draws; ++i) {
        const auto [chain, p] = images.draw_chain((i + 0.5) / draws);
        if (chain == nullptr) {
            ++none;
            continue;
        }
        ++drawn[*chain];
        probability[*chain] = p;
    }
    EXPECT_EQ(drawn.size(), images.chains().size()); // none is forgotten
    for (const auto& [chain, count] : drawn)
        EXPECT_NEAR(count, draws * probability[chain], 1.01);
    EXPECT_NEAR(none, draws * (1.0 - images.draws()), 1.01);
    EXPECT_NEAR(drawn[{0}], 8 * drawn[{1}], 10); // 0.8 and 0.1
}

TEST(MirrorImages, CoverWhatLightPathsMetTheOtherWayRound) {
    const Scene scene = three_mirrors();
    const MirrorImages images(scene);
    const auto met = [](std::vector<std::uint32_t> mirrors) {
        MirrorsMet m;
        for (const std::uint32_t k : mirrors)
            m.add(k);
        return m;
    };
    for (const std::vector<std::uint32_t>& chain : images.chains())
        EXPECT_TRUE(images.covers(met({chain.rbegin(), chain.rend()})));
    const std::set<std::vector<std::uint32_t>> all(images.chains().begin(),
                                                   images.chains().end());
    int without = 0;
    for (std::uint32_t a = 0; a < 3; ++a)
        for (std::uint32_t b = 0; b < 3; ++b)
            for (std::uint32_t c = 0; c < 3; ++c) {
                const bool is_covered = images.covers(met({c, b, a}));
                EXPECT_EQ(is_covered, all.count({a, b, c}) == 1) << a << b << c;
                without += is_covered ? 0 : 1;
            }
    EXPECT_GT(without, 0);
    EXPECT_FALSE(images.covers(MirrorsMet{}));
    EXPECT_FALSE(images.covers(met({3})));             // a mirror of no plane
    EXPECT_FALSE(images.covers(met({0, 1, 0, 1, 0}))); // more than any chain has
}

TEST(MirrorImages, OfPanesAloneAreSeldomLookedFor) {
    test::Builder b;
    const MaterialId glass = b.add_material({"glass", ClearPane{}, Sides::both});
    const MaterialId grey = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {3, 3, 3}, grey, grey, grey);
    b.add_quad({1, 0.1, 1}, {1, 0, 0}, {0, 0, 1}, glass);
    b.add_panel({1.2, 1.0, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 3000.0);
    const Scene scene = b.build();
    const MirrorImages images(scene);
    EXPECT_NEAR(images.draws(), 0.1, 1e-12);
    EXPECT_EQ(images.draw_chain(0.5).chain, nullptr);
    ASSERT_NE(images.draw_chain(0.05).chain, nullptr);
    EXPECT_NEAR(images.draw_chain(0.05).probability, 0.1, 1e-12);
}

TEST(MirrorImages, OfARoomWithoutMirrorsAreNone) {
    test::Builder b;
    const MaterialId grey = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {3, 3, 3}, grey, grey, grey);
    b.add_panel({1.2, 1.0, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 3000.0);
    const Scene scene = b.build();
    const MirrorImages images(scene);
    EXPECT_EQ(images.draws(), 0.0);
    EXPECT_EQ(images.draw_chain(0.0).chain, nullptr);
}

/// Two mirrors that face each other and many small glossy sheets.
Scene mirrors_and_trinkets(std::size_t trinkets) {
    test::Builder b;
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.0), 0.8}, Sides::both});
    const MaterialId glossy =
        b.add_material({"glossy", Opaque{Rgb::grey(0.5), 0.05}, Sides::both});
    const MaterialId grey = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {9, 3, 3}, grey, grey, grey);
    for (std::size_t k = 0; k < trinkets; ++k)
        b.add_quad(
            {0.5 + 0.01 * static_cast<double>(k), 1, 0.5}, {0, 0.3, 0}, {0, 0, 0.3}, glossy);
    b.add_quad({0.1, 0.1, 0.1}, {0, 2.8, 0}, {0, 0, 2.8}, mirror);
    b.add_quad({8.9, 0.1, 0.1}, {0, 2.8, 0}, {0, 0, 2.8}, mirror);
    b.add_panel({1.2, 1.0, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 3000.0);
    return b.build();
}

TEST(MirrorImages, AreOfTheChainsThatMayBringMost) {
    constexpr std::uint32_t trinkets = 300;
    const Scene scene = mirrors_and_trinkets(trinkets);
    const MirrorImages images(scene);
    ASSERT_EQ(images.mirrors().size(), trinkets + 2U);
    const auto is_imaged = [&](const std::vector<std::uint32_t>& chain) {
        return std::ranges::count(images.chains(), chain) == 1;
    };
    constexpr std::uint32_t a = trinkets, b = trinkets + 1;
    EXPECT_TRUE(is_imaged({a, b, a, b}) && is_imaged({b, a, b, a}));
    EXPECT_TRUE(is_imaged({0}));
    EXPECT_FALSE(is_imaged({0, 1}));              // two glints of a trinket
    EXPECT_LE(images.chains().size(), 256U);      // for speed
    EXPECT_GT(images.share_without_image(), 0.0); // some of one reflection have none
}

TEST(MirrorImages, KnowTheChainsOfRays) {
    const Scene scene = mirrors_and_trinkets(3);
    const MirrorImages images(scene);
    std::vector<TriangleId> triangle(images.mirrors().size()); // one of each mirror
    for (std::size_t t = 0; t < scene.triangles.size(); ++t)
        if (images.mirror_of(TriangleId(t)) < triangle.size())
            triangle[images.mirror_of(TriangleId(t))] = TriangleId(t);
    std::set<std::uint32_t> numbers;
    for (const auto& chain : images.chains()) {
        std::uint32_t ray = MirrorImages::no_mirror;
        for (const std::uint32_t m : chain)
            ray = images.follow(ray, triangle[m]);
        EXPECT_TRUE(MirrorImages::covers(ray));
        numbers.insert(ray);
    }
    EXPECT_EQ(numbers.size(), images.chains().size()); // each has its own
    EXPECT_FALSE(MirrorImages::covers(MirrorImages::no_mirror));
    // Five reflections have no image, nor has whatever follows them.
    std::uint32_t ray = MirrorImages::no_mirror;
    for (int k = 0; k < 4; ++k)
        ray = images.follow(ray, triangle[3 + k % 2]);
    EXPECT_TRUE(MirrorImages::covers(ray));
    ray = images.follow(ray, triangle[3]);
    EXPECT_FALSE(MirrorImages::covers(ray));
    EXPECT_FALSE(MirrorImages::covers(images.follow(ray, triangle[4])));
}

/// A room of 198 m2 and so many mirrors of 0.3 m height side by side.
Scene mirrors_in_a_room(int count, double width, double strength) {
    test::Builder b;
    const MaterialId grey = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {9, 6, 3}, grey, grey, grey);
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.0), strength}, Sides::both});
    for (int k = 0; k < count; ++k)
        b.add_quad({1.0 + 0.01 * k, 1, 0.1}, {0, width, 0}, {0, 0, 0.3}, mirror);
    return b.build();
}

TEST(MirrorImages, AreNotOfFacetsOfRoundThings) {
    const Scene scene = mirrors_in_a_room(100, 0.004, 0.6);
    const MirrorImages images(scene);
    EXPECT_TRUE(images.chains().empty());
    // Of what meets chrome: all of it, for all we know.
    EXPECT_EQ(images.share_without_image(), 1.0);
    EXPECT_NEAR(images.expected_without_image(), 100 * 0.6 * 0.0012 / scene.total_area, 1e-12);
}

TEST(MirrorImages, OfOneMirrorAreAllThereAre) {
    const Scene scene = mirrors_in_a_room(1, 1.0, 0.2);
    const MirrorImages images(scene);
    ASSERT_EQ(images.chains().size(), 1U);
    EXPECT_EQ(images.share_without_image(), 0.0);
    EXPECT_EQ(images.expected_without_image(), 0.0);
}

TEST(MirrorImages, OfMoreMirrorsThanCanBeToldApartAreBoundedByAllOfThem) {
    // 600 weak ones: chains of one reflection and more are missing, 0.05 + 0.05^2 + ...
    const Scene scene = mirrors_in_a_room(600, 1.0, 0.05);
    const MirrorImages images(scene);
    EXPECT_EQ(images.mirrors().size(), 512U);
    EXPECT_NEAR(images.share_without_image(), 0.05 / 0.95, 1e-12);
}

} // namespace
} // namespace isolux
