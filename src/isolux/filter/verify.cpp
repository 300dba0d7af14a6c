#include "isolux/filter/verify.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "isolux/base/parallel.h"
#include "isolux/filter/gaussian_row.h"

namespace isolux {
namespace {

constexpr std::size_t grain = 4096; ///< pixels

/// Sums over `radius` neighbours to either side of every value of a line.
void sum_line(const std::vector<double>& in, std::size_t radius, std::vector<double>& out) {
    const std::size_t n = in.size();
    double sum = 0.0;
    for (std::size_t i = 0; i < std::min(n, radius); ++i)
        sum += in[i];
    for (std::size_t i = 0; i < n; ++i) {
        if (i + radius < n)
            sum += in[i + radius];
        if (i > radius)
            sum -= in[i - radius - 1];
        out[i] = sum;
    }
}

std::vector<double>
window_sum(PictureSize size, const std::vector<double>& values, std::size_t radius) {
    std::vector<double> along_rows(values.size());
    std::vector<double> result(values.size());
    for_each_index(size.rows, 8, [&](std::size_t y) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(y * size.columns);
        std::vector<double> in(first, first + static_cast<std::ptrdiff_t>(size.columns));
        std::vector<double> out(size.columns);
        sum_line(in, radius, out);
        std::copy(out.begin(),
                  out.end(),
                  along_rows.begin() + static_cast<std::ptrdiff_t>(y * size.columns));
    });
    // Columns side by side, so that memory is read in order.
    constexpr std::size_t side_by_side = 64;
    for_each_range(size.columns, side_by_side, [&](std::size_t begin, std::size_t end) {
        std::vector<double> sum(end - begin, 0.0);
        const auto add = [&](std::size_t y, double sign) {
            const double* const row = along_rows.data() + y * size.columns + begin;
            for (std::size_t k = 0; k < sum.size(); ++k)
                sum[k] += sign * row[k];
        };
        for (std::size_t y = 0; y < std::min(size.rows, radius); ++y)
            add(y, 1.0);
        for (std::size_t y = 0; y < size.rows; ++y) {
            if (y + radius < size.rows)
                add(y + radius, 1.0);
            if (y > radius)
                add(y - radius - 1, -1.0);
            std::copy(sum.begin(),
                      sum.end(),
                      result.begin() + static_cast<std::ptrdiff_t>(y * size.columns + begin));
        }
    });
    return result;
}

Plane mean_from_sums(const std::vector<double>& sum, const std::vector<double>& count) {
    Plane mean(sum.size());
    for_each_index(sum.size(), grain, [&](std::size_t i) {
        mean[i] = count[i] > 0.5 ? static_cast<float>(sum[i] / count[i]) : 0.0F;
    });
    return mean;
}

std::vector<double> counts(const FilterSites& sites, std::size_t radius) {
    std::vector<double> one(sites.size.pixels());
    for (std::size_t i = 0; i < one.size(); ++i)
        one[i] = sites.object[i] != 0 ? 1.0 : 0.0;
    return window_sum(sites.size, one, radius);
}

Plane masked_mean(const FilterSites& sites,
                  const Plane& values,
                  std::size_t radius,
                  const std::vector<double>& count) {
    std::vector<double> masked(values.size());
    for_each_index(values.size(), grain, [&](std::size_t i) {
        masked[i] = sites.object[i] != 0 ? values[i] : 0.0;
    });
    return mean_from_sums(window_sum(sites.size, masked, radius), count);
}

} // namespace

Plane window_mean(const FilterSites& sites, const Plane& values, std::size_t window) {
    return masked_mean(sites, values, window / 2, counts(sites, window / 2));
}

SquaredErrors squared_errors(const Halves& raw, const Halves& filtered) {
    const std::size_t n = raw.a.size();
    SquaredErrors e{Plane(n), Plane(n), Plane(n)};
    for_each_index(n, grain, [&](std::size_t i) {
        const float bias = (filtered.a[i] - raw.a[i]) * (filtered.b[i] - raw.b[i]);
        const float spread = filtered.a[i] - filtered.b[i];
        const float noise = raw.a[i] - raw.b[i];
        e.bias[i] = bias;
        e.filtered[i] = bias + 0.25F * spread * spread;
        e.raw[i] = 0.25F * noise * noise;
    });
    return e;
}

Plane squared_error_of_half(const Halves& raw, const Halves& filtered, const Halves& variance) {
    Plane e(raw.a.size());
    for (std::size_t i = 0; i < e.size(); ++i) {
        const float a = filtered.a[i] - raw.b[i];
        const float b = filtered.b[i] - raw.a[i];
        e[i] = 0.5F * (a * a - variance.b[i] + b * b - variance.a[i]);
    }
    return e;
}

std::vector<unsigned char> best_candidates(const FilterSites& sites,
                                           const Halves& raw,
                                           std::span<const Halves> candidates,
                                           std::size_t window) {
    const std::size_t radius = window / 2;
    const std::vector<double> count = counts(sites, radius);
    std::vector<unsigned char> best(raw.a.size(), 0);
    Plane smallest = masked_mean(sites, squared_errors(raw, raw).raw, radius, count);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Plane error =
            masked_mean(sites, squared_errors(raw, candidates[k]).filtered, radius, count);
        for (std::size_t i = 0; i < best.size(); ++i) {
            if (error[i] < smallest[i]) {
                smallest[i] = error[i];
                best[i] = static_cast<unsigned char>(k + 1);
            }
        }
    }
    return best;
}

WidthChoice choose_widths(const FilterSites& sites,
                          const Halves& raw,
                          const std::array<Halves, 4>& ladder,
                          std::size_t window) {
    constexpr std::size_t smoothing = 7;
    const std::vector<unsigned char> best = best_candidates(sites, raw, ladder, window);
    const std::vector<double> count = counts(sites, smoothing / 2);
    WidthChoice choice;
    Plane indicator(best.size());
    for (std::size_t k = 0; k < choice.share.size(); ++k) {
        for (std::size_t i = 0; i < best.size(); ++i)
            indicator[i] = best[i] == k ? 1.0F : 0.0F;
        choice.share[k] = masked_mean(sites, indicator, smoothing / 2, count);
    }
    choice.scale.assign(best.size(), 1.0F);
    for (std::size_t i = 0; i < best.size(); ++i) {
        float log_sum = 0.0F;
        float shares = 0.0F;
        for (std::size_t k = 1; k < choice.share.size(); ++k) {
            log_sum += choice.share[k][i] * std::log(width_factors[k - 1]);
            shares += choice.share[k][i];
        }
        if (shares > 0.0F)
            choice.scale[i] = std::exp(log_sum / shares);
        if (sites.object[i] == 0)
            choice.share[0][i] = 1.0F;
    }
    return choice;
}

std::size_t window_side(const FilterSettings& settings, bool indirect) noexcept {
    constexpr double many_samples = 16.0;
    if (settings.window != 0)
        return settings.window;
    return indirect && settings.samples < many_samples ? 31 : 15;
}

} // namespace isolux
