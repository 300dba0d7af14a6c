#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "isolux/io/exr.h"

#include "cli/program.h"

namespace isolux::test {
namespace {

using testing::HasSubstr;

constexpr std::size_t side = 16;

class CompareVerb : public testing::Test {
protected:
    TemporaryFolder folder_;

    /// A grey picture whose luminance is a function of the pixel's number.
    [[nodiscard]] std::string write(const std::string& name,
                                    const std::function<double(std::size_t)>& luminance,
                                    PictureSize size = {side, side}) const {
        const std::size_t n = size.pixels();
        ViewPicture p;
        p.view = name;
        p.size = size;
        p.raw.assign(n, 0.0F);
        for (std::size_t i = 0; i < n; ++i)
            p.raw.set(i, Rgb::grey(luminance(i) / luminance_sum(Rgb::grey(1.0))));
        for (Planes3* q :
             {&p.emission, &p.direct, &p.indirect, &p.albedo, &p.normal, &p.position})
            q->assign(n, 0.0F);
        for (Plane* q : {&p.standard_error, &p.depth, &p.illuminance, &p.samples})
            q->assign(n, 1.0F);
        p.object.assign(n, 1);
        p.object_names = {"wall"};
        const std::string path = folder_.path(name + ".exr");
        write_exr(path, p);
        return path;
    }
};

double ramp(std::size_t i) { return 10.0 + static_cast<double>(i % side); }

TEST_F(CompareVerb, SaysNothingDiffersBetweenEqualPictures) {
    const std::string a = write("a", ramp);
    const Ran ran = run_program({"compare", a, a, "--json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const auto j = nlohmann::json::parse(ran.out);
    EXPECT_EQ(j["mse"], 0.0);
    EXPECT_EQ(j["relative_mse"], 0.0);
    EXPECT_TRUE(j["psnr_db"].is_null());
    for (const char* name : {"ssim_g11", "ssim_u7", "log_luminance_ssim_g11"})
        EXPECT_NEAR(j[name].get<double>(), 1.0, 1e-6) << name;
}

TEST_F(CompareVerb, MeasuresAKnownDifference) {
    const std::string a = write("a", [](std::size_t i) { return ramp(i) + 0.5; });
    const std::string b = write("b", ramp);
    const Ran ran = run_program({"compare", a, b, "--json", "--layer", "raw"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const auto j = nlohmann::json::parse(ran.out);
    double relative = 0.0; // METHODS eq. (102); the mean is 17.5
    double encoded = 0.0;  // (104); the median is 17.5
    for (std::size_t i = 0; i < side; ++i) {
        const double y = ramp(i);
        relative += 0.25 / (y * y + 1.75 * 1.75) / side;
        const auto v = [](double l) { return std::pow(l / 70.0, 1.0 / 2.2); };
        encoded += std::pow(v(y + 0.5) - v(y), 2) / side;
    }
    EXPECT_NEAR(j["mse"].get<double>(), 0.25, 1e-5);
    EXPECT_NEAR(j["relative_mse"].get<double>() / relative, 1.0, 1e-4);
    EXPECT_NEAR(j["psnr_db"].get<double>(), -10.0 * std::log10(encoded), 1e-2);
    EXPECT_LT(j["ssim_g11"].get<double>(), 1.0);
    EXPECT_GT(j["ssim_g11"].get<double>(), 0.99);
}

TEST_F(CompareVerb, PrintsATable) {
    const std::string a = write("a", [](std::size_t i) { return 1.1 * ramp(i); });
    const Ran ran = run_program({"compare", a, write("b", ramp)});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    for (const char* word : {"MSE", "relMSE", "PSNR", "ssim-g11", "ssim-u7", "log luminance"})
        EXPECT_THAT(ran.out, HasSubstr(word));
}

TEST_F(CompareVerb, LeavesTheNoiseOfAReferenceInTwoHalvesOut) {
    const auto noise = [](std::size_t i) { return i % 2 == 0 ? 0.1 : -0.1; };
    const std::string a = write("a", [](std::size_t i) { return ramp(i) + 1.0; });
    const std::string b1 = write("b1", [&](std::size_t i) { return ramp(i) + noise(i); });
    const std::string b2 = write("b2", [&](std::size_t i) { return ramp(i) + noise(i / 2); });
    const Ran ran = run_program({"compare", a, b1, "--second-half", b2, "--json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NEAR(nlohmann::json::parse(ran.out)["mse"].get<double>(), 1.0, 1e-4);
}

TEST_F(CompareVerb, NamesWhatIsWrong) {
    const std::string a = write("a", ramp);
    const std::string small = write("small", ramp, {side, 12});
    const auto complaint = [](const std::vector<std::string>& arguments) {
        const Ran ran = run_program(arguments);
        EXPECT_EQ(ran.exit_code, 2);
        EXPECT_EQ(ran.out, "");
        return ran.err;
    };
    EXPECT_THAT(complaint({"compare", a, folder_.path("none.exr")}), HasSubstr("none.exr"));
    EXPECT_THAT(complaint({"compare", a, folder_.write("text.exr", "no picture")}),
                HasSubstr("not a readable OpenEXR picture"));
    EXPECT_EQ(complaint({"compare", a, small}),
              "error: " + a + ": 16 x 16 pixels, but " + small
                  + " has 16 x 12 (pixels cannot be paired). Render both views at one "
                    "resolution\n");
    EXPECT_THAT(complaint({"compare", a, a, "--layer", "rav"}),
                HasSubstr("no layer 'rav' with luminance. Its channels are B, G, R, Z"));
    // The halves differ by far more than the test picture from their mean.
    const std::string b1 = write("b1", [](std::size_t i) { return ramp(i) + 5.0; });
    const std::string b2 = write("b2", [](std::size_t i) { return ramp(i) - 4.9; });
    EXPECT_THAT(complaint({"compare", a, b1, "--second-half", b2}),
                HasSubstr("its own noise may change the squared error"));
}

} // namespace
} // namespace isolux::test
