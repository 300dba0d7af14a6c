#include <gtest/gtest.h>

#include "isolux/calc/books.h"

#include "support/test_scene.h"

namespace isolux {
namespace {

struct Hung {
    const char* name;
    const char* group;
    std::size_t type;
};

/// Luminaires of two types of 1000 lm and 10 lm.
Scene scene_with(const std::vector<Hung>& luminaires) {
    test::Builder b;
    b.add_room(
        {0, 0, 0}, {4, 4, 3}, b.add_diffuse(0.5), b.add_diffuse(0.5), b.add_diffuse(0.5));
    b.add_isotropic_type(1000.0);
    b.add_isotropic_type(10.0);
    b.types[0].name = "panel";
    b.types[1].name = "spot";
    for (const Hung& h : luminaires) {
        b.add_point({2, 2, 2}, LuminaireTypeId(h.type));
        b.luminaires.back().placement.name = h.name;
        b.luminaires.back().placement.group = h.group;
    }
    return b.build();
}

TEST(LightSources, AreGroupsAndWithoutAGroupTypes) {
    const Scene scene = scene_with({{"a", "row 1", 0},
                                    {"b", "", 1},
                                    {"c", "row 2", 0},
                                    {"d", "row 1", 1},
                                    {"e", "", 1},
                                    {"f", "", 0}});
    const auto sources = find_light_sources(scene, SourceSplit::groups);
    ASSERT_EQ(sources.size(), 4U);
    EXPECT_EQ(sources[0].name, "row 1");
    EXPECT_EQ(sources[0].kind, SourceKind::group);
    EXPECT_EQ(sources[0].luminaires, (std::vector<std::size_t>{0, 3}));
    EXPECT_DOUBLE_EQ(sources[0].flux, 1010.0);
    EXPECT_EQ(sources[1].name, "spot");
    EXPECT_EQ(sources[1].kind, SourceKind::type);
    EXPECT_EQ(sources[1].luminaires, (std::vector<std::size_t>{1, 4}));
    EXPECT_EQ(sources[2].name, "row 2");
    EXPECT_EQ(sources[3].name, "panel");
    EXPECT_EQ(source_of_luminaires(sources, 6), (std::vector<std::uint32_t>{0, 1, 2, 0, 1, 3}));
}

TEST(LightSources, AreToldApartWhereAGroupIsCalledLikeAType) {
    const Scene scene = scene_with({{"a", "", 0}, {"b", "panel", 1}});
    const auto sources = find_light_sources(scene, SourceSplit::groups);
    ASSERT_EQ(sources.size(), 2U);
    EXPECT_EQ(sources[0].name, "panel (no group)");
    EXPECT_EQ(sources[1].name, "panel");
}

TEST(LightSources, AreSingleLuminairesWhereAskedFor) {
    const Scene scene = scene_with({{"lamp", "row", 0}, {"lamp", "row", 0}, {"x", "", 1}});
    const auto sources = find_light_sources(scene, SourceSplit::luminaires);
    ASSERT_EQ(sources.size(), 3U);
    EXPECT_EQ(sources[0].name, "lamp");
    EXPECT_EQ(sources[1].name, "lamp #2");
    EXPECT_EQ(sources[2].name, "x");
    EXPECT_EQ(sources[1].kind, SourceKind::luminaire);
}

/// 2 sources, 2 replicates, 3 points; every value another power of two.
Contributions small_table() {
    Contributions c;
    c.sources.resize(2);
    c.replicates = 2;
    c.points = 3;
    for (int i = 0; i < 12; ++i) {
        c.direct.push_back(static_cast<float>(1 << i));
        c.indirect.push_back(static_cast<float>(1 << i) / 4096.0F);
    }
    return c;
}

TEST(Contributions, AddUpWithTheirLevels) {
    const std::vector<double> levels{0.5, 3.0};
    const ReplicateTable t = combine(small_table(), levels, 1, 2);
    ASSERT_EQ(t.replicates, 2U);
    ASSERT_EQ(t.points, 2U);
    constexpr double both = 1.0 + 1.0 / 4096.0;
    // Source 0 holds bits 0-5, source 1 bits 6-11; replicate 1 and point 1 begin at 3 and 1.
    EXPECT_DOUBLE_EQ(t.row(0)[0], both * (0.5 * 2 + 3.0 * 128));
    EXPECT_DOUBLE_EQ(t.row(0)[1], both * (0.5 * 4 + 3.0 * 256));
    EXPECT_DOUBLE_EQ(t.row(1)[0], both * (0.5 * 16 + 3.0 * 1024));
    EXPECT_DOUBLE_EQ(t.row(1)[1], both * (0.5 * 32 + 3.0 * 2048));
}

TEST(Contributions, AddUpForOnePartAlone) {
    const std::vector<double> levels{1.0, 0.0};
    const ReplicateTable t = combine(small_table(), LightPart::indirect, levels, 0, 3);
    EXPECT_DOUBLE_EQ(t.row(1)[2], 32.0 / 4096.0);
}

/// Used, diffuse, not black: the others' paths tell nothing.
TEST(SensitiveMaterials, AreThoseThatReflectDiffusely) {
    test::Builder b;
    const MaterialId grey = b.add_diffuse(0.5);
    b.add_diffuse(0.7); // of nothing
    const MaterialId black = b.add_diffuse(0.0);
    const MaterialId mirror = b.add_material({"mirror", Opaque{{}, 0.9}, Sides::both});
    const MaterialId red = b.add_material({"red", Opaque{{0.5, 0.1, 0.1}, 0.1}, Sides::both});
    for (const MaterialId m : {grey, black, mirror, red})
        b.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, m);
    const auto found = find_sensitive_materials(b.build());
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].id, grey);
    EXPECT_EQ(found[0].reflectance, 0.5);
    EXPECT_EQ(found[1].name, "red");
    EXPECT_DOUBLE_EQ(found[1].reflectance, luminance_sum({0.5, 0.1, 0.1}));
}

Settings settings_with(SourceSplit split) {
    Settings settings;
    settings.contributions = split;
    return settings;
}

TEST(Books, AreKeptUnaskedUpToALimitAndSayWhereItIs) {
    const Scene scene = scene_with({{"a", "one", 0}, {"b", "two", 0}});
    const std::size_t most = most_automatic_values / (2 * 2 * 16);
    const auto notices = [&](std::size_t points, SourceSplit split) {
        CalculationSurface surface;
        surface.receivers.resize(1);
        const Books books(scene, settings_with(split), points, 16);
        Results results;
        books.close(Accumulator({&surface, 1}, 16), results);
        return std::pair(books.layout().sources, results.notices);
    };
    EXPECT_EQ(notices(most, SourceSplit::automatic).first, 2U);
    const auto [sources, said] = notices(most + 1, SourceSplit::automatic);
    EXPECT_EQ(sources, 0U);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(
        to_string(said[0]),
        "calculation: the light of 2 sources at 262145 points is not kept apart (the table "
        "would take 64 MiB). Set \"contributions\" to \"groups\" in the settings?");
    EXPECT_EQ(notices(most + 1, SourceSplit::groups).first, 2U);
    EXPECT_EQ(notices(1, SourceSplit::none).first, 0U);
    EXPECT_EQ(notices(1, SourceSplit::luminaires).first, 2U);
}

} // namespace
} // namespace isolux
