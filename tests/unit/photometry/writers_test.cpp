#include <cmath>

#include <gmock/gmock.h>

#include "isolux/photometry/stored_table.h"
#include "isolux/photometry/write_ies.h"
#include "isolux/photometry/write_ldt.h"

#include "support/photometric_files.h"
#include "support/source_dir.h"

namespace isolux {
namespace {

constexpr int significant = 7; ///< what the writers print by default

/// The largest error that printing leaves: half a unit of the last digit.
double half_a_digit(double largest) {
    return 0.5 * std::pow(10.0, -decimals_for(largest, significant));
}

std::vector<UnitVector3> many_directions() {
    std::vector<UnitVector3> directions;
    for (double g = 0.7; g < 180; g += 3.3)
        for (double c = 0.4; c < 360; c += 9.7) {
            const double a = degrees(g).in_radians(), b = degrees(c).in_radians();
            directions.push_back(UnitVector3(
                {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), -std::cos(a)}));
        }
    return directions;
}

void expect_same_light(const LuminairePhotometry& a,
                       const LuminairePhotometry& b,
                       double printed) {
    // the way through degrees and back moves a node by 1e-15, and with it a steep table
    const double allowed = printed + 1e-9 * a.distribution.max_intensity().value();
    for (const UnitVector3& d : many_directions())
        ASSERT_NEAR(
            a.distribution.evaluate(d).value(), b.distribution.evaluate(d).value(), allowed)
            << d.x() << " " << d.y() << " " << d.z();
}

void expect_same_opening(const LuminousOpening& a, const LuminousOpening& b) {
    EXPECT_EQ(to_string(a.shape), to_string(b.shape));
    EXPECT_NEAR(a.extent_x.value(), b.extent_x.value(), 5e-7); // printed to micrometres
    EXPECT_NEAR(a.extent_y.value(), b.extent_y.value(), 5e-7);
    EXPECT_NEAR(a.extent_z.value(), b.extent_z.value(), 5e-7);
}

LuminairePhotometry reread(const Parsed<std::string>& text, const std::string& name) {
    return parse_photometry(text.value, name).value;
}

void expect_ies_round_trip(const LuminairePhotometry& l, PhotometricFormat edition) {
    IesWriteOptions options;
    options.edition = edition;
    const auto back = reread(write_ies(l, options), "back.ies");
    expect_same_light(l, back, half_a_digit(l.distribution.max_intensity().value()));
    expect_same_opening(l.opening, back.opening);
    EXPECT_EQ(back.format, edition);
    EXPECT_EQ(l.name, back.name);
    EXPECT_EQ(l.manufacturer, back.manufacturer);
    EXPECT_EQ(l.input_watts, back.input_watts);
}

void expect_ldt_round_trip(const LuminairePhotometry& l) {
    const auto text = write_ldt(l);
    const auto back = reread(text, "back.ldt");
    const double klm = back.lamp_sets.at(0).flux.value() / 1000.0;
    expect_same_light(
        l, back, klm * half_a_digit(l.distribution.max_intensity().value() / klm));
    if (text.notices.empty())
        expect_same_opening(l.opening, back.opening);
    EXPECT_EQ(l.name, back.name);
    EXPECT_EQ(l.manufacturer, back.manufacturer);
}

TEST(Writers, GiveBackEveryRealFile) {
    ISOLUX_NEEDS_CORPUS();
    for (const std::string& name : corpus::files("valid")) {
        SCOPED_TRACE(name);
        const auto l = corpus::read("valid", name).value;
        expect_ies_round_trip(l, PhotometricFormat::lm63_2002);
        expect_ies_round_trip(l, PhotometricFormat::lm63_2019);
        expect_ldt_round_trip(l);
    }
}

TEST(Writers, GiveBackEverySyntheticFile) {
    ISOLUX_NEEDS_CORPUS();
    for (const std::string& name : corpus::files("synthetic")) {
        SCOPED_TRACE(name);
        const auto l = corpus::read("synthetic", name).value;
        expect_ies_round_trip(l, PhotometricFormat::lm63_2019);
        if (l.photometric_type == 'C')
            expect_ldt_round_trip(l);
    }
}

TEST(Writers, StoreNoMorePlanesThanTheSymmetryNeeds) {
    ISOLUX_NEEDS_CORPUS();
    for (const char* name : {"linear-pair.ldt",
                             "spot-absolute.ies",
                             "street-c0.ldt",
                             "street-c90.ies",
                             "lampsets-pair.ldt",
                             "lampsets-pair.ies",
                             "road-uneven-c.ldt",
                             "cie190-table7.ldt",
                             "isym4-mc360.ldt"}) {
        SCOPED_TRACE(name);
        const auto l = corpus::read("valid", name).value;
        const auto as_ies = reread(write_ies(l), "back.ies");
        const auto as_ldt = reread(write_ldt(l), "back.ldt");
        EXPECT_EQ(as_ies.symmetry, l.symmetry);
        EXPECT_EQ(as_ldt.symmetry, l.symmetry);
        EXPECT_EQ(as_ldt.planes_in_file, l.planes_in_file);
        // without symmetry LM-63 repeats plane 0 as 360
        EXPECT_EQ(as_ies.planes_in_file, l.planes_in_file + (l.symmetry == "none" ? 1 : 0));
    }
}

LuminairePhotometry uniform(LuminousOpening opening) {
    return {.format = PhotometricFormat::lm63_2019,
            .photometric_type = 'C',
            .symmetry = {},
            .planes_in_file = 0,
            .gammas_in_file = 0,
            .manufacturer = "m",
            .name = "n",
            .catalogue_number = "c",
            .distribution = {{degrees(0), degrees(360)},
                             {degrees(0), degrees(90)},
                             {10.0, 10.0, 10.0, 10.0}},
            .opening = opening,
            .housing = opening,
            .is_absolute = true,
            .declared_flux = std::nullopt,
            .lamp_sets = {},
            .input_watts = 5.0};
}

TEST(Writers, CodeEveryShapeForLm63) {
    using enum OpeningShape;
    for (const OpeningShape shape : {point,
                                     rectangle,
                                     box,
                                     ellipse,
                                     vertical_cylinder,
                                     cylinder_along_x,
                                     cylinder_along_y,
                                     ellipsoid,
                                     vertical_ellipse}) {
        SCOPED_TRACE(to_string(shape));
        LuminousOpening o{shape, Metre(0.7), Metre(0.4), Metre(0.2)};
        if (shape == point)
            o = {};
        if (shape == rectangle || shape == ellipse)
            o.extent_z = Metre();
        if (shape == vertical_ellipse)
            o.extent_x = Metre();
        expect_ies_round_trip(uniform(o), PhotometricFormat::lm63_2002);
        expect_ies_round_trip(uniform(o), PhotometricFormat::lm63_2019);
    }
}

TEST(Writers, TellWhatEulumdatHasNoPlaceFor) {
    const auto sphere =
        write_ldt(uniform({OpeningShape::ellipsoid, Metre(0.3), Metre(0.3), Metre(0.3)}));
    ASSERT_EQ(sphere.notices.size(), 1U);
    EXPECT_EQ(to_string(sphere.notices[0]),
              "EULUMDAT: ellipsoid written as a box of its sizes (EULUMDAT has rectangles and "
              "round openings only)");
    auto half = uniform({});
    half.photometric_type = 'A';
    half.distribution = {
        {degrees(-90), degrees(90)}, {degrees(0), degrees(180)}, {10.0, 10.0, 10.0, 10.0}};
    const auto resampled = write_ldt(half);
    ASSERT_EQ(resampled.notices.size(), 1U);
    EXPECT_THAT(to_string(resampled.notices[0]), testing::HasSubstr("type A table resampled"));
}

TEST(Writers, TellWhatLm63HasNoPlaceFor) {
    auto l = uniform({OpeningShape::box, Metre(0.3), Metre(0.3), Metre(0.1)});
    l.lamp_sets = {{1, "a", Lumen(1000), "", "", 5.0}, {1, "b", Lumen(2000), "", "", 9.0}};
    l.side_heights = {{Metre(0.1), Metre(0.0), Metre(0.1), Metre(0.0)}};
    const auto text = write_ies(l);
    ASSERT_EQ(text.notices.size(), 2U);
    EXPECT_THAT(to_string(text.notices[0]),
                testing::HasSubstr("2 lamp sets, only the chosen one"));
    EXPECT_THAT(to_string(text.notices[1]), testing::HasSubstr("luminous heights differ"));
}

TEST(Writers, KeepStrangersTextOnOneLine) {
    auto l = uniform({});
    l.name = "two\r\nTILT=INCLUDE\nlines";
    EXPECT_EQ(reread(write_ies(l), "x.ies").name, "two  TILT=INCLUDE lines");
    EXPECT_EQ(reread(write_ldt(l), "x.ldt").name, "two  TILT=INCLUDE lines");
}

TEST(Writers, KeepTheKeywordsOfLm63OrSayThatTheyAreLeftOut) {
    const auto l =
        reread({"IESNA:LM-63-2002\n[TEST] 7\n[TESTLAB] t\n[ISSUEDATE] d\n[MANUFAC] m\n"
                "[SKTPOSITION] level\n[MORE] street side\n[LAMP] l\n[_OWN] 3\nTILT=NONE\n"
                "1 -1 1 3 1 1 2 0.1 0.2 0\n1 1 9\n0 45 90\n0\n9 8 7\n",
                {}},
               "x.ies");
    const auto back = reread(write_ies(l), "y.ies");
    ASSERT_EQ(back.other_labels.size(), 2U);
    EXPECT_EQ(back.other_labels[0].keyword, "SKTPOSITION");
    EXPECT_EQ(back.other_labels[0].text, "level street side");
    EXPECT_EQ(back.other_labels[1].keyword, "_OWN");
    const auto notices = write_ldt(l).notices;
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_EQ(notices[0].what, "left out: [SKTPOSITION], [_OWN] (EULUMDAT has no keywords)");
}

TEST(Writers, WriteTheChosenLampSetFirst) {
    auto l = uniform({});
    l.is_absolute = false;
    l.lamp_sets = {{1, "a", Lumen(1000), "", "", 5.0},
                   {1, "b", Lumen(2000), "", "", 9.0},
                   {1, "c", Lumen(3000), "", "", 12.0}};
    l.lamp_set = 2;
    const auto back = reread(write_ldt(l), "x.ldt");
    EXPECT_EQ(back.lamp_sets.at(0).type, "c");
    EXPECT_EQ(back.lamp_sets.at(1).type, "a");
    EXPECT_NEAR(back.distribution.flux().value(), l.distribution.flux().value(), 1e-3);
}

// ---- the sample luminaires ---------------------------------------------------------------

TEST(SampleLuminaires, AreTheSameLightInBothFormats) {
    const auto folder = isolux::test::source_dir() / "luminaires";
    int pairs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".ies")
            continue;
        ++pairs;
        SCOPED_TRACE(entry.path().filename().string());
        auto ldt_path = entry.path();
        ldt_path.replace_extension(".ldt");
        const auto ies = parse_photometry(corpus::read_bytes(entry.path()), "a.ies");
        const auto ldt = parse_photometry(corpus::read_bytes(ldt_path), "a.ldt");
        EXPECT_THAT(ies.notices, testing::IsEmpty());
        EXPECT_THAT(ldt.notices, testing::IsEmpty());
        const double klm = ldt.value.lamp_sets.at(0).flux.value() / 1000.0;
        const double printed =
            klm * half_a_digit(ies.value.distribution.max_intensity().value() / klm);
        expect_same_light(ies.value, ldt.value, printed);
        expect_same_opening(ies.value.opening, ldt.value.opening);
        // each candela is wrong by `printed` at most, so the flux by 4 pi times that
        EXPECT_NEAR(ies.value.distribution.flux().value(),
                    ldt.value.distribution.flux().value(),
                    12.6 * printed);
        EXPECT_EQ(ies.value.input_watts, ldt.value.input_watts);
        EXPECT_EQ(ies.value.is_absolute, ldt.value.is_absolute);
    }
    EXPECT_EQ(pairs, 6);
}

} // namespace
} // namespace isolux
