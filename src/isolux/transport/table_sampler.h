#pragma once

#include <vector>

#include "isolux/photometry/gamma_piece.h"
#include "isolux/photometry/intensity_distribution.h"
#include "isolux/sampling/warp.h"

namespace isolux {

/// A direction in the luminaire's frame and the intensity there.
struct TableDraw {
    UnitVector3 direction;
    double candela = 0.0;
};

/// Draws directions from a luminous intensity table with density exactly I(w)/flux per
/// steradian, METHODS eq. (4): a cell by inverting the running sum of the cells' flux (in table
/// order, which keeps stratified numbers stratified), gamma inside it, then the azimuth. The
/// table must outlive the sampler.
class TableSampler {
public:
    /// @pre distribution.flux() > 0
    explicit TableSampler(const IntensityDistribution& distribution);

    /// @param u chooses cell and gamma, @param v the azimuth
    [[nodiscard]] TableDraw draw(double u, double v) const noexcept;

    /// Direction in the luminaire's frame.
    [[nodiscard]] UnitVector3 sample(double u, double v) const noexcept {
        return draw(u, v).direction;
    }

    /// I(w)/flux, per steradian.
    [[nodiscard]] double pdf(const UnitVector3& local) const noexcept {
        return in_candela(distribution_->evaluate(local)) / flux_;
    }

    [[nodiscard]] double flux() const noexcept { return flux_; }

private:
    /// All cells between two gammas.
    struct Row {
        double width = 0.0; ///< rad
        SineCosine lower;   ///< of the lower gamma
        GammaPiece whole;
    };

    /// A gamma drawn in a row.
    struct Gamma {
        double t = 0.0; ///< its place, 0 .. 1
        SineCosine angle;
    };

    [[nodiscard]] static Gamma
    sample_gamma(const Row& row, double at_lower, double at_upper, double xi) noexcept;

    const IntensityDistribution* distribution_;
    std::vector<Row> rows_;
    CumulativeTable cells_; ///< their flux, lm
    double flux_ = 0.0;
};

} // namespace isolux
