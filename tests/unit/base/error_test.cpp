#include <string>

#include <gtest/gtest.h>

#include "isolux/base/error.h"

namespace isolux {
namespace {

TEST(Message, ReadsPlaceThenProblemThenSuggestion) {
    EXPECT_EQ(to_string({"a.json#/rooms/0", "no height (a room needs one)", "Add \"height\"?"}),
              "a.json#/rooms/0: no height (a room needs one). Add \"height\"?");
    EXPECT_EQ(to_string({"a.json", "empty", ""}), "a.json: empty");
    EXPECT_EQ(to_string({"", "slow", ""}), "slow");
}

TEST(InputErrorText, HasOneLineAProblem) {
    const InputError error({{"a", "first", "One?"}, {"b", "second", ""}});
    EXPECT_STREQ(error.what(), "a: first. One?\nb: second");
    ASSERT_EQ(error.messages().size(), 2U);
    EXPECT_EQ(error.messages()[1].where, "b");
    EXPECT_STREQ(InputError("a", "b").what(), "a: b");
}

} // namespace
} // namespace isolux
