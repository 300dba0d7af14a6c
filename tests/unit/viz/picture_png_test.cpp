#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "isolux/viz/picture_png.h"

namespace isolux::test {
namespace {

namespace fs = std::filesystem;

ViewPicture grey_ramp() {
    ViewPicture p;
    p.view = "ramp";
    p.size = {64, 48};
    const std::size_t n = p.size.pixels();
    p.raw.assign(n, 0.0F);
    p.emission.assign(n, 0.0F);
    p.normal.assign(n, 0.0F);
    p.object.assign(n, 1);
    p.illuminance.assign(n, 0.0F);
    for (std::size_t i = 0; i < n; ++i) {
        const double y = 5.0 + static_cast<double>(i % 64);
        p.raw.set(i, Rgb::grey(y));
        p.normal.set(i, Vector3{0, 0, 1});
        p.illuminance[i] = static_cast<float>(10.0 * y);
    }
    return p;
}

TEST(ToneMapping, ShowsTheMiddleAsMiddleGreyAndWhiteAsWhite) {
    const Exposure e{50.0, 400.0};
    Planes3 c;
    c.assign(3, 0.0F);
    c.set(1, Rgb::grey(50.0));
    c.set(2, Rgb::grey(400.0));
    const auto bytes = tone_map(c, e);
    EXPECT_EQ(bytes[0], 0);
    // METHODS eq. (92): L = 0.18, white at 1.44: 0.18 (1 + 0.18/2.0736)/1.18 = 0.1658
    EXPECT_EQ(bytes[3], 113); // sRGB of 0.1658
    EXPECT_EQ(bytes[6], 255);
    EXPECT_EQ(bytes[8], 255);
}

TEST(ToneMapping, KeepsTheOrderOfLuminances) {
    Planes3 c;
    c.assign(100, 0.0F);
    for (std::size_t i = 0; i < 100; ++i)
        c.set(i, Rgb::grey(static_cast<double>(i * i)));
    const auto bytes = tone_map(c, {200.0, 9000.0});
    for (std::size_t i = 1; i < 100; ++i)
        EXPECT_GE(bytes[3 * i], bytes[3 * (i - 1)]);
}

TEST(ToneMapping, ChoosesTheMeanOfSurfacesAndNotOfLuminaires) {
    ViewPicture p = grey_ramp();
    const Exposure before = choose_exposure(p);
    p.raw.set(5, Rgb::grey(1e5));
    p.emission.set(5, Rgb::grey(1e5));
    const Exposure after = choose_exposure(p);
    EXPECT_NEAR(after.middle, before.middle, 0.01 * before.middle);
    EXPECT_NEAR(after.white, before.white, 0.05 * before.white);
}

TEST(ToneMapping, PrintsTheExposureValueOfISO2720) {
    EXPECT_EQ(describe({100.0 / 8.0, 250.0}),
              "EV 6.6 (middle grey 12.5 cd/m2, white from 250 cd/m2)");
}

TEST(ToneMapping, FadesColoursThatAreTooBrightToWhite) {
    Planes3 c;
    c.assign(1, 0.0F);
    c.set(0, Rgb{0.0, 0.0, 5000.0}); // Y 361
    const auto bytes = tone_map(c, {50.0, 400.0});
    EXPECT_EQ(bytes[2], 255);
    EXPECT_GT(bytes[0], 100);
}

std::string read_bytes(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::uint32_t big_endian(const std::string& s, std::size_t at) {
    std::uint32_t v = 0;
    for (std::size_t i = 0; i < 4; ++i)
        v = v << 8U | static_cast<unsigned char>(s[at + i]);
    return v;
}

TEST(PicturePng, IsAsLargeAsThePictureAndHasALegendBesideFalseColours) {
    const fs::path folder = fs::temp_directory_path() / "isolux-picture-png-test";
    fs::create_directories(folder);
    const ViewPicture p = grey_ramp();
    write_tone_mapped(folder / "a.png", p, choose_exposure(p));
    write_false_colours(folder / "b.png", p, PictureQuantity::luminance, "ramp");
    write_false_colours(folder / "c.png", p, PictureQuantity::illuminance, "ramp");
    const std::string a = read_bytes(folder / "a.png");
    const std::string b = read_bytes(folder / "b.png");
    const std::string c = read_bytes(folder / "c.png");
    fs::remove_all(folder);
    ASSERT_GT(a.size(), 24u);
    EXPECT_EQ(a.substr(1, 3), "PNG");
    EXPECT_EQ(big_endian(a, 16), 64u);
    EXPECT_EQ(big_endian(a, 20), 48u);
    EXPECT_GT(big_endian(b, 16), 100u);
    EXPECT_GE(big_endian(b, 20), 48u);
    EXPECT_NE(b, c);
}

TEST(PicturePng, ShowsNoBandsWhereAnEvenPictureHasNothingButNoise) {
    const fs::path folder = fs::temp_directory_path() / "isolux-picture-png-even-test";
    fs::create_directories(folder);
    ViewPicture p = grey_ramp();
    const auto draw = [&](const char* name, float noise) {
        for (std::size_t i = 0; i < p.illuminance.size(); ++i)
            p.illuminance[i] = 397.0F + (i % 3 == 0 ? noise : -0.5F * noise);
        write_false_colours(folder / name, p, PictureQuantity::illuminance, "even");
        return read_bytes(folder / name);
    };
    const std::string even = draw("even.png", 0.0F);
    const std::string noisy = draw("noisy.png", 0.4F);
    const std::string uneven = draw("uneven.png", 200.0F);
    fs::remove_all(folder);
    EXPECT_EQ(even, noisy);
    EXPECT_NE(even, uneven);
}

} // namespace
} // namespace isolux::test
