#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "isolux/calc/calculate.h"
#include "isolux/calc/picture.h"
#include "isolux/measure/camera.h"

namespace isolux {

enum class PictureFilter : std::uint8_t {
    none,
    axis_aligned,
    oidn ///< Intel Open Image Denoise, where the machine has it
};

/// How much work a picture is worth, and what is done to its noise.
struct RenderSettings {
    std::size_t samples = 16; ///< rays a pixel, at most; at least 2
    /// Stop earlier, once the raw picture's error (METHODS eq. (91)) is below this.
    std::optional<double> tolerance;
    std::optional<std::chrono::duration<double>> time_limit;
    PictureFilter filter = PictureFilter::axis_aligned;
    bool is_preview = false; ///< a coarse pilot and wide filters, for speed
    std::uint64_t seed = 1;
    bool direct_only = false; ///< no reflected light
    /// Larger pictures are rendered in bands of rows, for their memory; denoised ones never
    /// are.
    std::size_t pixels_at_once = 4'000'000;
};

/// Renders a view: luminance by double local estimation, METHODS "Pictures". The same bits for
/// any number of threads, unless time or the user ends it.
/// @throws DeviceError  the denoiser that was asked for is not on this machine
[[nodiscard]] ViewPicture render(const Scene& scene,
                                 const View& view,
                                 const RenderSettings& settings,
                                 const Control& control = {});

} // namespace isolux
