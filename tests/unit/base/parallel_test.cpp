#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/parallel.h"

namespace isolux {
namespace {

TEST(ForEachIndex, VisitsEveryIndexOnce) {
    for (const std::size_t count : {0, 1, 7, 64, 1000}) {
        std::vector<int> visits(count, 0);
        for_each_index(count, 16, [&](std::size_t i) { ++visits[i]; });
        EXPECT_EQ(std::ranges::count(visits, 1), static_cast<std::ptrdiff_t>(count));
    }
}

TEST(ForEachRange, SplitsByGrainAlone) {
    for (const std::size_t threads : {1, 2, 5}) {
        const ThreadLimit limit(threads);
        std::vector<std::size_t> end_of(25, 0);
        for_each_range(
            25, 10, [&](std::size_t begin, std::size_t end) { end_of[begin] = end; });
        EXPECT_EQ(end_of[0], 10U);
        EXPECT_EQ(end_of[10], 20U);
        EXPECT_EQ(end_of[20], 25U);
        EXPECT_EQ(std::ranges::count(end_of, 0U), 22);
    }
}

TEST(ForEachIndex, TakesAGrainOfZeroAndPassesErrorsOn) {
    std::atomic<int> visits = 0;
    for_each_index(5, 0, [&](std::size_t) { ++visits; });
    EXPECT_EQ(visits, 5);
    EXPECT_THROW(for_each_index(100,
                                1,
                                [](std::size_t i) {
                                    if (i == 42)
                                        throw std::runtime_error("42");
                                }),
                 std::runtime_error);
}

} // namespace
} // namespace isolux
