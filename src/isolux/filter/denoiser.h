#pragma once

#include <memory>
#include <string>

#include "isolux/filter/pixel_buffers.h"

namespace isolux {

/// What a neural denoiser is told: linear light without an upper limit, and what the pixels
/// show. Each plane of the picture's size.
struct DenoiserInput {
    PictureSize size;
    const Planes3* colour = nullptr; ///< cd/m2, linear
    const Planes3* albedo = nullptr; ///< 0..1
    const Planes3* normal = nullptr; ///< unit vectors, world; zero where there is none
    bool is_noise_free = false;      ///< albedo and normal are
};

/// Intel Open Image Denoise 2, a library that a machine may have or not: looked for when it is
/// asked for. One object for as many pictures as wanted.
/// Source: https://www.openimagedenoise.org
class OpenImageDenoise {
public:
    /// @param file  name or path of the shared library
    /// @throws DeviceError  it is not there, is too old, or finds no device
    explicit OpenImageDenoise(const std::string& file = "libOpenImageDenoise.so.2");
    ~OpenImageDenoise();
    OpenImageDenoise(OpenImageDenoise&&) noexcept;
    OpenImageDenoise& operator=(OpenImageDenoise&&) noexcept;

    /// @throws DeviceError  with the library's own words
    [[nodiscard]] Planes3 apply(const DenoiserInput& input);

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace isolux
