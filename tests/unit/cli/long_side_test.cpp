#include <gtest/gtest.h>

#include "isolux/cli/long_side.h"

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
    EXPECT_EQ(
        describe_luminaires(types, placements),
        (std::vector<std::string>{"2 x linear: 4800 lm each, 7680 lm in all as hung; long "
                                  "side 1.2 m along world x"}));
}

} // namespace
} // namespace isolux
