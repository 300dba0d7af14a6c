#include <string>

#include <gtest/gtest.h>

#include "isolux/io/points_file.h"

namespace isolux {
namespace {

std::string error_of(std::string_view text) {
    try {
        static_cast<void>(parse_points(text, "a.pts"));
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(PointsFile, TakesBlanksTabsCommasAndComments) {
    const auto points =
        parse_points("\xEF\xBB\xBF# x y z\n1 2 3\n\n-1.5e0,\t2;3 0 0 -2 # down\r\n"
                     "+1 2 3",
                     "a.pts");

    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[0].point, (Point3{1, 2, 3}));
    EXPECT_EQ(points[0].normal.z(), 1.0);
    EXPECT_EQ(points[1].point, (Point3{-1.5, 2, 3}));
    EXPECT_EQ(points[1].normal.z(), -1.0);
    EXPECT_EQ(points[2].point.x, 1.0);
}

TEST(PointsFile, NamesEveryWrongLine) {
    EXPECT_EQ(error_of("1 2 3\n1 2\n1 2 3 0 0 0\n1 2 1e9\n1 2 3mm\n1 2 nan\n7"),
              "a.pts:2: 2 numbers (a point is x y z or x y z nx ny nz)\n"
              "a.pts:3: the normal has no length (which way does the point face?)\n"
              "a.pts:4: 1000000000 m is too far away (at most 1000 km)\n"
              "a.pts:5: \"3mm\" is not a number (a point is x y z or x y z nx ny nz)\n"
              "a.pts:6: \"nan\" is not a number (a point is x y z or x y z nx ny nz)\n"
              "a.pts:7: 1 number (a point is x y z or x y z nx ny nz)");
}

TEST(PointsFile, WithoutAPointIsAnError) {
    EXPECT_EQ(error_of("# nothing\n\n"), "a.pts: no point in the file (nothing to measure)");
    EXPECT_EQ(error_of(""), "a.pts: no point in the file (nothing to measure)");
}

TEST(PointsFile, StopsAfterAHundredMessages) {
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += "x\n";
    try {
        static_cast<void>(parse_points(text, "a.pts"));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.messages().size(), 100U);
    }
}

} // namespace
} // namespace isolux
