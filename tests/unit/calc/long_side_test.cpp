#include <gtest/gtest.h>

#include "isolux/calc/long_side.h"
#include "isolux/scene/luminaire_body.h"

#include "support/photometric_files.h"

namespace isolux {
namespace {

LuminaireType make_type(double x, double y) {
    LuminaireType type;
    type.name = "linear";
    type.source = LambertianSource{Lumen(4800.0)};
    type.opening = {OpeningShape::rectangle, Metre(x), Metre(y), Metre(0)};
    return type;
}

Frame turned(double degrees_about_z) {
    return rotate(Frame{}, UnitVector3::from_unit({0, 0, 1}), degrees(degrees_about_z));
}

std::string text_for(double x, double y, std::vector<Frame> frames) {
    return describe_long_side(make_type(x, y), frames);
}

TEST(LongSide, LiesAlongTheLongerExtent) {
    EXPECT_EQ(text_for(1.2, 0.3, {Frame{}}), "long side 1.2 m along world x");
    EXPECT_EQ(text_for(0.3, 1.2, {Frame{}}), "long side 1.2 m along world y");
    EXPECT_EQ(text_for(0.6, 0.6, {Frame{}}), "no long side");
    EXPECT_EQ(text_for(0.0, 0.0, {Frame{}}), "no long side");
}

TEST(LongSide, TurnsWithTheLuminaireAndHasNoSense) {
    EXPECT_EQ(text_for(1.2, 0.3, {turned(90)}), "long side 1.2 m along world y");
    EXPECT_EQ(text_for(1.2, 0.3, {turned(180)}), "long side 1.2 m along world x");
    EXPECT_EQ(text_for(1.2, 0.3, {turned(-90)}), "long side 1.2 m along world y");
    EXPECT_EQ(text_for(1.2, 0.3, {turned(30)}), "long side 1.2 m along 30 degrees from x to y");
    EXPECT_EQ(text_for(1.2, 0.3, {turned(-30)}),
              "long side 1.2 m along 150 degrees from x to y");
}

TEST(LongSide, MayRiseOrStandUpright) {
    const UnitVector3 y = UnitVector3::from_unit({0, 1, 0});
    EXPECT_EQ(text_for(1.2, 0.3, {rotate(Frame{}, y, degrees(20))}),
              "long side 1.2 m along world x rising 20 degrees");
    EXPECT_EQ(text_for(1.2, 0.3, {rotate(Frame{}, y, degrees(90))}),
              "long side 1.2 m along the vertical");
}

TEST(LongSide, CountsDirections) {
    EXPECT_EQ(text_for(1.2, 0.3, {Frame{}, turned(90), turned(180)}),
              "long side 1.2 m along world x (2), world y (1)");
    EXPECT_EQ(text_for(1.2, 0.3, {turned(0), turned(10), turned(20), turned(30), turned(40)}),
              "long side 1.2 m in 5 directions");
}

TEST(DescribeLuminaires, CountsThemAndTheirFlux) {
    const std::vector<LuminaireType> types{make_type(1.2, 0.3), make_type(1.0, 1.0)};
    LuminairePlacement placement;
    placement.scale = 0.8;
    const std::vector<LuminairePlacement> placements{placement, placement};
    EXPECT_EQ(describe_luminaires(types, placements),
              (std::vector<std::string>{"2 x linear: 4800 lm each x 0.8 (maintenance, "
                                        "dimming), 7680 lm in all as hung; long "
                                        "side 1.2 m along world x"}));
}

LuminaireType read_type(const std::string& name) {
    LuminaireType type;
    auto parsed = corpus::read("valid", name);
    type.opening = parsed.value.opening;
    type.source = std::move(parsed.value);
    return type;
}

/// Two programs wrote each pair; the files keep the angles and exchange length and width, so
/// that body and light lie the same way in both.
TEST(LongSide, OfOneLuminaireIsTheSameFromLm63AndFromEulumdat) {
    ISOLUX_NEEDS_CORPUS();
    for (const auto& [pair, axis] :
         {std::pair{std::string("linear-pair"), "world x"}, {"profile-pair", "world y"}}) {
        const auto from_ies = find_long_side(read_type(pair + ".ies"));
        const auto from_ldt = find_long_side(read_type(pair + ".ldt"));
        ASSERT_TRUE(from_ies && from_ldt) << pair;
        EXPECT_EQ(from_ies->is_along_y, from_ldt->is_along_y) << pair;
        EXPECT_NEAR(from_ies->length, from_ldt->length, 0.005) << pair; // printed to cm
        for (const char* format : {".ies", ".ldt"})
            EXPECT_NE(describe_long_side(read_type(pair + format), std::vector<Frame>{Frame{}})
                          .find(std::string("along ") + axis),
                      std::string::npos)
                << pair << format;
    }
}

/// A table that shines downwards, with a body around its opening.
LuminaireType make_table_type(LuminousOpening opening, LuminousOpening housing) {
    LuminaireType type;
    type.source = LuminairePhotometry{
        .symmetry = "",
        .manufacturer = "",
        .name = "",
        .catalogue_number = "",
        .distribution = IntensityDistribution(
            {degrees(0), degrees(360)}, {degrees(0), degrees(90)}, {100, 100, 100, 100}),
        .opening = opening,
        .housing = housing,
        .declared_flux = {},
        .lamp_sets = {}};
    type.opening = opening;
    return type;
}

LuminousOpening rectangle(double x, double y) {
    return {OpeningShape::rectangle, Metre(x), Metre(y), Metre(0)};
}

TEST(LongSide, IsThatOfTheBodyWhereTheOpeningHasNone) {
    const auto side = find_long_side(make_table_type({}, rectangle(0.2, 0.9)));
    ASSERT_TRUE(side.has_value());
    EXPECT_TRUE(side->is_along_y);
    EXPECT_DOUBLE_EQ(side->length, 0.9);
    EXPECT_FALSE(find_long_side(make_table_type(rectangle(0.6, 0.6), {})).has_value());
}

TEST(VisibleBody, IsTheHousingUnlessTheProjectReplacesTheOpening) {
    LuminaireType type = make_table_type(rectangle(0.1, 1.1), rectangle(0.2, 1.2));
    EXPECT_DOUBLE_EQ(in_metre(visible_body(type).extent_y), 1.2);
    type.opening = rectangle(0.5, 0.5);
    EXPECT_DOUBLE_EQ(in_metre(visible_body(type).extent_y), 0.5);
    type = make_table_type(rectangle(0.1, 1.1), {});
    EXPECT_DOUBLE_EQ(in_metre(visible_body(type).extent_y), 1.1);
}

} // namespace
} // namespace isolux
