#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/io/json_lines.h"

namespace isolux::test {
namespace {

using testing::ElementsAre;

std::size_t line_of(const std::string& text, const std::string& pointer) {
    return find_lines(text, std::vector<std::string>{pointer}).at(0);
}

const std::string sample = "// a project\n"          // 1
                           "{ \"isolux\": 1,\n"      // 2
                           "  \"rooms\": [\n"        // 3
                           "    {\"size\": [6,\n"    // 4
                           "              4],\n"     // 5
                           "     \"height\":\n"      // 6
                           "        3},\n"           // 7
                           "    {}, /* , ]\n"        // 8
                           "    */ {\"a\": 2.5e3,\n" // 9
                           "\t\"b\": true}\n"        // 10
                           "  ],\r\n"                // 11
                           "  \"z\": null }\n";      // 12

TEST(JsonLines, AreThoseOfKeysAndOfElements) {
    const std::vector<std::string> pointers{"",
                                            "/isolux",
                                            "/rooms",
                                            "/rooms/0",
                                            "/rooms/0/size/0",
                                            "/rooms/0/size/1",
                                            "/rooms/0/height",
                                            "/rooms/1",
                                            "/rooms/2",
                                            "/rooms/2/b",
                                            "/z"};

    EXPECT_THAT(find_lines(sample, pointers), ElementsAre(2, 2, 3, 4, 4, 5, 6, 8, 9, 10, 12));
}

TEST(JsonLines, OfWhatIsNotThereAreThoseOfWhatHoldsIt) {
    EXPECT_EQ(line_of(sample, "/views"), 2U);
    EXPECT_EQ(line_of(sample, "/rooms/0/name"), 4U);
    EXPECT_EQ(line_of(sample, "/rooms/2/grid/rows"), 9U);
    EXPECT_EQ(line_of(sample, "/rooms/7"), 3U);
    EXPECT_EQ(line_of(sample, "/rooms/0/height/metres"), 6U);
}

TEST(JsonLines, AreNotMisledByAByteOrderMark) {
    EXPECT_EQ(line_of("\xEF\xBB\xBF" + sample, "/rooms/0/height"),
              line_of(sample, "/rooms/0/height"));
}

TEST(JsonLines, AreNotMisledByTexts) {
    const std::string text = "[\"a \\\" , ] \\\\\",\n"
                             " \"// no comment\", \"/*\",\n"
                             " {\"}\": \"{\"},\n"
                             " 4]";

    EXPECT_EQ(line_of(text, "/1"), 2U);
    EXPECT_EQ(line_of(text, "/2"), 2U);
    EXPECT_EQ(line_of(text, "/3/}"), 3U);
    EXPECT_EQ(line_of(text, "/4"), 4U);
}

TEST(JsonLines, FindKeysWithEscapes) {
    const std::string text = "{\"a/b~c\": 1,\n\"\\u00e4\\u20ac\": 2,\n\"\xc3\xb6\": 3,\n"
                             "\"\\ud83d\\ude00\": 4,\n\"x\\ty\\\"\": 5}";

    EXPECT_EQ(line_of(text, "/a~1b~0c"), 1U);
    EXPECT_EQ(line_of(text, "/\xc3\xa4\xe2\x82\xac"), 2U);
    EXPECT_EQ(line_of(text, "/\xc3\xb6"), 3U);
    EXPECT_EQ(line_of(text, "/\xf0\x9f\x98\x80"), 4U);
    EXPECT_EQ(line_of(text, "/x y\""), 5U);
}

TEST(JsonLines, OfARepeatedKeyAreThoseOfTheSecond) {
    EXPECT_EQ(line_of("{\"a\": {\"b\": 1},\n\"a\": 2}", "/a"), 2U);
    EXPECT_EQ(line_of("{\"a\": {\"b\": 1},\n\"a\": 2}", "/a/b"), 1U);
}

TEST(JsonLines, SurviveWhatIsNoJson) {
    for (const char* text : {"",
                             "{",
                             "[",
                             "{\"a",
                             "{\"a\"",
                             "{\"a\":",
                             "[1,",
                             "\"\\",
                             "\"\\u12",
                             "/*",
                             "//",
                             "}]",
                             "{1}",
                             "[,,]",
                             "{\"a\":}",
                             "[\"\\ud800\\u"})
        EXPECT_EQ(line_of(text, "/a/0"), 1U) << text;
}

TEST(JsonLines, GoBeforeThePointer) {
    std::vector<Message> messages{{"a.json#/rooms/1", "empty", ""},
                                  {"a.json#", "odd", ""},
                                  {"b.json#/rooms", "another file", ""},
                                  {"a.json", "no pointer", ""}};

    add_lines(messages, "a.json", sample);

    EXPECT_EQ(to_string(messages[0]), "a.json:8: #/rooms/1: empty");
    EXPECT_EQ(to_string(messages[1]), "a.json:2: odd");
    EXPECT_EQ(to_string(messages[2]), "b.json#/rooms: another file");
    EXPECT_EQ(to_string(messages[3]), "a.json: no pointer");
}

} // namespace
} // namespace isolux::test
