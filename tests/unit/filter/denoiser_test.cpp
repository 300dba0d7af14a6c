#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/filter/denoiser.h"

namespace isolux::test {
namespace {

Planes3 filled(std::size_t pixels, float value) {
    Planes3 p;
    p.assign(pixels, value);
    return p;
}

TEST(OpenImageDenoiseBackEnd, SaysClearlyThatItIsNotThere) {
    try {
        const OpenImageDenoise denoiser("libno-such-denoiser.so.2");
        FAIL();
    } catch (const DeviceError& e) {
        EXPECT_STREQ(e.what(),
                     "Open Image Denoise 2 is not on this machine (libno-such-denoiser.so.2 "
                     "cannot be loaded). Install it, or use --filter axis-aligned?");
    }
}

TEST(OpenImageDenoiseBackEnd, RefusesALibraryWithoutItsFunctions) {
    EXPECT_THROW(OpenImageDenoise("libm.so.6"), DeviceError);
}

TEST(OpenImageDenoiseBackEnd, HandsOverLinearLightWithAlbedoAndNormal) {
    OpenImageDenoise denoiser(ISOLUX_FAKE_DENOISER);
    const Planes3 colour = filled(6, 5000.0F);
    const Planes3 albedo = filled(6, 0.5F);
    const Planes3 normal = filled(6, 1.0F);
    const Planes3 out = denoiser.apply({{3, 2}, &colour, &albedo, &normal, true});
    ASSERT_EQ(out.x.size(), 6u);
    EXPECT_EQ(out.y[4], 2500.5F);
    // another size: another filter
    const Planes3 small = filled(1, 2.0F);
    const Planes3 albedo_of_one = filled(1, 0.2F);
    EXPECT_EQ(denoiser.apply({{1, 1}, &small, &albedo_of_one, &small, false}).x.size(), 1u);
}

TEST(OpenImageDenoiseBackEnd, PassesOnTheLibrarysComplaint) {
    OpenImageDenoise denoiser(ISOLUX_FAKE_DENOISER);
    const Planes3 colour = filled(1, 1.0F);
    const Planes3 wrong = filled(1, 7.0F);
    try {
        static_cast<void>(denoiser.apply({{1, 1}, &colour, &wrong, &colour, false}));
        FAIL();
    } catch (const DeviceError& e) {
        EXPECT_STREQ(e.what(), "Open Image Denoise: albedo out of range");
    }
}

} // namespace
} // namespace isolux::test
