#include <array>

#include <gtest/gtest.h>

#include "isolux/cli/suggest.h"

namespace isolux {
namespace {

const std::array<std::string, 6> verbs{
    "run", "sense", "check", "selftest", "reference", "schema"};

TEST(FindSimilar, ForgivesOneSlipInAShortWord) {
    EXPECT_EQ(find_similar("rum", verbs), "run");
    EXPECT_EQ(find_similar("urn", verbs), "run");
    EXPECT_EQ(find_similar("chekc", verbs), "check");
    EXPECT_EQ(find_similar("schemas", verbs), "schema");
}

TEST(FindSimilar, ForgivesMoreInALongWord) {
    EXPECT_EQ(find_similar("refrence", verbs), "reference");
    EXPECT_EQ(find_similar("self-tests", verbs), "selftest");
}

TEST(FindSimilar, CompletesABeginningOfOneWord) {
    EXPECT_EQ(find_similar("ref", verbs), "reference");
    EXPECT_EQ(find_similar("se", verbs), std::nullopt); // sense, selftest
}

TEST(FindSimilar, SaysNothingAboutStrangers) {
    EXPECT_EQ(find_similar("", verbs), std::nullopt);
    EXPECT_EQ(find_similar("office.json", verbs), std::nullopt);
    EXPECT_EQ(find_similar("calculate", verbs), std::nullopt);
}

} // namespace
} // namespace isolux
