#include "isolux/transport/table_sampler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "isolux/base/check.h"

namespace isolux {

namespace {

/// Place in [0, 1] drawn from a density that is linear between p and q.
double sample_linear(double p, double q, double xi) noexcept {
    const double root = p + std::sqrt(p * p * (1.0 - xi) + q * q * xi);
    return root > 0.0 ? std::min(1.0, xi * (p + q) / root) : xi;
}

} // namespace

TableSampler::TableSampler(const IntensityDistribution& distribution)
    : distribution_(&distribution) {
    const auto planes = distribution.planes();
    const auto gammas = distribution.gammas();
    for (std::size_t j = 0; j + 1 < gammas.size(); ++j) {
        const double width = (gammas[j + 1] - gammas[j]).in_radians();
        const SineCosine lower = sine_cosine(gammas[j]);
        rows_.push_back({width, lower, gamma_piece(lower, width)});
    }
    std::vector<double> sums;
    sums.reserve((planes.size() - 1) * rows_.size());
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
        const double turn = (planes[i + 1] - planes[i]).in_radians();
        for (std::size_t j = 0; j < rows_.size(); ++j) {
            const double p =
                0.5 * in_candela(distribution.at(i, j) + distribution.at(i + 1, j));
            const double q =
                0.5 * in_candela(distribution.at(i, j + 1) + distribution.at(i + 1, j + 1));
            const GammaPiece& row = rows_[j].whole;
            sum += std::max(0.0, turn * (p * row.s0 + q * row.s1));
            sums.push_back(sum);
        }
    }
    flux_ = sum;
    ISOLUX_ENSURE(flux_ > 0.0);
    cells_ = CumulativeTable(std::move(sums));
}

/// Intensities averaged over the cell's azimuth are linear in gamma: inverts their flux by
/// Newton steps inside a shrinking bracket. The first guess takes the density for linear.
TableSampler::Gamma
TableSampler::sample_gamma(const Row& row, double p, double q, double xi) noexcept {
    const double total = p * row.whole.s0 + q * row.whole.s1;
    const double target = xi * total;
    double low = 0.0;
    double high = 1.0;
    double t = sample_linear(p * row.lower.sine, q * row.whole.upper.sine, xi);
    GammaPiece below;
    for (int step = 0; step < 30; ++step) {
        below = gamma_piece(row.lower, t * row.width);
        const double here = p + t * (q - p);
        const double residual = p * below.s0 + here * below.s1 - target;
        if (std::abs(residual) <= 1e-12 * total)
            break;
        (residual > 0.0 ? high : low) = t;
        const double slope = here * below.upper.sine * row.width;
        const double next = slope > 0.0 ? t - residual / slope : 2.0;
        t = (next >= low && next <= high) ? next : 0.5 * (low + high);
    }
    return {t, below.upper};
}

TableDraw TableSampler::draw(double u, double v) const noexcept {
    const DiscreteSample cell = cells_.sample(u);
    const std::size_t i = cell.index / rows_.size();
    const std::size_t j = cell.index % rows_.size();

    const double i00 = in_candela(distribution_->at(i, j));
    const double i01 = in_candela(distribution_->at(i, j + 1));
    const double i10 = in_candela(distribution_->at(i + 1, j));
    const double i11 = in_candela(distribution_->at(i + 1, j + 1));
    const Gamma gamma =
        sample_gamma(rows_[j], 0.5 * (i00 + i10), 0.5 * (i01 + i11), cell.stretched);

    // azimuth from the linear density between the cell's two planes at this gamma
    const double p0 = i00 + gamma.t * (i01 - i00);
    const double p1 = i10 + gamma.t * (i11 - i10);
    const double s = sample_linear(p0, p1, v);
    const auto planes = distribution_->planes();
    const Angle plane = planes[i] + s * (planes[i + 1] - planes[i]);
    return {distribution_->direction(sine_cosine(plane), gamma.angle), p0 + s * (p1 - p0)};
}

} // namespace isolux
