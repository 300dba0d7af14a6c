#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/cli/parse_values.h"

namespace isolux {
namespace {

template <class F> std::string message_of(F&& f) {
    try {
        f();
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

TEST(ParseTolerance, ReadsPercentAndShare) {
    EXPECT_DOUBLE_EQ(parse_tolerance("--tolerance", "1%"), 0.01);
    EXPECT_DOUBLE_EQ(parse_tolerance("--tolerance", " 2.5 % "), 0.025);
    EXPECT_DOUBLE_EQ(parse_tolerance("--tolerance", "0.01"), 0.01);
    EXPECT_DOUBLE_EQ(parse_tolerance("--tolerance", "5e-3"), 0.005);
}

TEST(ParseTolerance, AsksForThePercentSign) {
    EXPECT_EQ(message_of([] { (void)parse_tolerance("--tolerance", "1"); }),
              "--tolerance: 1 means 100 % (a tolerance is 0.01 % to 50 %). Did you forget the "
              "percent sign?");
}

TEST(ParseTolerance, HasTheBoundsOfTheProjectFile) {
    EXPECT_DOUBLE_EQ(parse_tolerance("--tolerance", "0.01%"), 1e-4);
    EXPECT_DOUBLE_EQ(parse_tolerance("--tolerance", "50%"), 0.5);
    EXPECT_EQ(message_of([] { (void)parse_tolerance("--tolerance", "51%"); }),
              "--tolerance: 51% means 51 % (a tolerance is 0.01 % to 50 %)");
    EXPECT_EQ(message_of([] { (void)parse_tolerance("--tolerance", "0"); }),
              "--tolerance: 0 means 0 % (a tolerance is 0.01 % to 50 %)");
    EXPECT_EQ(message_of([] { (void)parse_tolerance("--tolerance", "-1%"); }),
              "--tolerance: -1% means -1 % (a tolerance is 0.01 % to 50 %)");
}

TEST(ParseTolerance, RejectsWhatIsNoTolerance) {
    for (const char* text : {"", "%", "one", "1%%", "1 2", "nan", "inf", "0x1", "1,5%", "+-1"})
        EXPECT_EQ(message_of([&] { (void)parse_tolerance("--tolerance", text); }),
                  std::string("--tolerance: '") + text
                      + "' is not a tolerance. Write a share of the value such as 1% or 0.01");
}

TEST(ParseDuration, ReadsUsualUnits) {
    EXPECT_DOUBLE_EQ(parse_duration("--time", "60s").count(), 60.0);
    EXPECT_DOUBLE_EQ(parse_duration("--time", "60").count(), 60.0);
    EXPECT_DOUBLE_EQ(parse_duration("--time", "500ms").count(), 0.5);
    EXPECT_DOUBLE_EQ(parse_duration("--time", "1.5 min").count(), 90.0);
    EXPECT_DOUBLE_EQ(parse_duration("--time", "2m").count(), 120.0);
    EXPECT_DOUBLE_EQ(parse_duration("--time", "2h").count(), 7200.0);
}

TEST(ParseDuration, RejectsWhatIsNoTime) {
    for (const char* text : {"", "s", "soon", "1d", "1 s 2", "--1", "5e", "1e999"})
        EXPECT_EQ(message_of([&] { (void)parse_duration("--time", text); }),
                  std::string("--time: '") + text
                      + "' is not a time. Write a number and s, min or h, such as 60s, 1.5min "
                        "or 2h");
    EXPECT_EQ(message_of([] { (void)parse_duration("--time", "0s"); }),
              "--time: 0s is not above zero (nothing could be calculated). Write a number and "
              "s, min or h, such as 60s, 1.5min or 2h");
}

TEST(ParseCount, ReadsWholeNumbersInRange) {
    EXPECT_EQ(parse_count("--threads", "7", 1, 1024), 7u);
    EXPECT_EQ(parse_count("--seed", "18446744073709551615", 0, UINT64_MAX), UINT64_MAX);
}

TEST(ParseCount, RejectsFractionsSignsAndWhatIsOutOfRange) {
    for (const char* text : {"", "2.5", "-1", "+1", "two", "1e3"})
        EXPECT_EQ(message_of([&] { (void)parse_count("--threads", text, 1, 1024); }),
                  std::string("--threads: '") + text + "' is not a whole number");
    for (const char* text : {"0", "1025", "99999999999999999999999"})
        EXPECT_EQ(message_of([&] { (void)parse_count("--threads", text, 1, 1024); }),
                  std::string("--threads: ") + text + " is out of range (1 to 1024)");
}

TEST(ParseEstimator, KnowsShortAndLongNames) {
    EXPECT_EQ(parse_estimator("--estimator", "auto"), Estimator::automatic);
    EXPECT_EQ(parse_estimator("--estimator", "local"), Estimator::local_estimation);
    EXPECT_EQ(parse_estimator("--estimator", "mis"), Estimator::local_estimation_mis);
    EXPECT_EQ(parse_estimator("--estimator", "path-tracing"), Estimator::path_tracing);
    EXPECT_EQ(parse_estimator("--estimator", "automatic"), Estimator::automatic);
    EXPECT_EQ(parse_estimator("--estimator", "local-estimation"), Estimator::local_estimation);
    EXPECT_EQ(parse_estimator("--estimator", "local-estimation-mis"),
              Estimator::local_estimation_mis);
    EXPECT_EQ(parse_estimator("--estimator", "head"), Estimator::photometer_head);
    EXPECT_EQ(parse_estimator("--estimator", "photometer-head"), Estimator::photometer_head);
    EXPECT_EQ(parse_estimator("--estimator", "bounded"), Estimator::bounded);
    EXPECT_EQ(parse_estimator("--estimator", "bidirectional"), Estimator::bidirectional);
}

TEST(ParseEstimator, SuggestsTheNearestName) {
    EXPECT_EQ(message_of([] { (void)parse_estimator("--estimator", "path"); }),
              "--estimator: 'path' is not an estimator. Did you mean path-tracing?");
    EXPECT_EQ(message_of([] { (void)parse_estimator("--estimator", "radiosity"); }),
              "--estimator: 'radiosity' is not an estimator. Known are auto, local, mis, "
              "path-tracing, head, bounded, bidirectional");
}

TEST(ParseNumber, TakesFiniteDecimalNumbersOnly) {
    EXPECT_DOUBLE_EQ(parse_finite_number(" +1.5e2\r"), 150.0);
    EXPECT_DOUBLE_EQ(parse_finite_number("-.5"), -0.5);
    for (const char* text : {"", "1..2", "1e", "inf", "nan", "0x10", "1,5", "+-1", "++1"})
        EXPECT_TRUE(std::isnan(parse_finite_number(text))) << text;
}

} // namespace
} // namespace isolux
