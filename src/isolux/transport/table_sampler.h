#pragma once

#include <vector>

#include "isolux/photometry/intensity_distribution.h"

namespace isolux {

/// Draws directions from a luminous intensity table with density exactly I(w)/flux per
/// steradian, METHODS eq. (4): a cell by inverting the running sum of the cells' flux (in table
/// order, which keeps stratified numbers stratified), gamma inside it, then the azimuth. The
/// table must outlive the sampler.
class TableSampler {
public:
    /// @pre distribution.flux() > 0
    explicit TableSampler(const IntensityDistribution& distribution);

    /// Direction in the luminaire's frame. @param u chooses cell and gamma, @param v the
    /// azimuth
    [[nodiscard]] UnitVector3 sample(double u, double v) const noexcept;

    /// I(w)/flux, per steradian.
    [[nodiscard]] double pdf(const UnitVector3& local) const noexcept {
        return in_candela(distribution_->evaluate(local)) / flux_;
    }

    [[nodiscard]] double flux() const noexcept { return flux_; }

private:
    const IntensityDistribution* distribution_;
    std::vector<double> cumulative_; ///< running sum of the cells' flux, lm
    double flux_ = 0.0;
};

} // namespace isolux
