#pragma once

#include <optional>

#include "isolux/filter/pixel_buffers.h"

/// How far two pictures differ, METHODS 12.5. Pictures are planes of one size,
/// usually luminances in cd/m2.
namespace isolux {

/// A reference and, where known, its two independent halves (reference = their
/// mean): then the reference's own noise drops out of every squared error,
/// METHODS eq. (102).
struct Reference {
    Plane mean;
    std::optional<Plane> half_1;
    std::optional<Plane> half_2;
};

/// A squared error and how sure it is.
struct SquaredError {
    double value = 0.0;
    double reference_noise =
        0.0; ///< about what the reference's noise still does to it; 0: unknown

    /// False where that exceeds a tenth of the value: the comparison says
    /// nothing.
    [[nodiscard]] bool is_trustworthy() const noexcept {
        return reference_noise <= 0.1 * value || reference_noise == 0.0;
    }
};

[[nodiscard]] SquaredError mean_squared_error(const Plane& test, const Reference& reference);

/// Mean of (a-b)^2/(b^2 + e^2) with e a tenth of the reference's mean, METHODS
/// eq. (102).
[[nodiscard]] SquaredError relative_squared_error(const Plane& test,
                                                  const Reference& reference);

/// Squared bias of a deterministic operation F, from the halves of the
/// reference it was applied to: mean of (F(b1)-b1)(F(b2)-b2).
[[nodiscard]] double
squared_bias(const Plane& f_1, const Plane& half_1, const Plane& f_2, const Plane& half_2);

/// 10 log10(1/mean squared error) of display-encoded pictures, dB; infinite for
/// equal ones.
[[nodiscard]] double peak_signal_to_noise(const Plane& encoded_test,
                                          const Plane& encoded_reference);

enum class SsimWindow {
    gaussian_11, ///< 11 x 11, standard deviation 1.5: "ssim-g11"
    uniform_7    ///< 7 x 7 box with sample covariance: "ssim-u7"
};

/// Structural similarity, mean over the pixels whose window lies inside,
/// METHODS eq. (103). Nothing if the picture is smaller than a window.
/// @param range  of the data, D of the equation
[[nodiscard]] std::optional<double>
ssim(PictureSize size, const Plane& a, const Plane& b, SsimWindow window, double range);

/// Display encoding for metrics, METHODS eq. (104): (Y/(4 median))^(1/2.2),
/// within 0 and 1.
[[nodiscard]] Plane display_encoded(const Plane& luminance, double reference_median);

/// Middle value; the mean of the middle two. 0 for an empty plane.
[[nodiscard]] double median_of(Plane values);

/// ssim-g11 of log10 luminance, both clipped below at a thousandth of the
/// reference's median, range from the reference. Nothing where the reference is
/// constant or dark.
[[nodiscard]] std::optional<double>
log_luminance_ssim(PictureSize size, const Plane& test, const Plane& reference);

/// Similarity in percent as (SSIM + 1)/2, and back.
[[nodiscard]] constexpr double similarity_percent(double ssim_value) noexcept {
    return 50.0 * (ssim_value + 1.0);
}

[[nodiscard]] constexpr double ssim_of_similarity(double percent) noexcept {
    return percent / 50.0 - 1.0;
}

/// All of them at once.
struct PictureMetrics {
    SquaredError mse;
    SquaredError relative_mse;
    double psnr = 0.0; ///< dB, display-encoded, peak 1
    std::optional<double> ssim_g11;
    std::optional<double> ssim_u7;
    std::optional<double> log_ssim_g11;
};

[[nodiscard]] PictureMetrics
compare_pictures(PictureSize size, const Plane& test, const Reference& reference);

} // namespace isolux
