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
    const Ran tested =
        run_program({"selftest", "--only", "Lambertian disc", "--seed", "3", "-o", results_});
    EXPECT_EQ(tested.exit_code, 0) << tested.err;
    EXPECT_EQ(run_program({"report", results_}).exit_code, 0);
    EXPECT_NE(read_text(results_ + "/report.html")
                  .find("4 of 4 comparisons with known answers passed on the user's machine "
                        "(isolux " ISOLUX_VERSION ", seed 3)"),
              std::string::npos);
    static_cast<void>(folder_.write("out/selftest.json", "[]"));
    const Ran wrong = run_program({"report", results_});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_EQ(
        wrong.err,
        "error: " + results_
            + "/selftest.json: not the outcome of a self-test. Write it again with `isolux "
              "selftest -o`, or remove it.\n");
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
