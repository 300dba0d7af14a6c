#include <gtest/gtest.h>

#include "isolux/cli/text_table.h"

namespace isolux {
namespace {

TEST(TextTable, AlignsColumnsToTheirWidestCell) {
    TextTable table({{"surface", Align::left}, {"Em", Align::right}});
    table.add_row({"desk", "512"});
    table.add_row({"work plane", "1024.5"});
    EXPECT_EQ(table.text(),
              "surface         Em\n"
              "----------  ------\n"
              "desk           512\n"
              "work plane  1024.5\n");
}

TEST(TextTable, LeavesNoBlanksAtTheEndOfALine) {
    TextTable table({{"a", Align::left}, {"b", Align::left}});
    table.add_row({"1", ""});
    table.add_row({"", "long"});
    EXPECT_EQ(table.text(),
              "a  b\n"
              "-  ----\n"
              "1\n"
              "   long\n");
}

TEST(TextTable, CountsCharactersNotBytes) {
    TextTable table({{"name", Align::left}, {"x", Align::right}});
    table.add_row({"Büro", "1"});
    table.add_row({"abcd", "2"});
    EXPECT_EQ(table.text(),
              "name  x\n"
              "----  -\n"
              "Büro  1\n"
              "abcd  2\n");
}

} // namespace
} // namespace isolux
