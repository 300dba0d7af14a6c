#include <cstdint>
#include <map>
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

} // namespace
} // namespace isolux
