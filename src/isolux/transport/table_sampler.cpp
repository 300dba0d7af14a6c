#include "isolux/transport/table_sampler.h"

#include <algorithm>
#include <cmath>

#include "isolux/base/check.h"
#include "isolux/sampling/warp.h"

namespace isolux {

namespace {

/// One row of cells between two gammas: intensities averaged over the cell's azimuth are linear
/// in gamma, a + b v with v = (gamma - lower) / width.
struct GammaDensity {
    double lower = 0.0;
    double width = 0.0;
    double a = 0.0;
    double b = 0.0;

    /// Integral of (a + b v) sin(gamma) from the cell's lower edge, METHODS eq. (4).
    [[nodiscard]] double cumulative(double gamma) const noexcept {
        return a * (std::cos(lower) - std::cos(gamma))
               + b / width
                     * (std::sin(gamma) - std::sin(lower) - (gamma - lower) * std::cos(gamma));
    }

    [[nodiscard]] double density(double gamma) const noexcept {
        return (a + b * (gamma - lower) / width) * std::sin(gamma);
    }
};

/// Inverts the cell's distribution by Newton steps inside a shrinking bracket.
double invert(const GammaDensity& cell, double xi) noexcept {
    const double total = cell.cumulative(cell.lower + cell.width);
    const double target = xi * total;
    double low = cell.lower;
    double high = cell.lower + cell.width;
    double gamma = cell.lower + xi * cell.width;
    for (int step = 0; step < 30; ++step) {
        const double residual = cell.cumulative(gamma) - target;
        if (std::abs(residual) <= 1e-12 * total)
            break;
        (residual > 0.0 ? high : low) = gamma;
        const double slope = cell.density(gamma);
        const double next = slope > 0.0 ? gamma - residual / slope : high + 1.0;
        gamma = (next >= low && next <= high) ? next : 0.5 * (low + high);
    }
    return gamma;
}

} // namespace

TableSampler::TableSampler(const IntensityDistribution& distribution)
    : distribution_(&distribution) {
    const auto planes = distribution.planes();
    const auto gammas = distribution.gammas();
    cumulative_.reserve((planes.size() - 1) * (gammas.size() - 1));
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
        const double turn = (planes[i + 1] - planes[i]).in_radians();
        for (std::size_t j = 0; j + 1 < gammas.size(); ++j) {
            const double lower = gammas[j].in_radians();
            const double width = (gammas[j + 1] - gammas[j]).in_radians();
            const double p =
                0.5 * in_candela(distribution.at(i, j) + distribution.at(i + 1, j));
            const double q =
                0.5 * in_candela(distribution.at(i, j + 1) + distribution.at(i + 1, j + 1));
            const GammaDensity cell{lower, width, p, q - p};
            sum += std::max(0.0, turn * cell.cumulative(lower + width));
            cumulative_.push_back(sum);
        }
    }
    flux_ = sum;
    ISOLUX_ENSURE(flux_ > 0.0);
}

UnitVector3 TableSampler::sample(double u, double v) const noexcept {
    const auto planes = distribution_->planes();
    const auto gammas = distribution_->gammas();
    const DiscreteSample cell = sample_cumulative(cumulative_, u);
    const std::size_t i = cell.index / (gammas.size() - 1);
    const std::size_t j = cell.index % (gammas.size() - 1);

    const double i00 = in_candela(distribution_->at(i, j));
    const double i01 = in_candela(distribution_->at(i, j + 1));
    const double i10 = in_candela(distribution_->at(i + 1, j));
    const double i11 = in_candela(distribution_->at(i + 1, j + 1));

    // gamma from density (a + b v) sin(gamma)
    const double lower = gammas[j].in_radians();
    const double width = (gammas[j + 1] - gammas[j]).in_radians();
    const double a = 0.5 * (i00 + i10);
    const double b = 0.5 * (i01 + i11) - a;
    const double gamma = invert({lower, width, a, b}, cell.stretched);

    // azimuth from the linear density between the cell's two planes at this gamma
    const double t = (gamma - lower) / width;
    const double p0 = (1.0 - t) * i00 + t * i01;
    const double p1 = (1.0 - t) * i10 + t * i11;
    const double root = p0 + std::sqrt(p0 * p0 * (1.0 - v) + p1 * p1 * v);
    const double s = root > 0.0 ? std::min(1.0, v * (p0 + p1) / root) : v;
    const Angle plane = planes[i] + s * (planes[i + 1] - planes[i]);
    return distribution_->direction(plane, radians(gamma));
}

} // namespace isolux
