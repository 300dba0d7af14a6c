#include <cstdlib>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/io/csv.h"

#include "support/sample_results.h"

namespace isolux {
namespace {

using testing::ElementsAre;

TEST(ShortestNumber, ReadsBackExactlyWithADecimalPoint) {
    EXPECT_EQ(to_shortest(0.1), "0.1");
    EXPECT_EQ(to_shortest(500.0), "500");
    EXPECT_EQ(to_shortest(-1.0 / 3.0), "-0.3333333333333333");
    EXPECT_EQ(to_shortest(1e-9), "1e-09");
    test::NormalDraws normal(5);
    for (int i = 0; i < 1000; ++i) {
        const double x = normal() * 1e3;
        EXPECT_EQ(std::strtod(to_shortest(x).c_str(), nullptr), x);
    }
    const double largest = std::numeric_limits<double>::max();
    EXPECT_EQ(std::strtod(to_shortest(largest).c_str(), nullptr), largest);
}

TEST(SurfaceCsv, HasOneHeaderRowWithUnitsAndOneRowAPoint) {
    const SurfaceResult s = test::make_results().surfaces[0];
    const auto records = parse_csv(to_csv(s, 0.95), "a.csv");
    ASSERT_EQ(records.size(), 1U + s.points.size());
    EXPECT_THAT(records[0].fields,
                ElementsAre("x_m",
                            "y_m",
                            "z_m",
                            "nx",
                            "ny",
                            "nz",
                            "illuminance_lx",
                            "standard_error_lx",
                            "lower_lx",
                            "upper_lx",
                            "direct_lx",
                            "indirect_lx",
                            "flags"));
    for (const CsvRecord& r : records)
        EXPECT_EQ(r.fields.size(), 13U);
    EXPECT_EQ(records[1].fields[0], "0.5");
    EXPECT_EQ(records[1].fields[2], "0.75");
    EXPECT_EQ(records[1].fields[5], "1");
    EXPECT_EQ(records[1].fields[12], "");
    EXPECT_EQ(records[2].fields[12], "heavy_tail near_surface");
}

TEST(SurfaceCsv, CarriesEveryValueExactly) {
    const SurfaceResult s = test::make_results().surfaces[1];
    const auto records = parse_csv(to_csv(s, 0.99), "a.csv");
    EXPECT_EQ(records[0].fields[6], "semi_cylindrical_illuminance_lx");
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        const PointResult& p = s.points[i];
        const Interval interval = confidence_interval(p.total, 0.99);
        const auto number = [&](std::size_t column) {
            return std::strtod(records[i + 1].fields[column].c_str(), nullptr);
        };
        EXPECT_EQ(number(0), s.surface.receivers[i].point.x);
        EXPECT_EQ(number(6), p.total.mean);
        EXPECT_EQ(number(7), p.total.standard_error);
        EXPECT_EQ(number(8), interval.lower);
        EXPECT_EQ(number(9), interval.upper);
        EXPECT_EQ(number(10), p.direct.mean);
        EXPECT_EQ(number(11), p.indirect.mean);
    }
}

TEST(SurfaceCsv, EndsRowsAsTheStandardSays) {
    const std::string csv = to_csv(test::make_results().surfaces[0], 0.95);
    EXPECT_TRUE(csv.ends_with("\r\n"));
    for (std::size_t i = 0; i < csv.size(); ++i)
        if (csv[i] == '\n') {
            EXPECT_EQ(csv[i - 1], '\r');
        }
}

TEST(SummaryCsv, HasFiveRowsASurfaceAndSurvivesOddNames) {
    const Results results = test::make_results();
    const auto records = parse_csv(to_summary_csv(results), "summary.csv");
    ASSERT_EQ(records.size(), 11U);
    EXPECT_THAT(records[0].fields,
                ElementsAre("surface",
                            "quantity",
                            "unit",
                            "value",
                            "standard_error",
                            "lower",
                            "upper",
                            "replicates"));
    EXPECT_EQ(records[4].fields[0], "office/work \"plane\", 1");
    EXPECT_EQ(records[4].fields[1], "U0");
    EXPECT_EQ(records[4].fields[2], "1");
    EXPECT_EQ(records[4].fields[3], to_shortest(results.surfaces[0].summary.uniformity.mean));
    EXPECT_EQ(records[6].fields[0], "faces 机房");
}

TEST(CsvParser, TakesQuotesCommasAndLineBreaksInFields) {
    const auto records =
        parse_csv("a,\"b \"\"c\"\", d\",\r\n\n\"two\nlines\",x\nlast", "f.csv");
    ASSERT_EQ(records.size(), 3U);
    EXPECT_THAT(records[0].fields, ElementsAre("a", "b \"c\", d", ""));
    EXPECT_THAT(records[1].fields, ElementsAre("two\nlines", "x"));
    EXPECT_THAT(records[2].fields, ElementsAre("last"));
    EXPECT_EQ(records[1].line, 3);
    EXPECT_EQ(records[2].line, 5);
}

std::string message_of(std::string_view text) {
    try {
        static_cast<void>(parse_csv(text, "f.csv"));
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(CsvParser, NamesTheLineOfABrokenQuote) {
    EXPECT_EQ(message_of("a,b\n\"c,d\ne"),
              "f.csv:2: a quote is opened here and never closed. Truncated file?");
    EXPECT_EQ(message_of("a\n\"b\"c,d"),
              "f.csv:2: text after a closing quote. Double the quotes inside?");
}

TEST(SensitivitiesCsv, HasTheMeanAndThePointsOfEverySurfaceAndMaterial) {
    Results r;
    r.surfaces.resize(2);
    for (std::size_t s = 0; s < 2; ++s) {
        r.surfaces[s].surface.name = s == 0 ? "desk" : "wall, left";
        r.surfaces[s].points.resize(2 - s);
        r.surfaces[s].surface.receivers.resize(2 - s);
    }
    r.surfaces[0].surface.receivers[1].point = {1, 2.5, 0.75};
    // Two materials, two replicates, three points.
    r.sensitivities = Sensitivities{{{"oak", 0.25, {}}, {"white", 0.8, {}}},
                                    2,
                                    3,
                                    {1, 2, 3, 3, 4, 5, 10, 20, 30, 10, 20, 30}};
    EXPECT_EQ(
        to_sensitivities_csv(r),
        "surface,point,x_m,y_m,z_m,material,reflectance,derivative_lx,standard_error_lx\r\n"
        "desk,mean,,,,oak,0.25,2.5,1\r\n"
        "desk,1,0,0,0,oak,0.25,2,1\r\n"
        "desk,2,1,2.5,0.75,oak,0.25,3,1\r\n"
        "desk,mean,,,,white,0.8,15,0\r\n"
        "desk,1,0,0,0,white,0.8,10,0\r\n"
        "desk,2,1,2.5,0.75,white,0.8,20,0\r\n"
        "\"wall, left\",mean,,,,oak,0.25,4,1\r\n"
        "\"wall, left\",1,0,0,0,oak,0.25,4,1\r\n"
        "\"wall, left\",mean,,,,white,0.8,30,0\r\n"
        "\"wall, left\",1,0,0,0,white,0.8,30,0\r\n");
}

} // namespace
} // namespace isolux
