#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/photometry/quantities.h"
#include "isolux/photometry/read_photometry.h"

namespace isolux {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// I(h, v) = 100 + v + h, on quadrant planes.
std::string int_data(double scale = 1.0) {
    std::string text;
    for (const int v : {90, 0, 45}) // any order will do
        for (const int h : {0, 45, 90})
            text += "<IntData h=\"" + std::to_string(h) + "\" v=\"" + std::to_string(v) + "\">"
                    + std::to_string(scale * (100 + v + h)) + "</IntData>\n";
    return text;
}

std::string emitter(const std::string& data, const std::string& more = {}) {
    return "<Emitter><Quantity>2</Quantity><Description>LED</Description>\n" + more
           + "<InputWattage>10</InputWattage><LuminousData><LuminousIntensity>\n"
             "<Multiplier>2</Multiplier><NumberHorz>3</NumberHorz><NumberVert>3</NumberVert>\n"
           + data + "</LuminousIntensity></LuminousData></Emitter>\n";
}

std::string file(const std::string& emitters) {
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<IESTM33-22><Version>1.1</Version>\n"
           "<Header><Manufacturer>Mak\xC3\xA4r</Manufacturer><Description>Desk</Description>"
           "<Laboratory>Lab</Laboratory><ReportNumber>R1</ReportNumber>"
           "<ReportDate>2024-02-01</ReportDate></Header>\n"
           "<Luminaire><Dimensions><Length>1.2</Length><Width>0.3</Width><Height>0.1</Height>"
           "</Dimensions></Luminaire>\n"
           + emitters + "</IESTM33-22>\n";
}

double candela(const LuminairePhotometry& l, double c, double gamma) {
    return intensity_towards(l, degrees(c), degrees(gamma)).value();
}

std::string refusal(const std::string& text, bool strict = false) {
    PhotometryOptions options;
    options.strict = strict;
    try {
        static_cast<void>(parse_photometry(text, "a.xml", options));
    } catch (const InputError& error) {
        return error.what();
    }
    return "(not refused)";
}

std::string notices(const Parsed<LuminairePhotometry>& parsed) {
    std::string text;
    for (const Message& m : parsed.notices)
        text += to_string(m) + "\n";
    return text;
}

TEST(Tm33, ReadsATableDirectlyWithinTheLuminousData) {
    const auto with_type = [](const std::string& type) {
        return file("<Emitter><RatedLumens>4000</RatedLumens><LuminousData>\n<PhotometryType>"
                    + type
                    + "</PhotometryType><Metric>Luminous</Metric>\n"
                      "<IntensityData horz=\"0\" vert=\"0\">300</IntensityData>\n"
                      "<IntensityData horz=\"0\" vert=\"90\">0</IntensityData>\n"
                      "</LuminousData></Emitter>\n");
    };
    const auto parsed = parse_photometry(with_type("CIE _ C"), "a.xml");
    EXPECT_NEAR(candela(parsed.value, 77, 45), 150.0, 1e-9);
    // 2 pi x 300 cd x (1 - 2/pi) = 685 lm: 17 % of 4000 lm
    EXPECT_THAT(notices(parsed), HasSubstr("a.xml:5: the table gives"));
    EXPECT_THAT(notices(parsed),
                HasSubstr("of the rated 4000 lm (read as candelas; are they per 1000 lm?)"));
    std::string dimmer = with_type("CIE _ C"); // 685 lm of 2200 lm, 31 %: nothing to say
    dimmer.replace(dimmer.find(">4000<"), 6, ">2200<");
    EXPECT_THAT(notices(parse_photometry(dimmer, "a.xml")), Not(HasSubstr("per 1000 lm")));
    EXPECT_THAT(refusal(with_type("CIE _ B")),
                HasSubstr("photometry type 'CIE _ B' (only type C is read from TM-33)"));
}

TEST(Tm33, ReadsIntensitiesInAnyOrderAndMirrorsTheQuadrant) {
    const auto parsed = parse_photometry(file(emitter(int_data())), "a.xml");
    const LuminairePhotometry& l = parsed.value;
    EXPECT_EQ(l.format, PhotometricFormat::tm33);
    EXPECT_EQ(l.symmetry, "quadrant");
    EXPECT_EQ(l.planes_in_file, 3u);
    EXPECT_EQ(l.gammas_in_file, 3u);
    EXPECT_EQ(l.manufacturer, "Mak\xC3\xA4r");
    EXPECT_EQ(l.name, "Desk");
    EXPECT_EQ(l.report, "R1");
    EXPECT_EQ(l.input_watts, 10.0);
    EXPECT_NEAR(candela(l, 0, 0), 200.0, 1e-9); // times the multiplier
    EXPECT_NEAR(candela(l, 45, 90), 470.0, 1e-9);
    EXPECT_NEAR(candela(l, 135, 45), 380.0, 1e-9);
    EXPECT_NEAR(candela(l, 270, 90), 560.0, 1e-9);
    EXPECT_NEAR(candela(l, 0, 120), 0.0, 0.0);
}

/// The schema bounds the face towards C0 by Length and Height: the length lies along our y.
TEST(Tm33, LaysTheLengthAlongC90) {
    const std::string areas =
        "<EmissionAreas><BottomFace><NumberBottom>1</NumberBottom><BottomArea>"
        "<Length>1.1</Length><Width>0.2</Width></BottomArea></BottomFace><C0Face>"
        "<C0Area><Length>1.1</Length><Height>0.05</Height></C0Area></C0Face></EmissionAreas>";
    const auto parsed = parse_photometry(file(emitter(int_data(), areas)), "a.xml");
    EXPECT_EQ(parsed.value.opening.shape, OpeningShape::box);
    EXPECT_DOUBLE_EQ(parsed.value.opening.extent_x.value(), 0.2);
    EXPECT_DOUBLE_EQ(parsed.value.opening.extent_y.value(), 1.1);
    EXPECT_DOUBLE_EQ(parsed.value.opening.extent_z.value(), 0.05);
    EXPECT_DOUBLE_EQ(parsed.value.housing.extent_y.value(), 1.2);
    EXPECT_EQ(notices(parsed), "");
}

TEST(Tm33, TakesTheFootprintWhereNoAreaIsStatedAndSaysSo) {
    const auto parsed = parse_photometry(file(emitter(int_data())), "a.xml");
    EXPECT_DOUBLE_EQ(parsed.value.opening.extent_x.value(), 0.3);
    EXPECT_DOUBLE_EQ(parsed.value.opening.extent_y.value(), 1.2);
    EXPECT_THAT(notices(parsed), HasSubstr("a.xml:5: no emission areas"));
}

TEST(Tm33, AddsUpEmitters) {
    const auto parsed =
        parse_photometry(file(emitter(int_data()) + emitter(int_data(0.5))), "a.xml");
    EXPECT_NEAR(candela(parsed.value, 20, 30), 1.5 * 2 * 150, 1e-9);
    EXPECT_EQ(parsed.value.input_watts, 20.0);
    EXPECT_THAT(notices(parsed), HasSubstr("2 emitters (all shine at full power"));
}

TEST(Tm33, ReadsTheFirstEditionWithItsNamesAndMillimetres) {
    const std::string text =
        "<LuminaireOpticalData version=\"1.0\" xmlns=\"http://www.ies.org/tm-33\"><Header/>"
        "<Luminaire><Dimensions><Length>1170</Length><Width>90</Width><Height>0</Height>"
        "</Dimensions></Luminaire><Emitter><RatedLumens>2000</RatedLumens>"
        "<InputWatts>12</InputWatts><IntensityDistribution><PhotometryType>C</PhotometryType>"
        "<Metric>Luminous</Metric><Units>cd/klm</Units>"
        "<IntensityData horz=\"0\" vert=\"0\">100</IntensityData>"
        "<IntensityData horz=\"0\" vert=\"90\">50</IntensityData>"
        "</IntensityDistribution></Emitter></LuminaireOpticalData>";
    const LuminairePhotometry l = parse_photometry(text, "a.xml").value;
    EXPECT_NEAR(candela(l, 123, 0), 200.0, 1e-9);
    EXPECT_EQ(l.symmetry, "rotational");
    EXPECT_DOUBLE_EQ(l.housing.extent_y.value(), 1.17);
    EXPECT_EQ(l.input_watts, 12.0);
}

TEST(Tm33, RefusesWithTheLine) {
    const std::string good = file(emitter(int_data()));
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return text;
    };
    EXPECT_THAT(refusal(with("</IESTM33-22>", "")), HasSubstr("not well-formed XML"));
    EXPECT_THAT(refusal(with("h=\"0\" v=\"90\"", "h=\"0\"")),
                StartsWith("a.xml:8: IntData without the attribute v"));
    EXPECT_THAT(refusal(with("h=\"0\" v=\"90\"", "h=\"0\" v=\"nan\"")),
                StartsWith("a.xml:8: 'nan' is not a number"));
    EXPECT_THAT(refusal(with("h=\"0\" v=\"90\"", "h=\"0\" v=\"91\"")),
                HasSubstr("every combination of angles must be there once"));
    EXPECT_THAT(refusal(with("h=\"0\" v=\"90\"", "h=\"90\" v=\"90\"")),
                HasSubstr("is given twice (line 8 has it, too)"));
    EXPECT_THAT(refusal(with(">190.000000<", ">1x<")), HasSubstr("'1x' is not a number"));
    EXPECT_THAT(refusal(with("<Multiplier>2", "<Multiplier>0")),
                StartsWith("a.xml:7: multiplier 0"));
    EXPECT_THAT(refusal("<html>\n<body/></html>"), HasSubstr("XML with the root 'html'"));
    EXPECT_THAT(refusal(file("<Emitter><PhotonData/></Emitter>")),
                HasSubstr("1 emitters, none with luminous intensity"));
    EXPECT_THAT(refusal(file("")), HasSubstr("0 emitters"));
    std::string deep;
    for (int i = 0; i < 100; ++i)
        deep += "<a>";
    for (int i = 0; i < 100; ++i)
        deep += "</a>";
    EXPECT_THAT(refusal(file(deep)), HasSubstr("nest deeper than 64"));
}

TEST(Tm33, NoticesWhatDisagreesAndStrictRefusesIt) {
    const auto odd = file(emitter(int_data(), "<RatedLumens>3</RatedLumens>\n"));
    EXPECT_THAT(notices(parse_photometry(odd, "a.xml")), HasSubstr("the emitter states 3 lm"));
    EXPECT_THAT(refusal(odd, true), HasSubstr("the emitter states 3 lm"));
    std::string counts = file(emitter(int_data()));
    counts.replace(counts.find("<NumberHorz>3"), 13, "<NumberHorz>4");
    EXPECT_THAT(notices(parse_photometry(counts, "a.xml")),
                HasSubstr("4 x 3 angles announced, 9 intensities found"));
    std::string large = file(emitter(int_data()));
    large.replace(large.find("<Length>1.2"), 11, "<Length>1200");
    EXPECT_THAT(notices(parse_photometry(large, "a.xml")), HasSubstr("read as millimetres"));
}

} // namespace
} // namespace isolux
