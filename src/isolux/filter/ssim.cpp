#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "isolux/base/parallel.h"
#include "isolux/filter/picture_metrics.h"

namespace isolux {
namespace {

/// Weights along one axis, of sum 1; a window is their product with themselves.
std::vector<double> window_weights(SsimWindow window) {
    if (window == SsimWindow::uniform_7)
        return std::vector<double>(7, 1.0 / 7.0);
    constexpr double sigma = 1.5;
    std::vector<double> weights(11);
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double r = static_cast<double>(i) - 5.0;
        sum += weights[i] = std::exp(-0.5 * r * r / (sigma * sigma));
    }
    for (double& w : weights)
        w /= sum;
    return weights;
}

struct Moments {
    double a = 0.0;
    double b = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;

    void add(double w, const Moments& m) noexcept {
        a += w * m.a;
        b += w * m.b;
        aa += w * m.aa;
        bb += w * m.bb;
        ab += w * m.ab;
    }
};

/// METHODS eq. (103). `bessel`: factor that turns moments into sample
/// (co)variances.
double similarity(const Moments& m, double bessel, double c1, double c2) noexcept {
    const double var_a = bessel * (m.aa - m.a * m.a);
    const double var_b = bessel * (m.bb - m.b * m.b);
    const double cov = bessel * (m.ab - m.a * m.b);
    return (2.0 * m.a * m.b + c1) * (2.0 * cov + c2)
           / ((m.a * m.a + m.b * m.b + c1) * (var_a + var_b + c2));
}

} // namespace

std::optional<double>
ssim(PictureSize size, const Plane& a, const Plane& b, SsimWindow window, double range) {
    const std::vector<double> weights = window_weights(window);
    const std::size_t side = weights.size();
    if (size.columns < side || size.rows < side)
        return std::nullopt;
    const double samples = static_cast<double>(side * side);
    const double bessel = window == SsimWindow::uniform_7 ? samples / (samples - 1.0) : 1.0;
    const double c1 = 0.01 * range * 0.01 * range;
    const double c2 = 0.03 * range * 0.03 * range;
    const std::size_t columns = size.columns - side + 1;
    const std::size_t rows = size.rows - side + 1;
    std::vector<double> sums(rows);
    for_each_index(rows, 4, [&](std::size_t y) {
        std::vector<Moments> vertical(size.columns);
        for (std::size_t k = 0; k < side; ++k) {
            for (std::size_t x = 0; x < size.columns; ++x) {
                const double u = a[(y + k) * size.columns + x];
                const double v = b[(y + k) * size.columns + x];
                vertical[x].add(weights[k], {u, v, u * u, v * v, u * v});
            }
        }
        for (std::size_t x = 0; x < columns; ++x) {
            Moments m;
            for (std::size_t k = 0; k < side; ++k)
                m.add(weights[k], vertical[x + k]);
            sums[y] += similarity(m, bessel, c1, c2);
        }
    });
    double sum = 0.0;
    for (const double s : sums)
        sum += s;
    return sum / static_cast<double>(rows * columns);
}

} // namespace isolux
