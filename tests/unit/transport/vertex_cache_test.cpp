#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/vertex_cache.h"

#include "support/random_importance.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

const Scene& room() {
    static const Scene scene = [] {
        test::Builder b;
        const MaterialId grey = b.add_diffuse(0.6);
        b.add_room({0, 0, 0}, {5, 4, 3}, grey, grey, grey);
        const MaterialId glossy =
            b.add_material({"glossy", Opaque{Rgb::grey(0.4), 0.3}, Sides::both});
        b.add_quad({1, 1, 0.7}, {2, 0, 0}, {0, 1, 0}, glossy);
        b.add_panel({2.0, 2.0, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 3000.0);
        return b.build();
    }();
    return scene;
}

VertexCache make_cache(std::size_t paths,
                       Weighing weighing,
                       bool is_guided,
                       std::uint32_t replicate,
                       VertexCache used = {}) {
    const auto m = static_cast<double>(paths);
    return build_vertex_cache(room(),
                              Emission(room()),
                              PathRandomness(7, replicate),
                              0,
                              paths,
                              {m, 2.5 * m, 1.0, 1.0, 0.5, 0.0, 0.3},
                              is_guided ? test::random_importance(room(), 3) : PathImportance{},
                              {},
                              weighing,
                              std::move(used));
}

template <class T> void expect_same(const std::vector<T>& a, const std::vector<T>& b) {
    static_assert(std::is_trivially_copyable_v<T>);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_EQ(std::memcmp(&a[i], &b[i], sizeof(T)), 0) << i;
}

void expect_same(const LeftVertices& a, const LeftVertices& b) {
    EXPECT_EQ(a.radius, b.radius);
    expect_same(a.first, b.first);
    ASSERT_EQ(a.all.size(), b.all.size());
    for (std::size_t i = 0; i < a.all.size(); ++i)
        EXPECT_EQ(a.all[i].place, b.all[i].place);
}

void expect_same(const VertexCache& a, const VertexCache& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t v = 0; v < a.size(); ++v) {
        EXPECT_EQ(length(a.vertices[v].position - b.vertices[v].position), 0.0);
        EXPECT_EQ(a.vertices[v].carried, b.vertices[v].carried);
    }
    EXPECT_EQ(a.paths, b.paths);
    EXPECT_EQ(a.carried, b.carried);
    EXPECT_EQ(a.flux.absorbed, b.flux.absorbed);
    EXPECT_EQ(a.flux.rays, b.flux.rays);
    expect_same(a.blocks, b.blocks);
    expect_same(a.vertex_at, b.vertex_at);
    expect_same(a.hands, b.hands);
    expect_same(a.picks, b.picks);
    expect_same(a.close, b.close);
    expect_same(a.mirrored, b.mirrored);
    ASSERT_EQ(a.tree.levels.size(), b.tree.levels.size());
    EXPECT_EQ(a.tree.left, b.tree.left);
}

TEST(VertexCache, IsTheSameInUsedMemory) {
    VertexCache used = make_cache(2048, Weighing::tree, true, 0);
    ASSERT_FALSE(used.picks.empty() || used.close.all.empty() || used.mirrored.all.empty()
                 || used.tree.empty());
    for (const Weighing weighing : {Weighing::all, Weighing::tree})
        for (const bool is_guided : {false, true})
            for (const std::size_t paths : {64U, 1000U, 256U}) {
                used = make_cache(paths, weighing, is_guided, 1, std::move(used));
                expect_same(used, make_cache(paths, weighing, is_guided, 1));
            }
}

TEST(VertexCache, ForgetsAllButItsMemory) {
    VertexCache cache = make_cache(2048, Weighing::tree, true, 0);
    const std::size_t room_for = cache.vertices.capacity();
    cache.clear();
    expect_same(cache, VertexCache{});
    EXPECT_EQ(cache.vertices.capacity(), room_for);
    // ... and so does one that is built of no paths
    cache = make_cache(0, Weighing::all, false, 0, make_cache(64, Weighing::all, false, 0));
    EXPECT_TRUE(cache.empty() && cache.blocks.empty() && cache.hands.empty());
}

} // namespace
} // namespace isolux
