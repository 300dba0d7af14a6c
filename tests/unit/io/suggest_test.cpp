#include <vector>

#include <gtest/gtest.h>

#include "isolux/io/suggest.h"

namespace isolux {
namespace {

TEST(EditDistance, CountsSlipsOfTheFingers) {
    EXPECT_EQ(edit_distance("height", "height"), 0U);
    EXPECT_EQ(edit_distance("height", "Height"), 0U);
    EXPECT_EQ(edit_distance("hieght", "height"), 1U); // neighbours swapped
    EXPECT_EQ(edit_distance("heigt", "height"), 1U);
    EXPECT_EQ(edit_distance("heiight", "height"), 1U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
}

TEST(FindNearest, GivesTheNearestIfItIsNear) {
    const std::vector<std::string> names{"panel", "downlight", "spot"};

    EXPECT_EQ(find_nearest("pannel", names), "panel");
    EXPECT_EQ(find_nearest("donwlihgt", names), "downlight");
    EXPECT_EQ(find_nearest("batten", names), std::nullopt);
    EXPECT_EQ(find_nearest("", names), std::nullopt);
    EXPECT_EQ(find_nearest(std::string(100'000, 'x'), names), std::nullopt);
}

TEST(FindNearest, NeverOffersAnAltogetherDifferentLetter) {
    const std::vector<std::string> names{"b"};

    EXPECT_EQ(find_nearest("a", names), std::nullopt);
}

TEST(DidYouMean, AsksOrSaysNothing) {
    const std::vector<std::string> names{"oak"};

    EXPECT_EQ(did_you_mean("oack", names), "Did you mean \"oak\"?");
    EXPECT_EQ(did_you_mean("steel", names), "");
}

} // namespace
} // namespace isolux
