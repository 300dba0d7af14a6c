#include "isolux/filter/picture_metrics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

namespace isolux {
namespace {

double mean_of(const Plane& values) {
    double sum = 0.0;
    for (const float v : values)
        sum += v;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// Mean of (a - b1)(a - b2) weight(b), or of (a - b)^2 weight(b) without
/// halves.
SquaredError weighted_error(const Plane& test,
                            const Reference& reference,
                            const std::function<double(double)>& weight) {
    const auto n = static_cast<double>(test.size());
    SquaredError e;
    double noise = 0.0;
    for (std::size_t i = 0; i < test.size(); ++i) {
        const double w = weight(reference.mean[i]);
        if (reference.half_1 && reference.half_2) {
            const double b1 = (*reference.half_1)[i];
            const double b2 = (*reference.half_2)[i];
            e.value += w * (test[i] - b1) * (test[i] - b2);
            noise += w * 0.25 * (b1 - b2) * (b1 - b2);
        } else {
            const double d = static_cast<double>(test[i]) - reference.mean[i];
            e.value += w * d * d;
        }
    }
    if (test.empty())
        return e;
    e.value /= n;
    e.reference_noise = noise / n / std::sqrt(n);
    return e;
}

} // namespace

SquaredError mean_squared_error(const Plane& test, const Reference& reference) {
    return weighted_error(test, reference, [](double) { return 1.0; });
}

SquaredError relative_squared_error(const Plane& test, const Reference& reference) {
    constexpr double share = 0.1;
    const double e = share * mean_of(reference.mean);
    return weighted_error(test, reference, [e](double b) {
        const double square = b * b + e * e;
        return square > 0.0 ? 1.0 / square : 0.0;
    });
}

double
squared_bias(const Plane& f_1, const Plane& half_1, const Plane& f_2, const Plane& half_2) {
    double sum = 0.0;
    for (std::size_t i = 0; i < f_1.size(); ++i)
        sum += (static_cast<double>(f_1[i]) - half_1[i])
               * (static_cast<double>(f_2[i]) - half_2[i]);
    return f_1.empty() ? 0.0 : sum / static_cast<double>(f_1.size());
}

double peak_signal_to_noise(const Plane& encoded_test, const Plane& encoded_reference) {
    const double mse =
        mean_squared_error(encoded_test, {encoded_reference, std::nullopt, std::nullopt}).value;
    return mse > 0.0 ? -10.0 * std::log10(mse) : std::numeric_limits<double>::infinity();
}

Plane display_encoded(const Plane& luminance, double reference_median) {
    constexpr double headroom = 4.0;
    constexpr double gamma = 2.2;
    Plane encoded(luminance.size(), 0.0F);
    if (!(reference_median > 0.0))
        return encoded;
    for (std::size_t i = 0; i < encoded.size(); ++i) {
        const double v = std::clamp(luminance[i] / (headroom * reference_median), 0.0, 1.0);
        encoded[i] = static_cast<float>(std::pow(v, 1.0 / gamma));
    }
    return encoded;
}

double median_of(Plane values) {
    if (values.empty())
        return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1)
        return *middle;
    return 0.5 * (static_cast<double>(*middle) + *std::max_element(values.begin(), middle));
}

std::optional<double>
log_luminance_ssim(PictureSize size, const Plane& test, const Plane& reference) {
    constexpr double darkest = 1e-3; // of the median
    const double floor = darkest * median_of(reference);
    if (!(floor > 0.0))
        return std::nullopt;
    const auto logarithm = [floor](const Plane& values) {
        Plane out(values.size());
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = static_cast<float>(std::log10(std::max<double>(values[i], floor)));
        return out;
    };
    const Plane b = logarithm(reference);
    const auto [low, high] = std::minmax_element(b.begin(), b.end());
    const double range = static_cast<double>(*high) - *low;
    if (!(range > 0.0))
        return std::nullopt;
    return ssim(size, logarithm(test), b, SsimWindow::gaussian_11, range);
}

PictureMetrics
compare_pictures(PictureSize size, const Plane& test, const Reference& reference) {
    const double median = median_of(reference.mean);
    const Plane a = display_encoded(test, median);
    const Plane b = display_encoded(reference.mean, median);
    PictureMetrics m;
    m.mse = mean_squared_error(test, reference);
    m.relative_mse = relative_squared_error(test, reference);
    m.psnr = peak_signal_to_noise(a, b);
    m.ssim_g11 = ssim(size, a, b, SsimWindow::gaussian_11, 1.0);
    m.ssim_u7 = ssim(size, a, b, SsimWindow::uniform_7, 1.0);
    m.log_ssim_g11 = log_luminance_ssim(size, test, reference.mean);
    return m;
}

} // namespace isolux
