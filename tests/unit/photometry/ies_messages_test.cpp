#include "isolux/photometry/source_text.h"

#include "unit/photometry/message_cases.h"

/// Every message that a LM-63 file can trigger.
namespace isolux {
namespace {

using messages::Case;
using messages::replaced;

const std::string good = "IESNA:LM-63-2002\n"
                         "[TEST] t\n[TESTLAB] l\n[ISSUEDATE] d\n[MANUFAC] m\n"
                         "TILT=NONE\n"              // 6
                         "1 -1 1 3 2 1 2 .1 .2 0\n" // 7
                         "1 1 50\n"                 // 8
                         "0 45 90\n"                // 9
                         "0 90\n"                   // 10
                         "10 8 0\n"                 // 11
                         "20 9 1\n";                // 12

std::string with(const std::string& from, const std::string& to) {
    return replaced(good, from, to);
}

TEST(IesMessages, AGoodFileHasOnlyTheNoteAboutItsTwoPlanes) {
    const auto parsed = parse_photometry(good, "a.ies");
    ASSERT_EQ(parsed.notices.size(), 1U);
    EXPECT_EQ(to_string(parsed.notices[0]),
              "a.ies:10: only the planes 0 and 90 are stored (linear between them)");
}

class IesError : public testing::TestWithParam<Case> {};

TEST_P(IesError, NamesTheLineAndTheReason) { messages::expect_error(GetParam(), "a.ies"); }

INSTANTIATE_TEST_SUITE_P(
    All,
    IesError,
    testing::Values(
        Case{"empty", "", "1: the file is empty (no photometry)"},
        Case{"nul",
             with("[TEST] t", std::string("[TEST] \0", 8)),
             "2: NUL bytes (this is no text"},
        Case{"no_tilt", with("TILT", "TLIT"), "12: no line begins with TILT="},
        Case{"not_a_number",
             with("8 0", "8x 0"),
             "11: '8x' is not a number (expected: the candela value)"},
        Case{"infinite",
             with("50", "inf"),
             "8: 'inf' is not a number (expected: the input watts)"},
        Case{"two_signs", with("10 8", "+-10 8"), "11: '+-10' is not a number"},
        Case{"header_cut",
             "TILT=NONE\n1 -1 1 3\n",
             "2: the file ends before the number of horiz"},
        Case{"one_vertical",
             with("1 3 2 1 2", "1 1 2 1 2"),
             "7: 1 as the number of vertical angles (must be a whole number, at least 2)"},
        Case{
            "half_a_plane", with("3 2 1 2", "3 2.5 1 2"), "7: 2.5 as the number of horizontal"},
        Case{
            "no_planes", with("3 2 1 2", "3 0 1 2"), "7: 0 as the number of horizontal angles"},
        Case{"too_many_angles",
             with("3 2 1 2", "3 99 1 2"),
             "7: 3 vertical and 99 horizontal angles announced, 11 numbers follow"},
        Case{"too_large_a_table",
             "x\nTILT=NONE\n1 -1 1 50 60 1 2 0 0 0\n1 1 9\n" +
                 [] {
                     std::string numbers;
                     for (int i = 0; i < 120; ++i)
                         numbers += std::to_string(i) + "\n";
                     return numbers;
                 }(),
             "3: 50 x 60 angles announced, 120 numbers follow (the table needs 3000)"},
        Case{"table_cut",
             with("20 9 1", "20 9"),
             "12: 6 candela values announced, 5 found (the table cannot be filled). Truncated"},
        Case{"decimal_commas",
             replaced(with("0 45 90", "0,0 45,0 90,0"), "10 8", "10,5 8"),
             "9: vertical angle 0 after 0 (they must ascend). Decimal commas?"},
        Case{"vertical_order",
             with("0 45 90", "0 95 90"),
             "9: vertical angle 90 after 95 (they"},
        Case{"horizontal_order", with("\n0 90", "\n90 0"), "10: horizontal angle 0 after 90"},
        Case{"multiplier", with("1 -1 1", "1 -1 0"), "7: candela multiplier 0 (it multiplies"},
        Case{"ballast", with("1 1 50", "-1 1 50"), "8: ballast factor -1 (it multiplies every"},
        Case{"ballast_lamp_factor",
             replaced(with("1 1 50", "1 0 50"), "IESNA:LM-63-2002", "IESNA91"),
             "8: ballast-lamp factor 0 (it multiplies every candela"},
        Case{"type", with("3 2 1 2", "3 2 5 2"), "7: photometric type 5 (must be 1 for C, 2"},
        Case{"units", with("3 2 1 2", "3 2 1 0"), "7: units type 0 (must be 1 for feet or 2"},
        Case{"overflow",
             with("10 8", "1e308 8").replace(good.find("1 -1 1"), 6, "1 -1 9"),
             "11: 1e+308 times all factors is out of range"},
        Case{"below_nadir", with("0 45 90", "-45 0 90"), "9: vertical angle -45 in type C"},
        Case{"above_zenith", with("0 45 90", "0 45 190"), "9: vertical angle 190 in type C"},
        Case{"no_symmetry",
             with("\n0 90", "\n0 80"),
             "10: horizontal angles 0 to 80 (LM-63 type"},
        Case{"one_plane_of_type_b",
             "x\nTILT=NONE\n1 -1 1 2 1 2 2 0 0 0\n1 1 9\n-90 90\n0\n5 5\n",
             "6: one horizontal angle in type A or B photometry"},
        Case{"type_a_too_wide",
             "x\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 9\n-90 90\n-90 180\n5 5 5 5\n",
             "6: horizontal angles -90 to 180 in type A or B photometry"},
        Case{"type_b_too_high",
             "x\nTILT=NONE\n1 -1 1 2 2 2 2 0 0 0\n1 1 9\n0 180\n-90 90\n5 5 5 5\n",
             "5: vertical angles 0 to 180 in type A or B photometry (they run from -90 to 90). "
             "Photometric type C?"},
        Case{"tilt_geometry",
             with("TILT=NONE\n", "TILT=INCLUDE\n4\n1\n0\n1\n"),
             "7: lamp-to-luminaire geometry 4 (must be 1, 2 or 3)"},
        Case{"tilt_missing",
             with("TILT=NONE\n", "TILT=INCLUDE\n"),
             "7: -1 as the number of tilt angles (must be a whole number, at least 1)"},
        Case{"tilt_too_long",
             with("TILT=NONE\n", "TILT=INCLUDE\n1\n900\n"),
             "8: 900 tilt angles and factors announced, only 24 numbers follow"},
        Case{"tilt_order",
             with("TILT=NONE\n", "TILT=INCLUDE\n1\n2\n90 0\n1 1\n"),
             "9: tilt angle 0 after 90 (they must ascend)"},
        Case{"tilt_negative",
             with("TILT=NONE\n", "TILT=INCLUDE\n1\n2\n0 90\n1 -1\n"),
             "10: tilt factor -1 (must not be negative)"}),
    [](const auto& test) { return test.param.name; });

class IesWarning : public testing::TestWithParam<Case> {};

TEST_P(IesWarning, NamesTheLineAndWhatIsAssumed) {
    messages::expect_notice(GetParam(), "a.ies");
}

INSTANTIATE_TEST_SUITE_P(
    All,
    IesWarning,
    testing::Values(
        Case{"carriage_returns",
             [] {
                 std::string text = good;
                 std::ranges::replace(text, '\n', '\r');
                 return text;
             }(),
             "1: lines end with carriage returns alone"},
        Case{"version_blank",
             with("IESNA:LM", "IESNA: LM"),
             "1: version line 'IESNA: LM-63-2002' is not as in any edition of LM-63 (read "
             "as LM-63-2002)"},
        Case{
            "version_lower_case", with("IESNA:LM", "iesna:lm"), "1: version line 'iesna:lm-63"},
        Case{"version_indented", " " + good, "1: version line 'IESNA:LM-63-2002' is not as in"},
        Case{"version_late", "\n" + good, "2: version line 'IESNA:LM-63-2002' is not as in"},
        Case{"version_unknown",
             with("2002", "2031"),
             "1: unknown version 'IESNA:LM-63-2031' (read as LM-63-1986, where both"},
        Case{"tilt_empty", with("NONE", ""), "6: TILT= without a value (read as TILT=NONE)"},
        Case{"rubbish_at_the_end",
             good + "END\n\x1a",
             "13: 2 more item(s) after the table, from 'END'"},
        Case{"future_use",
             with("1 1 50", "1 .9 50"),
             "8: 0.9 in the field kept for future use (LM-63-2002 asks for 1; ignored"},
        Case{"generation_type",
             replaced(with("1 1 50", "1 7 50"), "IESNA:LM-63-2002", "IES:LM-63-2019"),
             "8: file generation type 7 (LM-63-2019 knows 1 to 1.111"},
        Case{"tilt_file_2019",
             replaced(with("NONE", "a.tlt"), "IESNA:LM-63-2002", "IES:LM-63-2019"),
             "6: TILT names a file (LM-63-2019 has no tilt files)"},
        Case{"tilt_file_elsewhere",
             with("NONE", "..\\a.tlt"),
             "6: tilt file '..\\a.tlt' is not a plain file name beside this one, not opened "
             "(tilt "
             "factor 1 assumed)"},
        Case{"tilt_file_missing",
             with("NONE", "a.tlt"),
             "6: tilt file 'a.tlt' not found (tilt factor 1 assumed)"},
        Case{"lamps", with("1 -1 1", "0 -1 1"), "7: 0 lamps (must be a whole number from 1 up"},
        Case{
            "lumens", with("1 -1 1", "1 0 1"), "7: 0 lumens per lamp (neither rated lamps nor"},
        Case{"efficiency",
             with("1 -1 1", "1 9 1"),
             "7: the table gives 42 lm from lamps of 9 lm (more than all of it"},
        Case{"watts", with("1 1 50", "1 1 -50"), "8: -50 input watts (read as unknown, 0)"},
        Case{"units_of_intensity",
             with("TILT", "[_INTENSITYUNITS] mW/sr\nTILT"),
             "6: [_INTENSITYUNITS] 'mW/sr' (the values are not candelas"},
        Case{"radiation",
             with("TILT", "[_RADIATIONTYPE] UVC 222\nTILT"),
             "6: [_RADIATIONTYPE] 'UVC 222' (the values are not candelas"},
        Case{"large_opening",
             with(".1 .2 0", "300 1200 0"),
             "7: luminous opening 300 1200 0 metres (larger than a house). Millimetres"},
        Case{"shape_of_another_edition",
             with(".1 .2 0", "-.1 0 0"),
             "7: luminous opening -0.1 0 0 is not a shape code of LM-63-2002 (read as another "
             "edition's: ellipse)"},
        Case{"shape_unknown",
             with(".1 .2 0", "0 -.2 0"),
             "7: luminous opening 0 -0.2 0 is no shape code of any edition (read as a box"},
        Case{"first_vertical",
             with("0 45 90", "5 45 90"),
             "9: vertical angles start at 5 (LM-63"},
        Case{
            "last_vertical", with("0 45 90", "0 45 80"), "9: vertical angles end at 80 (LM-63"},
        Case{"closing_plane",
             with("\n0 90", "\n0 360"),
             "12: the last plane repeats the first but differs from it"},
        Case{"negative_planes",
             with("\n0 90", "\n-180 180").replace(good.size() - 7 + 5, 7, "10 8 0\n"),
             "10: horizontal angles -180 to 180 (LM-63 counts from 0 to 360; reduced to that)"},
        Case{"open_circle",
             with("\n0 90", "\n0 270"),
             "10: horizontal angles end at 270 (the plane"},
        Case{"negative_candela",
             with("10 8 0", "10 -8 0"),
             "11: 1 negative intensities, the first -8 (measurement noise; read as 0)"},
        Case{"dark",
             replaced(with("10 8 0", "0 0 0"), "20 9 1", "0 0 0"),
             "11: every intensity is 0 (this luminaire gives no light)"},
        Case{"type_b_narrow",
             "x\nTILT=NONE\n1 -1 1 2 2 2 2 0 0 0\n1 1 9\n-90 90\n-60 60\n5 5 5 5\n",
             "6: horizontal angles -60 to 60 (types A and B know 0 to 90 and -90 to 90; 0 cd"},
        Case{"type_b_low",
             "x\nTILT=NONE\n1 -1 1 2 2 2 2 0 0 0\n1 1 9\n-45 45\n-90 90\n5 5 5 5\n",
             "5: vertical angles -45 to 45 (types A and B know 0 to 90 and -90 to 90; 0 cd"}),
    [](const auto& test) { return test.param.name; });

class IesNote : public testing::TestWithParam<Case> {};

TEST_P(IesNote, IsToldButNeverRefused) { messages::expect_notice(GetParam(), "a.ies", true); }

INSTANTIATE_TEST_SUITE_P(
    All,
    IesNote,
    testing::Values(
        Case{"byte_order_mark", "\xEF\xBB\xBF" + good, "1: UTF-8 byte order mark"},
        Case{"no_version", with("IESNA:LM-63-2002\n", ""), "1: no version line (read as"},
        Case{"keywords",
             with("[TESTLAB] l\n", ""),
             "5: labels without [TESTLAB] (required by LM-63-2002"}),
    [](const auto& test) { return test.param.name; });

TEST(IesMessages, ReportTheTiltFileThatIsBroken) {
    PhotometryOptions options;
    options.sibling = [](std::string_view) {
        return std::optional<std::string>("1\n2\n0 x\n");
    };
    messages::expect_notice({"tilt",
                             with("NONE", "a.tlt"),
                             "6: tilt file unreadable: a.tlt:2: 2 tilt angles and factors "
                             "announced"},
                            "a.ies",
                            false,
                            options);
}

TEST(IesMessages, NeverAskForAFileOutsideTheFolder) {
    for (const char* name :
         {"../a.tlt", "/etc/passwd", "a/b.tlt", "C:a.tlt", "..", ".hidden"}) {
        bool was_asked = false;
        PhotometryOptions options;
        options.sibling = [&](std::string_view) {
            was_asked = true;
            return std::optional<std::string>();
        };
        static_cast<void>(parse_photometry(with("NONE", name), "a.ies", options));
        EXPECT_FALSE(was_asked) << name;
    }
}

TEST(IesMessages, RefuseWhatNoLuminaireFileNeeds) {
    const std::string huge(SourceText::max_bytes + 1, ' ');
    messages::expect_error(
        {"", huge, "1: the file has 33554433 bytes (no luminaire file needs"}, "a.ies");
}

TEST(IesMessages, StopAfterAHundred) {
    std::string text = good;
    for (int i = 0; i < 300; ++i)
        text = replaced(text, "TILT", "[_RADIATIONTYPE] UV\nTILT");
    const auto notices = parse_photometry(text, "a.ies").notices;
    ASSERT_EQ(notices.size(), 101U);
    EXPECT_EQ(notices.back().what, "more notices follow (left out)");
}

// ---- things that must pass unseen ---------------------------------------------------------

TEST(IesReader, AcceptsWhatTheFormatAllows) {
    const double nadir = parse_photometry(good, "a.ies")
                             .value.distribution.evaluate(degrees(0), degrees(0))
                             .value();
    for (const std::string& text : {with("10 8 0\n", "10,8,0\n"),
                                    with("10 8 0\n20", "10\n8\n0 20"),
                                    with("10 8 0", "1.0D+01 8. 0.0e0"),
                                    with("1 -1 1", "1. -1.0 +1"),
                                    with("TILT=NONE", "  tilt = None  "),
                                    with("\n", "\r\n"),
                                    with("\n[TEST]", "  \n[TEST]")}) {
        const auto parsed = parse_photometry(text, "a.ies");
        EXPECT_EQ(parsed.notices.size(), 1U) << text;
        EXPECT_EQ(parsed.value.distribution.evaluate(degrees(0), degrees(0)).value(), nadir);
    }
}

TEST(IesReader, TakesLinearTime) {
    std::string text = with("3 2 1 2", "3 200000 1 2");
    text = text.substr(0, text.find("\n0 90\n")) + "\n";
    for (int i = 0; i < 200000; ++i)
        text += std::to_string(i * 0.0018) + " ";
    text += std::string(600000, '\r'); // a lone return each
    EXPECT_THROW(static_cast<void>(parse_photometry(text, "a.ies")), InputError);
}

} // namespace
} // namespace isolux
