#include <numbers>

#include <gtest/gtest.h>

#include "isolux/calc/selftest.h"
#include "isolux/calc/selftest_scenes.h"

namespace isolux {
namespace {

SelftestRow judged(const Estimate& computed, double reference, double allowance = 0.0) {
    const KnownAnswer answer{"somewhere", "lx", reference, {}, allowance};
    return judge(SelftestCase{"case", {}, {}, {}, {}}, answer, computed, 100);
}

TEST(Judge, HoldsExactAnswersToASixthDigit) {
    EXPECT_TRUE(judged({100.00005, 0.0, 16}, 100.0).passed);
    EXPECT_FALSE(judged({100.0002, 0.0, 16}, 100.0).passed);
    EXPECT_TRUE(judged({100.00005, 1e-12, 16}, 100.0).passed); // rounding is no doubt
    EXPECT_TRUE(judged({0.0, 0.0, 16}, 0.0).passed);
    EXPECT_FALSE(judged({1e-3, 0.0, 16}, 0.0).passed);
}

TEST(Judge, ComparesDeviationsWithStandardErrors) {
    const SelftestRow row = judged({102.0, 0.4, 16}, 100.0);
    EXPECT_DOUBLE_EQ(row.z, 5.0);
    // Student, 15 degrees of freedom, two-sided 1e-6/100.
    EXPECT_NEAR(row.z_limit, 11.2818, 1e-3);
    EXPECT_TRUE(row.passed);
    EXPECT_FALSE(judged({105.0, 0.4, 16}, 100.0).passed);
    EXPECT_FALSE(judged({95.0, 0.4, 16}, 100.0).passed);
}

TEST(Judge, FailsAnAnswerTooBluntToShowAnything) {
    EXPECT_TRUE(judged({100.0, 0.49, 16}, 100.0).passed);
    EXPECT_FALSE(judged({100.0, 0.51, 16}, 100.0).passed);
}

TEST(Judge, GrantsTheCaseItsAllowance) {
    EXPECT_DOUBLE_EQ(judged({101.0, 0.1, 16}, 100.0, 0.01).z, 0.0);
    EXPECT_DOUBLE_EQ(judged({98.5, 0.1, 16}, 100.0, 0.01).z, -5.0);
}

TEST(SelftestCases, AreComplete) {
    for (const SelftestCase& selftest : make_selftest_cases()) {
        EXPECT_FALSE(selftest.name.empty());
        EXPECT_FALSE(selftest.answers.empty()) << selftest.name;
        EXPECT_FALSE(selftest.surfaces.empty()) << selftest.name;
        EXPECT_FALSE(selftest.scene().luminaires.empty()) << selftest.name;
    }
}

TEST(SphereMesh, IsRoundAndFacesInwards) {
    const SphereMesh sphere = make_sphere(2.0, 3, MaterialId(0));
    EXPECT_EQ(sphere.centres.size(), 20u * 64u);
    const double exact = 16.0 * std::numbers::pi;
    EXPECT_LT(sphere.area, exact);
    EXPECT_GT(sphere.area, 0.99 * exact);
    for (std::size_t i = 0; i < sphere.centres.size(); ++i)
        EXPECT_LT(dot(sphere.normals[i], sphere.centres[i] - Point3{}), 0.0);
    // Closed and free of odd faces; that it faces inwards is meant.
    for (const MeshFinding& finding : sphere.object.mesh.inspect())
        EXPECT_EQ(finding.kind, MeshFinding::Kind::inside_out) << finding.text;
}

} // namespace
} // namespace isolux
