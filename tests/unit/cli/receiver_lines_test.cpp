#include <sstream>

#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/cli/receiver_lines.h"

namespace isolux {
namespace {

std::string message_for(const std::string& text) {
    std::istringstream in(text);
    try {
        (void)ReceiverLines(in, "stdin").read(1000);
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

TEST(ParseReceiver, ReadsSixNumbers) {
    const auto receiver = parse_receiver("1 2 0.75 0 0 1", "stdin:1");
    ASSERT_TRUE(receiver.has_value());
    EXPECT_EQ(receiver->point, (Point3{1, 2, 0.75}));
    EXPECT_EQ(receiver->axis, UnitVector3({0, 0, 1}));
    EXPECT_EQ(receiver->kind, IlluminanceKind::planar);
}

TEST(ParseReceiver, TakesTabsCommasAndSemicolons) {
    for (const char* text :
         {"1\t2\t3\t0\t0\t1", "1,2,3,0,0,1", "1; 2; 3; 0; 0; 1\r", "  1 , 2 3 0 0 1 # desk"}) {
        const auto receiver = parse_receiver(text, "stdin:1");
        ASSERT_TRUE(receiver.has_value()) << text;
        EXPECT_EQ(receiver->point, (Point3{1, 2, 3})) << text;
    }
}

TEST(ParseReceiver, NormalisesTheNormalWhateverItsLength) {
    for (const char* text : {"0 0 0 0 3 4", "0 0 0 0 3e-200 4e-200", "0 0 0 0 3e300 4e300"}) {
        const auto receiver = parse_receiver(text, "stdin:1");
        ASSERT_TRUE(receiver.has_value()) << text;
        EXPECT_DOUBLE_EQ(receiver->axis.y(), 0.6) << text;
        EXPECT_DOUBLE_EQ(receiver->axis.z(), 0.8) << text;
    }
}

TEST(ParseReceiver, SkipsEmptyLinesAndComments) {
    for (const char* text : {"", "   \t", "# x y z nx ny nz", "\r"})
        EXPECT_FALSE(parse_receiver(text, "stdin:1").has_value()) << text;
}

TEST(ReceiverLines, ReadsBatchByBatch) {
    std::istringstream in("0 0 0 0 0 1\n1 0 0 0 0 1\n\n# two done\n2 0 0 0 0 1");
    ReceiverLines lines(in, "stdin");
    EXPECT_EQ(lines.read(2).size(), 2u);
    const auto last = lines.read(2);
    ASSERT_EQ(last.size(), 1u);
    EXPECT_EQ(last[0].point.x, 2.0);
    EXPECT_TRUE(lines.read(2).empty());
}

TEST(ReceiverLines, NamesTheLineThatIsWrong) {
    EXPECT_EQ(message_for("0 0 0 0 0 1\n1 2 3 0 0\n"),
              "stdin:2: 5 numbers in place of 6. A line is x y z nx ny nz, in metres");
    EXPECT_EQ(message_for("1 2 3 0 0 1 7\n"),
              "stdin:1: 7 numbers in place of 6. A line is x y z nx ny nz, in metres");
    EXPECT_EQ(message_for("\n# points\n1 2 x 0 0 1\n"),
              "stdin:3: 'x' is not a number. A line is x y z nx ny nz, in metres");
    EXPECT_EQ(message_for("1 2 inf 0 0 1\n"),
              "stdin:1: 'inf' is not a number. A line is x y z nx ny nz, in metres");
    EXPECT_EQ(message_for("1 2 3 0 0 0\n"),
              "stdin:1: the normal is zero (it has no direction). 0 0 1 faces upwards");
}

TEST(ReceiverLines, NamesEveryLineUpToTen) {
    EXPECT_EQ(message_for("a\n0 0 0 0 0 1\nb\n"),
              "stdin:1: 'a' is not a number. A line is x y z nx ny nz, in metres\n"
              "stdin:3: 'b' is not a number. A line is x y z nx ny nz, in metres");
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += "nonsense\n";
    std::istringstream in(text);
    try {
        (void)ReceiverLines(in, "stdin").read(1000);
        FAIL() << "no error";
    } catch (const InputError& e) {
        EXPECT_EQ(e.messages().size(), 10u);
    }
}

TEST(ReceiverLines, DoesNotSwallowEndlessLines) {
    std::string lines(1000000, '1');
    lines += "\n0 0 0 0 0 1\n";
    EXPECT_EQ(message_for(lines),
              "stdin:1: more than 4096 characters. A line is x y z nx ny nz, in metres");
}

} // namespace
} // namespace isolux
