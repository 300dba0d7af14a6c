#include <cmath>

#include <gmock/gmock.h>

#include "isolux/photometry/quantities.h"

#include "support/photometric_files.h"

/// Real luminaire files of makers.
namespace isolux {
namespace {

using corpus::read;

double candela(const LuminairePhotometry& l, double c, double gamma) {
    return l.distribution.evaluate(degrees(c), degrees(gamma)).value();
}

TEST(ValidFiles, AreAllRead) {
    ISOLUX_NEEDS_CORPUS();
    const auto names = corpus::files("valid");
    ASSERT_GE(names.size(), 40U);
    for (const std::string& name : names)
        EXPECT_NO_THROW({
            const auto parsed = read("valid", name);
            EXPECT_GT(parsed.value.distribution.flux().value(), 0.0) << name;
        }) << name;
}

/// Sum of what the pairs' two files print: one unit of the last digit of each.
void expect_same_light(const std::string& a, const std::string& b, double printed) {
    SCOPED_TRACE(a + " and " + b);
    const auto first = read("valid", a).value, second = read("valid", b).value;
    for (double c = 0; c < 360; c += 7.5)
        for (double g = 0; g <= 180; g += 2.5)
            ASSERT_NEAR(candela(first, c, g), candela(second, c, g), printed) << c << " " << g;
}

TEST(ValidFiles, AgreeWhereOneLuminaireComesInTwoFormats) {
    ISOLUX_NEEDS_CORPUS();
    expect_same_light("lampsets-pair.ies", "lampsets-pair.ldt", 0.11);
    expect_same_light("linear-pair.ies", "linear-pair.ldt", 0.011);
    expect_same_light("profile-pair.ies", "profile-pair.ldt", 1e-6);
    expect_same_light("spot-absolute.ies", "spot-absolute.ldt", 0.11);
    expect_same_light("street-c0.ies", "street-c0.ldt", 0.011);
    expect_same_light("street-c90.ies", "street-c90.ldt", 0.011);
}

TEST(ValidFiles, TurnTableAndBodyTogether) {
    ISOLUX_NEEDS_CORPUS();
    const auto lying = read("valid", "street-c90.ies").value;
    const auto turned = read("valid", "street-c90-rotated.ies").value;
    for (double c = 0; c < 360; c += 7.5)
        for (double g = 0; g <= 90; g += 2.5)
            ASSERT_NEAR(candela(lying, c, g), candela(turned, c - 90, g), 1e-6);
    EXPECT_EQ(lying.opening.extent_x, turned.opening.extent_y);
    EXPECT_EQ(lying.opening.extent_y, turned.opening.extent_x);
}

TEST(ValidFiles, PutTheLengthWhereTheFormatPutsIt) {
    ISOLUX_NEEDS_CORPUS();
    const auto radiance = read("valid", "radiance-examp1.ies").value; // 0.85 x 4.04 x 0.292 ft
    EXPECT_NEAR(radiance.opening.extent_x.value(), 4.04 * 0.3048, 1e-12);
    EXPECT_NEAR(radiance.opening.extent_y.value(), 0.85 * 0.3048, 1e-12);
    const auto linear = read("valid", "isym4-mc360.ldt").value; // 1190 x 90 mm
    EXPECT_NEAR(linear.opening.extent_y.value(), 1.190, 1e-12);
    EXPECT_NEAR(linear.opening.extent_x.value(), 0.090, 1e-12);
    EXPECT_NEAR(linear.housing.extent_y.value(), 0.090, 1e-12); // the file's own "length"
}

/// EULUMDAT files state their flux; those here are consistent with their own table, and makers'
/// programs use the trapezoid rule. Printed percents and intensities leave 0.1 %.
TEST(ValidFiles, HaveTheFluxTheyDeclare) {
    ISOLUX_NEEDS_CORPUS();
    for (const char* name : {"bom-absolute.ldt",
                             "isym3-ng181.ldt",
                             "isym4-all-planes-stored.ldt",
                             "isym4-mc360.ldt",
                             "linear-pair.ldt",
                             "street-c0.ldt",
                             "street-c90.ldt",
                             "two-sets-isym4-mc144.ldt",
                             "uplight-isym1.ldt",
                             "zumtobel-isym0-mc72.ldt"}) {
        const auto l = read("valid", name).value;
        ASSERT_TRUE(l.declared_flux.has_value());
        EXPECT_NEAR(l.distribution.flux_trapezoid() / *l.declared_flux, 1.0, 1e-3) << name;
    }
}

TEST(ValidFiles, NeverScaleToTheDeclaredLumens) {
    ISOLUX_NEEDS_CORPUS();
    const auto street = read("valid", "street-c0.ies"); // lumens field 102.52, table 6151 lm
    EXPECT_NEAR(street.value.distribution.flux_trapezoid().value(), 6151, 0.5);
    ASSERT_EQ(street.notices.size(), 1U);
    EXPECT_EQ(street.notices[0].where, "street-c0.ies:11");
    const auto lambert = read("valid", "lambert-wrong-lorl.ldt"); // LORL 0.3 percent
    EXPECT_NEAR(lambert.value.distribution.flux_trapezoid().value(), 995, 0.5);
    ASSERT_EQ(lambert.notices.size(), 1U);
    EXPECT_EQ(lambert.notices[0].where, "lambert-wrong-lorl.ldt:23");
}

TEST(ValidFiles, ShowHowFarTheFluxRulesDifferForNarrowBeams) {
    ISOLUX_NEEDS_CORPUS();
    const auto spot = read("valid", "narrow-spot-1995.ies").value;
    EXPECT_NEAR(spot.distribution.flux_trapezoid() / spot.distribution.flux(), 1.06, 0.005);
}

TEST(ValidFiles, SayWhenTheyAreUltraviolet) {
    ISOLUX_NEEDS_CORPUS();
    for (const char* name : {"uv-b1-multiplier.ies", "uv-tube-bilateral.ies"}) {
        const auto parsed = read("valid", name);
        EXPECT_THAT(parsed.notices,
                    testing::Contains(testing::Field(
                        &Message::what, testing::HasSubstr("the values are not candelas"))))
            << name;
    }
}

TEST(ValidFiles, DeliverEulumdatsDownwardFraction) {
    ISOLUX_NEEDS_CORPUS();
    // line 22 of each file; 0.18 points was the largest difference in 6592 files
    const std::vector<std::pair<std::string, double>> stated{
        {"cie190-table7.ldt", 99.9},
        {"isym3-ng181.ldt", 51.3},
        {"isym4-all-planes-stored.ldt", 89.4},
        {"two-sets-isym4-mc144.ldt", 87.0},
        {"uplight-isym1.ldt", 0.0},
        {"wall-isym2.ldt", 51.5},
        {"zumtobel-isym0-mc72.ldt", 98.5}};
    for (const auto& [name, percent] : stated)
        EXPECT_NEAR(
            100.0 * downward_fraction(read("valid", name).value.distribution), percent, 0.18)
            << name;
}

} // namespace
} // namespace isolux
