#include <gtest/gtest.h>

#include "isolux/calc/selftest.h"

/// The cases of `isolux selftest` with another seed than its default.
namespace isolux {
namespace {

constexpr std::uint64_t seed = 20261122;

class Selftest : public testing::TestWithParam<std::size_t> {};

TEST_P(Selftest, AgreesWithItsKnownAnswers) {
    const SelftestCase selftest = make_selftest_cases()[GetParam()];
    const Results results = calculate(selftest, seed + GetParam());
    for (const KnownAnswer& answer : selftest.answers) {
        const SelftestRow row = judge(selftest, answer, answer.computed(results), 500);
        EXPECT_TRUE(row.passed) << row.name << ", " << row.quantity << ": " << row.computed.mean
                                << " +- " << row.computed.standard_error << ", reference "
                                << row.reference << ", z " << row.z;
    }
}

INSTANTIATE_TEST_SUITE_P(Cases,
                         Selftest,
                         testing::Range<std::size_t>(0, make_selftest_cases().size()),
                         [](const testing::TestParamInfo<std::size_t>& chosen) {
                             std::string name = make_selftest_cases()[chosen.param].name;
                             for (char& c : name)
                                 c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                             return name;
                         });

} // namespace
} // namespace isolux
