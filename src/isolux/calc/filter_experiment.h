#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "isolux/base/estimate.h"
#include "isolux/calc/render.h"

/// What the axis-aligned filter is worth: how many samples, and how much time, an unfiltered
/// picture needs for the error of the filtered one. METHODS 12.6.
namespace isolux {

struct FilterTask {
    std::size_t samples = 16; ///< a pixel, of the filtered picture
    std::size_t seeds = 3;    ///< independent repetitions, which give the spread
    /// Each half of the reference has so many times the samples.
    std::size_t reference_factor = 8;
    std::uint64_t seed = 1;
    bool direct_only = false;
};

/// One picture: what it cost and how far it is from the reference.
struct FilterMeasurement {
    std::size_t samples = 0;     ///< a pixel
    double relative_mse = 0.0;   ///< METHODS eq. (102), the reference's own noise removed
    double cpu_seconds = 0.0;    ///< of the whole process
    double filter_seconds = 0.0; ///< CPU, of the filter alone
};

/// Counts of the unfiltered pictures, as multiples of the filtered one's.
inline constexpr std::array<double, 4> unfiltered_multiples{0.5, 1.0, 2.0, 4.0};

/// One seed.
struct FilterRun {
    std::uint64_t seed = 0;
    FilterMeasurement filtered;
    std::vector<FilterMeasurement> unfiltered; ///< by count
    /// Samples and CPU seconds at which the unfiltered error equals the filtered one.
    double equal_samples = 0.0;
    double equal_seconds = 0.0;
    bool is_extrapolated = false; ///< beyond the largest count

    [[nodiscard]] double sample_ratio() const noexcept;
    [[nodiscard]] double time_ratio() const noexcept;
};

struct FilterComparison {
    FilterTask task;
    PictureSize size;
    std::vector<FilterRun> runs;
    Estimate sample_ratio; ///< mean over the seeds with its standard error
    Estimate time_ratio;
    /// What the reference's noise may still do to the error, as a share of the smallest one;
    /// above 0.1 the comparison says nothing.
    double reference_noise = 0.0;
};

/// Finds where the unfiltered error falls to `filtered.relative_mse`: straight lines between
/// logarithms of error and count; beyond the counts the nearest line goes on.
/// @pre at least two counts, errors above zero
void find_equal_error(FilterRun& run);

/// @param progress  share of the work that is done, 0..1
[[nodiscard]] FilterComparison compare_filter(const Scene& scene,
                                              const View& view,
                                              const FilterTask& task,
                                              const std::function<void(double)>& progress);

/// Luminance of a picture, cd/m2, as shown or raw.
[[nodiscard]] Plane luminance_of(const Planes3& colour);

} // namespace isolux
