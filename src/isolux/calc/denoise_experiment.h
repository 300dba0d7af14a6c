#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "isolux/base/estimate.h"
#include "isolux/calc/render.h"

/// What denoising does to a picture as its samples grow, beside a converged reference.
/// METHODS 12.7.
namespace isolux {

struct DenoiseTask {
    std::size_t steps = 14;
    std::size_t step_samples = 4; ///< a pixel that each step adds
    std::size_t seeds = 10;
    /// The reference has so many times the last step's samples, in two halves.
    std::size_t reference_factor = 100;
    std::uint64_t seed = 1;
};

/// Means over the seeds with their standard errors, one filter, one step.
struct DenoisedStep {
    /// (a) Percent, (SSIM + 1)/2 of ssim-u7 on 8-bit grey: noisy picture against its own
    /// denoised one, and the first step's denoised picture against this one.
    Estimate similarity_to_own;
    Estimate similarity_to_first;
    Estimate ssim;           ///< (c, d) ssim-g11 against the reference
    Estimate relative_mse;   ///< against the reference, its own noise removed
    Estimate filter_seconds; ///< (e) CPU
    Estimate speed_up;       ///< (f) samples an unfiltered picture needs for its error, ratio
    bool is_extrapolated = false; ///< for some seed beyond the last step
};

struct DenoiseStep {
    std::size_t samples = 0; ///< a pixel
    Estimate ssim;           ///< (b) of the noisy picture
    Estimate relative_mse;
    Estimate render_seconds;           ///< (e) CPU, without the filter
    std::vector<DenoisedStep> filters; ///< as in DenoiseStudy::filters
};

struct DenoiseStudy {
    DenoiseTask task;
    PictureSize size;
    std::vector<std::string> filters; ///< "axis-aligned", and "oidn" where the machine has it
    std::string missing;              ///< why there is no "oidn"; empty where there is
    std::vector<DenoiseStep> steps;
    double reference_noise = 0.0; ///< as in FilterComparison
    /// Exponent of 1/SSIM - 1 of (a) over the samples, one a filter: about -0.9 says that the
    /// number measures the noise of the input.
    std::vector<double> exponents;
};

[[nodiscard]] DenoiseStudy study_denoising(const Scene& scene,
                                           const View& view,
                                           const DenoiseTask& task,
                                           const std::function<void(double)>& progress);

} // namespace isolux
