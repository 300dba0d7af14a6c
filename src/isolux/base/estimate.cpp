#include "isolux/base/estimate.h"

#include <cmath>

#include <boost/math/distributions/students_t.hpp>

#include "isolux/base/check.h"

namespace isolux {

Estimate estimate_from_replicates(std::span<const double> replicates) noexcept {
    const std::size_t n = replicates.size();
    if (n == 0)
        return {};
    double sum = 0.0;
    for (const double y : replicates)
        sum += y;
    const double mean = sum / static_cast<double>(n);
    if (n == 1)
        return {mean, 0.0, 1};
    double squares = 0.0;
    for (const double y : replicates)
        squares += (y - mean) * (y - mean);
    const double count = static_cast<double>(n);
    return {mean, std::sqrt(squares / ((count - 1.0) * count)), n};
}

double student_quantile(double confidence, double degrees_of_freedom) {
    ISOLUX_EXPECT(confidence > 0.0 && confidence < 1.0 && degrees_of_freedom >= 1.0);

    struct Answer {
        double confidence = 0.0;
        double degrees_of_freedom = 0.0;
        double quantile = 0.0;
    };

    // Slow to find, and a million points ask for the same one.
    thread_local Answer last;
    if (confidence != last.confidence || degrees_of_freedom != last.degrees_of_freedom) {
        const boost::math::students_t distribution(degrees_of_freedom);
        last = {confidence,
                degrees_of_freedom,
                boost::math::quantile(
                    boost::math::complement(distribution, 0.5 * (1.0 - confidence)))};
    }
    return last.quantile;
}

Interval confidence_interval(const Estimate& e, double confidence) {
    if (e.samples < 2 || e.standard_error == 0.0)
        return {e.mean, e.mean};
    const double half =
        student_quantile(confidence, static_cast<double>(e.samples - 1)) * e.standard_error;
    return {e.mean - half, e.mean + half};
}

} // namespace isolux
