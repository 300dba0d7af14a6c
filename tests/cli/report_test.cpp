#include <filesystem>

#include <gtest/gtest.h>

#include "cli/office.h"
#include "cli/program.h"

namespace isolux::test {
namespace {

class ReportVerb : public testing::Test {
protected:
    TemporaryFolder folder_;
    std::string results_ = folder_.path("out");

    void calculate() const {
        const std::string project = folder_.write("office.json", office);
        const Ran ran = run_program({"run", project, "-o", results_, "--tolerance", "5%"});
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        std::filesystem::remove(project);
    }
};

TEST_F(ReportVerb, AndOthersTakeTheFileOfResultsForItsFolder) {
    calculate();
    const std::string file = results_ + "/results.json";
    EXPECT_EQ(run_program({"report", file}).out,
              results_ + "/report.html\n" + results_ + "/report.pdf\n");
    EXPECT_EQ(run_program({"view", file, "--probe", "1,1,1"}).exit_code, 0);
}

TEST_F(ReportVerb, WritesAgainWhatRunHasWritten) {
    calculate();
    const std::string html = read_text(results_ + "/report.html");
    const std::string pdf = read_text(results_ + "/report.pdf");
    EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
    EXPECT_TRUE(pdf.starts_with("%PDF-"));
    std::filesystem::remove(results_ + "/report.html");
    std::filesystem::remove(results_ + "/report.pdf");
    const Ran ran = run_program({"report", results_}); // the project is gone
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.out, results_ + "/report.html\n" + results_ + "/report.pdf\n");
    EXPECT_EQ(read_text(results_ + "/report.html"), html);
    EXPECT_EQ(read_text(results_ + "/report.pdf"), pdf);
}

TEST_F(ReportVerb, WritesOneFileWhereItIsTold) {
    calculate();
    const std::string file = folder_.path("a.pdf");
    const Ran ran = run_program({"report", results_, "-o", file});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(read_text(file).starts_with("%PDF-"));
    const Ran wrong = run_program({"report", results_, "-o", "a.docx"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_EQ(wrong.err,
              "error: a.docx: no report format goes by this name. A name that ends in .html or "
              ".pdf?\n");
}

TEST_F(ReportVerb, QuotesTheSelfTestLeftInTheFolder) {
    calculate();
    EXPECT_NE(
        read_text(results_ + "/report.html").find("not part of this folder; `isolux selftest"),
        std::string::npos);
    const auto line_after = [&](const std::string& json) {
        static_cast<void>(folder_.write("out/selftest.json", json));
        EXPECT_EQ(run_program({"report", results_}).exit_code, 0);
        return read_text(results_ + "/report.html");
    };
    EXPECT_NE(line_after(
                  R"({"version": "0.9", "seed": 3, "rows": [{"pass": true}, {"pass": false}]})")
                  .find("1 of 2 comparisons with known answers passed (isolux 0.9, seed 3)"),
              std::string::npos);
    EXPECT_NE(line_after("[]").find("not part of this folder"), std::string::npos);
    const Ran part = run_program({"selftest", "--only", "Lambertian disc", "-o", results_});
    EXPECT_EQ(part.exit_code, 2);
    EXPECT_EQ(
        part.err,
        "error: --output: some cases alone are no self-test to quote. Leave --only out.\n");
}

TEST_F(ReportVerb, SaysWhatIsNoResultsFolder) {
    const Ran ran = run_program({"report", folder_.path()});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_NE(ran.err.find("results.json"), std::string::npos) << ran.err;
}

TEST_F(ReportVerb, RecordsWhetherTheLengthAxisWasAligned) {
    calculate();
    const std::string json = read_text(results_ + "/results.json");
    EXPECT_NE(json.find("\"align_length_axis\": "), std::string::npos);
    EXPECT_NE(json.find("\"long_side\": {\"axis\":\"x\""), std::string::npos);
}

} // namespace
} // namespace isolux::test
