#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isolux/base/angle.h"
#include "isolux/base/sine_cosine.h"
#include "isolux/base/units.h"
#include "isolux/base/vec.h"

namespace isolux {

/// Which way the table's poles point. LM-63 types A and C are the same system up to a
/// relabelling (gamma = V + 90, C = -H); type B is the same table lying on its side.
enum class TablePole {
    nadir,   ///< gamma is counted from -z, C from +x towards +y (types C and A, EULUMDAT)
    lateral, ///< type B: the poles lie on the y axis, C from -z towards +x (V), gamma from +y
             ///< (H + 90)
};

/// A luminous intensity distribution on a full (C, gamma) grid, bilinear in the two angles.
///
/// The one interpolant is evaluated and integrated (METHODS, "Table interpolation", eq. (4));
/// who draws directions from it draws from the same cells, so its flux is the flux of what is
/// drawn. Outside the tabulated range the intensity is zero. Symmetry is already expanded:
/// planes run over the covered azimuth range; a full circle is closed by a last plane at first
/// + 360.
class IntensityDistribution {
public:
    /// @param planes   azimuths, ascending, at least 2; all within one turn (last - first <= 2
    /// pi)
    /// @param gammas   polar angles, ascending, at least 2, within [0, pi]
    /// @param candela  planes.size() * gammas.size() values >= 0, gamma fastest
    /// @pre  sizes agree and the angles ascend; readers have checked that
    IntensityDistribution(std::vector<Angle> planes,
                          std::vector<Angle> gammas,
                          std::vector<double> candela,
                          TablePole pole = TablePole::nadir);

    /// Intensity towards a direction given in the luminaire's frame (gamma 0 down, C0 along
    /// +x).
    [[nodiscard]] Candela evaluate(const UnitVector3& direction) const noexcept;

    /// Intensity at the table's own angles; azimuth is taken modulo 360 degrees.
    [[nodiscard]] Candela evaluate(Angle plane, Angle gamma) const noexcept;

    /// Flux of the interpolant, exact, METHODS eq. (4) ("rule L").
    [[nodiscard]] Lumen flux() const noexcept;

    /// Flux by the trapezoidal zone rule of common photometric software ("rule T").
    [[nodiscard]] Lumen flux_trapezoid() const noexcept;

    [[nodiscard]] std::span<const Angle> planes() const noexcept { return planes_; }

    [[nodiscard]] std::span<const Angle> gammas() const noexcept { return gammas_; }

    [[nodiscard]] Candela at(std::size_t plane, std::size_t gamma) const noexcept {
        return Candela(candela_[plane * gammas_.size() + gamma]);
    }

    [[nodiscard]] TablePole pole() const noexcept { return pole_; }

    [[nodiscard]] Candela max_intensity() const noexcept { return max_; }

    /// Direction in the luminaire's frame that belongs to the table's angles.
    [[nodiscard]] UnitVector3 direction(Angle plane, Angle gamma) const noexcept;
    [[nodiscard]] UnitVector3 direction(const SineCosine& plane,
                                        const SineCosine& gamma) const noexcept;

private:
    /// How to find the interval an angle lies in: by division where the nodes are evenly
    /// spaced.
    struct Axis {
        double first = 0.0;           ///< rad
        double span = 0.0;            ///< rad, last - first
        double intervals_per_rad = 0; ///< 0: uneven, search
    };

    struct Place {
        std::size_t interval = 0;
        double fraction = 0.0;
    };

    [[nodiscard]] static Axis make_axis(std::span<const Angle> nodes) noexcept;
    [[nodiscard]] static Place
    find_place(const Axis& axis, std::span<const Angle> nodes, double from_first) noexcept;
    [[nodiscard]] double interpolate(double azimuth, double polar) const noexcept;

    std::vector<Angle> planes_;
    std::vector<Angle> gammas_;
    std::vector<double> candela_;
    TablePole pole_;
    Candela max_;
    Axis plane_axis_;
    Axis gamma_axis_;
    bool is_full_circle_ = false;
    bool is_rotational_ = false;
};

} // namespace isolux
