#include <vector>

#include <gtest/gtest.h>

#include "isolux/measure/replicate_flags.h"

#include "support/normal_draws.h"

namespace isolux {
namespace {

/// 16 values: `outliers` of them at 1, the others at 0.
std::vector<double> spikes(int outliers) {
    std::vector<double> y(16, 0.0);
    for (int i = 0; i < outliers; ++i)
        y[static_cast<std::size_t>(i)] = 1.0;
    return y;
}

TEST(ReplicateFlags, RaiseBothForOneLoneReplicate) {
    // One of 16: deviation 3.75 s, kurtosis 14.07 - the largest values possible.
    const ReplicateFlags f = flag_replicates(spikes(1));
    EXPECT_TRUE(f.suspicious_replicate);
    EXPECT_TRUE(f.heavy_tail);
}

TEST(ReplicateFlags, TwoLoneReplicatesAreAHeavyTailOnly) {
    // Two of 16: p = 1/8, kurtosis (1 - 3 p (1-p)) / (p (1-p)) = 6.14, deviation 2.56 s.
    const ReplicateFlags f = flag_replicates(spikes(2));
    EXPECT_FALSE(f.suspicious_replicate);
    EXPECT_TRUE(f.heavy_tail);
}

TEST(ReplicateFlags, ThreeLoneReplicatesAreNeither) {
    // p = 3/16: kurtosis 3.56.
    const ReplicateFlags f = flag_replicates(spikes(3));
    EXPECT_FALSE(f.suspicious_replicate);
    EXPECT_FALSE(f.heavy_tail);
}

TEST(ReplicateFlags, StayDownForDeterministicAndFewValues) {
    EXPECT_FALSE(flag_replicates(std::vector<double>(16, 0.1)).heavy_tail);
    std::vector<double> rounded(16, 0.1);
    rounded[3] = 0.1 * (1.0 + 3e-16);
    EXPECT_FALSE(flag_replicates(rounded).heavy_tail);
    EXPECT_FALSE(flag_replicates(rounded).suspicious_replicate);
    EXPECT_FALSE(flag_replicates({}).heavy_tail);
    EXPECT_FALSE(flag_replicates(std::vector<double>{0, 0, 1}).suspicious_replicate);
}

TEST(ReplicateFlags, RarelyRiseForNormalReplicates) {
    // By simulation of 150 000 sets of 16: kurtosis above 6 in 0.40 %, deviation above 3.5 s in
    // none. 2000 sets: 8 expected, 28 would be seven standard deviations more.
    test::NormalDraws normal(11);
    int heavy = 0;
    int suspicious = 0;
    for (int i = 0; i < 2000; ++i) {
        std::vector<double> y;
        for (int r = 0; r < 16; ++r)
            y.push_back(100.0 + normal());
        heavy += flag_replicates(y).heavy_tail ? 1 : 0;
        suspicious += flag_replicates(y).suspicious_replicate ? 1 : 0;
    }
    EXPECT_LE(heavy, 28);
    EXPECT_LE(suspicious, 1);
}

} // namespace
} // namespace isolux
