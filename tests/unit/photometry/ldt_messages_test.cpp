#include <vector>

#include "unit/photometry/message_cases.h"

/// Every message that a EULUMDAT file can trigger, and those of telling formats apart.
namespace isolux {
namespace {

using messages::Case;

/// 4 planes at 90 degrees, 3 gammas, Isym 4 (2 stored planes); 200 lm by the trapezoid rule.
std::vector<std::string> good_lines() {
    std::vector<std::string> lines{"company", "3",    "4",      "4",    "90",   "3",   "45",
                                   "report",  "name", "number", "file", "date", "600", "100",
                                   "50",      "500",  "80",     "0",    "0",    "0",   "0",
                                   "100",     "",     "1",      "0",    "1",    "1",   "LED",
                                   "1000",    "4000", "80",     "10"}; // 32 lines
    for (int i = 0; i < 10; ++i)
        lines.push_back("0.5"); // 33..42
    for (const char* c : {"0", "90", "180", "270", "0", "45", "90"})
        lines.push_back(c); // 43..46 C, 47..49 gamma
    for (const char* i : {"100", "70", "0", "100", "80", "0"})
        lines.push_back(i); // 50..55
    lines[22] = "36";       // light output ratio, as the table has it
    return lines;
}

std::string join(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += line + "\n";
    return text;
}

/// Line `number` (from 1) replaced.
std::string with(std::size_t number, const std::string& value) {
    auto lines = good_lines();
    lines.at(number - 1) = value;
    return join(lines);
}

std::string cut(std::size_t count) {
    auto lines = good_lines();
    lines.resize(count);
    return join(lines);
}

TEST(LdtMessages, AGoodFileHasNone) {
    const auto parsed = parse_photometry(join(good_lines()), "a.ldt");
    EXPECT_THAT(parsed.notices, testing::IsEmpty());
}

class LdtError : public testing::TestWithParam<Case> {};

TEST_P(LdtError, NamesTheLineAndTheReason) { messages::expect_error(GetParam(), "a.ldt"); }

INSTANTIATE_TEST_SUITE_P(
    All,
    LdtError,
    testing::Values(
        Case{"empty", "", "1: the file is empty (no photometry)"},
        Case{"blank", "\n\n \n", "1: the file is empty (no photometry)"},
        Case{"cut_in_the_head",
             cut(20),
             "20: the file ends before the luminous height (EULUMDAT"},
        Case{"cut_in_the_table", cut(54), "54: the file ends before the intensity"},
        Case{"symmetry",
             with(3, "5"),
             "3: 5 as the symmetry indicator (must be a whole number fr"},
        Case{"symmetry_blank", with(3, ""), "3: blank line for the symmetry indicator"},
        Case{"planes", with(4, "0"), "4: 0 as the number of C planes (must be"},
        Case{"planes_huge", with(4, "1000000000"), "4: 1000000000 as the number of C planes"},
        Case{"gammas", with(6, "1"), "6: 1 as the number of gamma angles (must be"},
        Case{"text_for_number",
             with(13, "long"),
             "13: 'long' is not a number (expected: the lumi"},
        Case{"thousands",
             with(29, "1.000,5"),
             "29: '1.000,5' is not a number (expected: the flux of the lamp set). Write "
             "numbers"},
        Case{"set_count", with(26, "-1"), "26: -1 lamp sets (must be a whole number from 0 to"},
        Case{"set_count_wrong",
             with(26, "2"),
             "33: 0.5 as the number of lamps (must be whole). Does line 26 count"},
        Case{"set_count_short",
             with(26, "0"),
             "28: 'LED' is not a number (expected: the direct"},
        Case{"c_order", with(45, "80"), "45: C angle 80 after 90 (they must ascend)"},
        Case{"c_range", with(46, "400"), "43: C angles from 0 to 400 (they run from 0 to 360)"},
        Case{"gamma_order", with(48, "0"), "48: gamma angle 0 after 0 (they must ascend)"},
        Case{"gamma_range", with(49, "200"), "49: gamma angles from 0 to 200 (0 is straight"},
        Case{"no_c90", with(44, "80"), "4: 4 C planes without C90 (symmetry indicator 4 needs"},
        Case{"conversion", with(24, "-1"), "24: conversion factor -1 (it multiplies every"},
        Case{"nul", with(41, std::string("0\0", 2)), "41: NUL bytes"}),
    [](const auto& test) { return test.param.name; });

std::string overflowing() {
    auto lines = good_lines();
    lines[23] = "10";
    lines[49] = "1e308";
    return join(lines);
}

TEST(LdtMessages, RefuseIntensitiesThatNoDoubleHolds) {
    messages::expect_error({"", overflowing(), "50: 1e+308 times all factors is out of range"},
                           "a.ldt");
}

class LdtWarning : public testing::TestWithParam<Case> {};

TEST_P(LdtWarning, NamesTheLineAndWhatIsAssumed) {
    messages::expect_notice(GetParam(), "a.ldt");
}

std::string all_planes_stored() {
    auto lines = good_lines();
    for (const char* i : {"100", "70", "0", "100", "80", "0"})
        lines.push_back(i);
    return join(lines);
}

std::string no_lamp_sets() {
    auto lines = good_lines();
    lines[25] = "0";
    lines.erase(lines.begin() + 26, lines.begin() + 32);
    return join(lines);
}

std::string three_planes_without_symmetry() {
    auto lines = good_lines();
    lines[2] = "0";
    lines[3] = "3";
    lines.erase(lines.begin() + 45);
    for (const char* i : {"100", "80", "0"})
        lines.push_back(i);
    return join(lines);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    LdtWarning,
    testing::Values(
        Case{"comma", with(51, "70,0"), "51: decimal comma (EULUMDAT has decimal points"},
        Case{"blank_number",
             with(13, ""),
             "13: blank line for the luminaire length (read as 0)"},
        Case{"watts",
             with(32, "2x36 W"),
             "32: '2x36 W' for the watts of the lamp set (not a num"},
        Case{"type", with(2, "linear"), "2: 'linear' for the type indicator (not a number"},
        Case{"step",
             with(5, "30"),
             "44: C angle 90 after 0 (line 5 announces steps of 30; the l"},
        Case{"gamma_step", with(7, "30"), "48: gamma angle 45 after 0 (line 7 announces steps"},
        Case{
            "all_planes", all_planes_stored(), "3: symmetry indicator 4, but all 4 planes are"},
        Case{"more_lines",
             join(good_lines()) + "x\n",
             "56: 1 more line(s) after the table, from 'x'"},
        Case{"no_sets", no_lamp_sets(), "26: no lamp set (the absolute scale is unknown; 1000"},
        Case{"no_flux",
             with(29, "0"),
             "29: lamp flux 0 lm (the absolute scale is unknown; 1000"},
        Case{"conversion",
             with(24, "0"),
             "24: conversion factor 0 (it would put out the light;"},
        Case{"gamma_start", with(47, "5"), "47: gamma angles start at 5 (0 or 90 is usual"},
        Case{"gamma_end", with(49, "85"), "49: gamma angles end at 85 (90 or 180 is usual"},
        Case{"gap", three_planes_without_symmetry(), "45: no C plane between 180 and 360"},
        Case{"negative_size",
             with(16, "-500"),
             "16: luminous length -500 mm (sizes are not neg"},
        Case{"large",
             with(13, "600000"),
             "13: luminaire length 600000 mm (larger than a house)"},
        Case{"width_alone", with(16, "0"), "17: luminous width without a length (read as the"},
        Case{"dff", with(22, "130"), "22: downward flux fraction 130 % (must lie between"},
        Case{"dff_wrong",
             with(22, "50"),
             "22: downward flux fraction 50 % (the table gives 100 %"},
        Case{"lorl", with(23, "70"), "23: the table gives 328 lm, lamp flux and light output"},
        Case{"negative", with(52, "-1"), "52: 1 negative intensities, the first -1"}),
    [](const auto& test) { return test.param.name; });

TEST(LdtMessages, NameTheLampSetThatIsNotThere) {
    PhotometryOptions options;
    options.lamp_set = 2;
    messages::expect_error(
        {"", join(good_lines()), "26: lamp set 3 asked for (the file has 1)"},
        "a.ldt",
        options);
    messages::expect_error(
        {"", no_lamp_sets(), "26: lamp set 3 asked for (the file has none)"}, "a.ldt", options);
}

// ---- telling formats apart ---------------------------------------------------------------

TEST(FormatSniffing, BelievesTheContent) {
    messages::expect_notice({"", join(good_lines()), "1: EULUMDAT content under a LM-63 name"},
                            "a.ies");
    messages::expect_notice({"",
                             "x\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 90\n0\n5 5\n",
                             "1: LM-63 content under a EULUMDAT name"},
                            "a.LDT");
    EXPECT_EQ(parse_photometry(join(good_lines()), "without-extension").value.format,
              PhotometricFormat::eulumdat);
}

TEST(FormatSniffing, IsNotMisledByTexts) {
    for (const char* company : {"<company>", "IESNA member", "TILT=NONE"}) {
        auto lines = good_lines();
        lines[0] = company;
        EXPECT_EQ(parse_photometry(join(lines), "a.ldt").value.manufacturer, company);
    }
}

TEST(FormatSniffing, NamesWhatItCannotRead) {
    messages::expect_error({"", "PK\x03\x04 rest", "1: a ZIP container"}, "a.gldf");
    messages::expect_error({"", "<?xml version=\"1.0\"?>\n<x/>", "2: XML with the root 'x'"},
                           "a.xml");
    messages::expect_error({"", "hello\n", "1: neither LM-63 (no TILT= line) nor EULUMDAT"},
                           "a.txt");
    messages::expect_error({"", "IESNA:LM-63-2002\n", "1: no line begins with TILT="}, "a.txt");
}

// ---- encodings ----------------------------------------------------------------------------

std::string utf16(const std::string& ascii, bool is_big) {
    std::string text = is_big ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : ascii) {
        const std::string unit = is_big ? std::string{'\0', c} : std::string{c, '\0'};
        text += unit;
    }
    return text;
}

TEST(Encodings, AreDecoded) {
    auto lines = good_lines();
    lines[8] = "M\xFCnchen \x93x\x94"; // Windows-1252
    EXPECT_EQ(parse_photometry(join(lines), "a.ldt").value.name, "M\u00FCnchen \u201Cx\u201D");
    lines[8] = "M\u00FCnchen";
    EXPECT_EQ(parse_photometry(join(lines), "a.ldt").value.name, "M\u00FCnchen");
    for (const bool is_big : {false, true})
        messages::expect_notice(
            {"", utf16(join(good_lines()), is_big), "1: the text is UTF-16"}, "a.ldt");
}

TEST(Encodings, OddUtf16IsNoTrap) {
    for (const std::string& tail : {std::string("\x00", 1),              // half a unit
                                    std::string("\x00\xD8", 2),          // lone surrogate
                                    std::string("\x3D\xD8\x00\xDE", 4)}) // a pair
        EXPECT_NO_THROW(static_cast<void>(
            parse_photometry(utf16(join(good_lines()), false) + tail, "a.ldt")));
}

} // namespace
} // namespace isolux
