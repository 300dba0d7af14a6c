#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "support/source_dir.h"

namespace isolux::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Ran photometry(std::vector<std::string> more) {
    more.insert(more.begin(), "photometry");
    return run_program(more);
}

/// The one message a refused command prints.
std::string complaint(const std::vector<std::string>& more) {
    const Ran ran = photometry(more);
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, "");
    return ran.err;
}

std::string shipped(const std::string& name) {
    return isolux::test::source_dir().string() + "/luminaires/" + name;
}

/// Cosine light of 100 cd straight down in one plane, opening 0.3 m wide, 1.2 m long.
constexpr const char* linear = "IESNA:LM-63-2002\n[TEST] 7\n[TESTLAB] lab\n[ISSUEDATE] today\n"
                               "[MANUFAC] maker\nTILT=NONE\n"
                               "1 400 1 4 1 1 2 0.3 1.2 0\n1 1 20\n0 30 60 90\n0\n"
                               "100 80 40 0\n";

TEST(PhotometryVerb, HelpsWithExamples) {
    EXPECT_THAT(run_program({"photometry", "--help"}).out, HasSubstr("info desk.ies"));
    for (const std::string sub : {"info", "candela", "convert", "ugr-table", "validate"})
        EXPECT_THAT(run_shell("$ISOLUX photometry " + sub + " --help").out,
                    HasSubstr("isolux photometry " + sub))
            << sub;
}

TEST(PhotometryVerb, AsksWhatToDo) {
    EXPECT_EQ(complaint({}),
              "error: isolux photometry: it is not said what to do. `isolux photometry --help` "
              "lists what there is\n");
    EXPECT_THAT(complaint({"inf", "x.ies"}), HasSubstr("'inf' is not known"));
}

TEST(PhotometryInfo, HasEveryPromisedKey) {
    const TemporaryFolder folder;
    const Ran ran = photometry({"info", "--json", folder.write("linear.ies", linear)});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const auto j = nlohmann::json::parse(ran.out);
    EXPECT_EQ(j["format"], "LM-63-2002");
    EXPECT_EQ(j["type"], "C");
    EXPECT_EQ(j["symmetry"], "rotational");
    EXPECT_EQ(j["planes"], 1);
    EXPECT_EQ(j["gammas"], 4);
    EXPECT_EQ(j["max_candela"], 100.0);
    EXPECT_EQ(j["max_at"]["c"], 0.0);
    EXPECT_EQ(j["max_at"]["gamma"], 0.0);
    // rule T by hand: 2 pi sum of zone means
    const double pi = std::acos(-1.0);
    const double c30 = std::cos(pi / 6), c60 = 0.5;
    EXPECT_NEAR(j["flux_lm"]["trapezoid"],
                2 * pi * (90 * (1 - c30) + 60 * (c30 - c60) + 20 * c60),
                1e-9);
    EXPECT_TRUE(j["flux_lm"]["interpolant"].is_number());
    EXPECT_TRUE(j["flux_lm"]["declared"].is_null());
    EXPECT_EQ(j["flux_lm"]["lamps"], 400.0);
    EXPECT_EQ(j["downward_fraction"], 1.0);
    EXPECT_EQ(j["lamps"], 1);
    EXPECT_EQ(j["input_watts"], 20.0);
    EXPECT_EQ(j["opening"]["shape"], "rectangle");
    EXPECT_EQ(j["opening"]["x_m"], 1.2);
    EXPECT_EQ(j["opening"]["y_m"], 0.3);
    EXPECT_EQ(j["opening"]["z_m"], 0.0);
    EXPECT_EQ(j["notices"].size(), 0u);
}

TEST(PhotometryInfo, GivesEachNoticeItsLine) {
    const TemporaryFolder folder;
    std::string text = linear;
    text.replace(text.find("1 1 20"), 6, "1 2 20");
    const Ran ran = photometry({"info", "--json", folder.write("odd.ies", text)});
    const auto j = nlohmann::json::parse(ran.out);
    ASSERT_EQ(j["notices"].size(), 1u);
    EXPECT_EQ(j["notices"][0]["line"], 8);
    EXPECT_THAT(j["notices"][0]["text"].get<std::string>(), HasSubstr("future use"));
}

TEST(PhotometryInfo, PrintsTextWithTheLongSide) {
    const TemporaryFolder folder;
    const Ran ran = photometry({"info", folder.write("linear.ies", linear)});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("long side along x (C0-C180)"));
    EXPECT_THAT(ran.out, HasSubstr("(trapezoid rule)"));
    EXPECT_THAT(photometry({"info", shipped("batwing-linear.ldt")}).out,
                HasSubstr("long side along y (C90-C270)"));
}

TEST(PhotometryInfo, LooksAtEveryFileAndSaysWhichFailed) {
    const TemporaryFolder folder;
    const std::string good = folder.write("linear.ies", linear);
    const std::string bad = folder.write("bad.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 2 3\n");
    const Ran ran = photometry({"info", "--json", bad, good});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, HasSubstr("bad.ies:3: the file ends before"));
    const auto j = nlohmann::json::parse(ran.out);
    ASSERT_EQ(j.size(), 2u);
    EXPECT_EQ(j[0]["errors"][0]["line"], 3);
    EXPECT_EQ(j[1]["lamps"], 1);
}

TEST(PhotometryInfo, WantsALampSetThatExists) {
    const std::string file = shipped("batwing-linear.ldt");
    EXPECT_THAT(complaint({"info", "--lamp-set", "x", file}),
                HasSubstr("--lamp-set: 'x' is not the number of a lamp set"));
    EXPECT_THAT(complaint({"info", "--lamp-set", "7", file}),
                HasSubstr("lamp set 7 asked for"));
}

TEST(PhotometryCandela, AnswersInTheOrderAsked) {
    const TemporaryFolder folder;
    const Ran ran = photometry(
        {"candela", folder.write("l.ies", linear), "0", "45", "-90", "0", "90", "120"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.out, "0 45 60\n-90 0 100\n90 120 0\n");
}

TEST(PhotometryCandela, RefusesOddAnglesByName) {
    const std::string file = shipped("high-bay.ies");
    EXPECT_THAT(complaint({"candela", file, "0", "30", "90"}), HasSubstr("C 90 has no gamma"));
    EXPECT_THAT(complaint({"candela", file, "0", "x"}),
                HasSubstr("'x' is not a number (expected: gamma)"));
    EXPECT_THAT(complaint({"candela", file, "0", "181"}),
                HasSubstr("gamma 181 is not between 0 (down) and 180 (up)"));
}

/// Candela in six directions as numbers.
std::vector<double> candelas(const std::string& file) {
    const Ran ran = photometry({"candela",
                                file,
                                "0",
                                "0",
                                "0",
                                "35",
                                "45",
                                "35",
                                "90",
                                "35",
                                "180",
                                "70",
                                "270",
                                "62"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    std::istringstream lines(ran.out);
    std::vector<double> values;
    for (double c = 0, gamma = 0, i = 0; lines >> c >> gamma >> i;)
        values.push_back(i);
    return values;
}

TEST(PhotometryConvert, LeavesTheLightWhereItIsAndTurnsTheBodysSizesRound) {
    const TemporaryFolder folder;
    for (const std::string name : {"batwing-linear", "wall-washer", "street-lantern"})
        for (const auto& [from, to] : {std::pair{".ldt", ".ies"}, std::pair{".ies", ".ldt"}}) {
            const std::string in = shipped(name + from);
            const std::string out = folder.path(name + to);
            const Ran ran = photometry({"convert", in, out});
            EXPECT_EQ(ran.exit_code, 0) << ran.err;
            const auto before = candelas(in);
            const auto after = candelas(out);
            ASSERT_EQ(before.size(), 6u);
            ASSERT_EQ(after.size(), 6u);
            const auto a = nlohmann::json::parse(photometry({"info", "--json", in}).out);
            // written with seven digits of the largest value, read with ten
            const double half_a_digit = 5.1e-7 * a["max_candela"].get<double>();
            for (std::size_t i = 0; i < 6; ++i)
                EXPECT_NEAR(before[i], after[i], half_a_digit) << name << i;
            const auto b = nlohmann::json::parse(photometry({"info", "--json", out}).out);
            EXPECT_NEAR(a["opening"]["x_m"], b["opening"]["x_m"], 1e-6);
            EXPECT_NEAR(a["opening"]["y_m"], b["opening"]["y_m"], 1e-6);
        }
}

TEST(PhotometryConvert, WritesTheEditionAskedFor) {
    const TemporaryFolder folder;
    const std::string in = folder.write("l.ies", linear);
    const std::string out = folder.path("out.ies");
    EXPECT_EQ(photometry({"convert", in, out}).exit_code, 0);
    EXPECT_THAT(read_text(out), StartsWith("IES:LM-63-2019\r\n[TEST] 7\r\n[TESTLAB] lab"));
    EXPECT_EQ(photometry({"convert", "--format", "lm63-2002", in, out}).exit_code, 0);
    EXPECT_THAT(read_text(out), StartsWith("IESNA:LM-63-2002\r\n"));
    EXPECT_THAT(complaint({"convert", in, folder.path("out.txt")}),
                HasSubstr("the name does not tell the format to write"));
    EXPECT_THAT(complaint({"convert", "--format", "lm63-2003", in, out}),
                HasSubstr("'lm63-2003' is not a format that can be written"));
}

TEST(PhotometryUgrTable, HasBothSpacingsAndNineteenRooms) {
    const Ran ran = photometry({"ugr-table", "--json", shipped("lambertian-panel.ldt")});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const auto j = nlohmann::json::parse(ran.out);
    ASSERT_EQ(j["tables"].size(), 2u);
    EXPECT_EQ(j["tables"][0]["spacing_to_height"], 0.25);
    EXPECT_EQ(j["tables"][1]["spacing_to_height"], 1.0);
    for (const auto& table : j["tables"])
        for (const std::string view : {"crosswise", "endwise"}) {
            EXPECT_EQ(table[view].size(), 19u);
            EXPECT_EQ(table[view][0]["ugr"].size(), 5u);
        }
    const std::string text = photometry({"ugr-table", shipped("lambertian-panel.ldt")}).out;
    EXPECT_THAT(text, HasSubstr("12H  8H"));
    EXPECT_THAT(text, HasSubstr("seen endwise"));
    EXPECT_THAT(
        text,
        HasSubstr("UGR corrected for the luminaire's own 3600 lm, spacing 0.25 x height\n"));
    EXPECT_NEAR(j["luminaire_flux_lm"].get<double>(), 3600.0, 1.0);
}

TEST(PhotometryUgrTable, SaysWhyThereIsNone) {
    const TemporaryFolder folder;
    std::string text = linear;
    text.replace(text.find("0.3 1.2 0"), 9, "0 0 0");
    EXPECT_THAT(complaint({"ugr-table", folder.write("point.ies", text)}),
                HasSubstr("no luminous area towards the observer"));
    EXPECT_THAT(complaint({"ugr-table", "--spacing", "2", folder.write("l.ies", linear)}),
                HasSubstr("'2' is not 0.25 or 1"));
}

TEST(PhotometryValidate, PrintsALineAFindingAndIsStrictOnDemand) {
    const TemporaryFolder folder;
    const std::string good = folder.write("linear.ies", linear);
    EXPECT_EQ(photometry({"validate", "--strict", good}).exit_code, 0);
    EXPECT_EQ(photometry({"validate", good}).out, "");
    std::string text = linear;
    text.replace(text.find("1 1 20"), 6, "1 2 20");
    const std::string odd = folder.write("odd.ies", text);
    const Ran lenient = photometry({"validate", odd, good});
    EXPECT_EQ(lenient.exit_code, 0);
    EXPECT_EQ(
        lenient.out,
        odd
            + ":8: 2 in the field kept for future use (LM-63-2002 asks for 1; ignored, not "
              "multiplied)\n");
    const Ran strict = photometry({"validate", "--strict", odd, good});
    EXPECT_EQ(strict.exit_code, 2);
    EXPECT_EQ(strict.out, lenient.out);
    const Ran broken = photometry({"validate", folder.write("b.ies", "no luminaire\n"), good});
    EXPECT_EQ(broken.exit_code, 2);
    EXPECT_THAT(broken.out, HasSubstr("b.ies:1: no line begins with TILT="));
    EXPECT_THAT(complaint({"info", "--strict", odd}), HasSubstr(":8: 2 in the field"));
}

} // namespace
} // namespace isolux::test
