#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/io/file_name.h"

namespace isolux {
namespace {

using testing::ElementsAre;

TEST(FileStem, IsTheNameItselfWhereThatIsPossible) {
    EXPECT_EQ(file_stem("work plane"), "work plane");
    EXPECT_EQ(file_stem("Büro 3 – 机房 Ωμέγα"), "Büro 3 – 机房 Ωμέγα");
    EXPECT_EQ(file_stem("v1.2_final-b"), "v1.2_final-b");
}

TEST(FileStem, ReplacesWhatAFileSystemOrAShellWouldTakeForSomethingElse) {
    EXPECT_EQ(file_stem("office/work plane"), "office_work plane");
    EXPECT_EQ(file_stem("../../etc/passwd"), "_.._etc_passwd");
    EXPECT_EQ(file_stem("C:\\a*b?\"<|>"), "C__a_b_____");
    EXPECT_EQ(file_stem(std::string("a\nb\0c\x7F", 6)), "a_b_c_");
}

TEST(FileStem, IsNeverHiddenEmptyOrOpenEnded) {
    EXPECT_EQ(file_stem(""), "_");
    EXPECT_EQ(file_stem("."), "_");
    EXPECT_EQ(file_stem(".."), "_");
    EXPECT_EQ(file_stem(" .hidden. "), "hidden");
}

TEST(FileStem, ReplacesBytesThatAreNotUtf8) {
    EXPECT_EQ(file_stem("B\xFCro"), "B_ro");          // Latin-1
    EXPECT_EQ(file_stem("\xC0\xAF"), "__");           // overlong slash
    EXPECT_EQ(file_stem("\xE0\x80\xAF"), "___");      // overlong slash, three bytes
    EXPECT_EQ(file_stem("\xED\xA0\x80"), "___");      // surrogate
    EXPECT_EQ(file_stem("\xF4\x90\x80\x80"), "____"); // beyond Unicode
    EXPECT_EQ(file_stem("cut \xE6\x9C"), "cut __");   // truncated
    EXPECT_EQ(file_stem("\xF0\x9F\x92\xA1 ok"), "\xF0\x9F\x92\xA1 ok");
}

TEST(FileStem, CutsLongNamesBetweenCharacters) {
    std::string name("a");
    for (int i = 0; i < 100; ++i)
        name += "机"; // three bytes
    EXPECT_EQ(file_stem(name), name.substr(0, 118));
    EXPECT_EQ(file_stem(std::string(300, 'x')).size(), 120U);
}

TEST(FileStems, AreAllDifferent) {
    const std::vector<std::string> names{
        "desk", "desk", "Desk", "desk-2", "a/b", "a\\b", "", "."};
    EXPECT_THAT(
        file_stems(names),
        ElementsAre("desk", "desk-2", "Desk-3", "desk-2-2", "a_b", "a_b-2", "_", "_-2"));
}

} // namespace
} // namespace isolux
