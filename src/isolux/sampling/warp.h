#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "isolux/base/vec.h"

/// Numbers in [0,1) to directions and points. Every sample_x has its pdf_x; both are pure.
namespace isolux {

/// Cosine-weighted direction about the local +z axis; density cos/pi.
[[nodiscard]] Vector3 sample_cosine_hemisphere(double u, double v) noexcept;
[[nodiscard]] double pdf_cosine_hemisphere(double cos_theta) noexcept;

/// Uniform on the unit sphere; density 1/(4 pi).
[[nodiscard]] UnitVector3 sample_sphere(double u, double v) noexcept;

/// Uniform over a planar convex polygon; density 1/area. A parallelogram is sheared from the
/// unit square, anything else is a fan of triangles of which `u` chooses one by area.
[[nodiscard]] Point3
sample_polygon(std::span<const Point3> vertices, double u, double v) noexcept;

/// The same for a fan of triangles whose areas are known.
/// @param running  sum of the areas up to and including each triangle, m2
[[nodiscard]] Point3 sample_fan(std::span<const Point3> vertices,
                                std::span<const double> running,
                                double u,
                                double v) noexcept;

/// Rectangle seen from a point, uniform in solid angle (METHODS "Spherical rectangle").
/// Accurate from about 1e-5 sr; below that, and for a point in the rectangle's own plane, whose
/// solid angle is given as 0, sample by area.
class SphericalRectangle {
public:
    /// @param corner, edge_u, edge_v  the rectangle; edges perpendicular
    SphericalRectangle(const Point3& corner,
                       const Vector3& edge_u,
                       const Vector3& edge_v,
                       const Point3& seen_from) noexcept;

    [[nodiscard]] double solid_angle() const noexcept { return omega_; }

    [[nodiscard]] Point3 sample(double u, double v) const noexcept; ///< density 1/solid_angle()

private:
    Point3 origin_;
    Vector3 ex_, ey_, ez_;
    double x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0, z0_ = 0;
    double b0_ = 0, b1_ = 0, cos_k_ = 0, sin_k_ = 0, omega_ = 0;
};

/// Spherical triangle with unit vertices, uniform in solid angle (METHODS "Spherical
/// triangle"). Either sense of rotation; three vertices on one great circle enclose nothing.
/// Accurate from about 1e-5 sr; sample smaller ones by area.
class SphericalTriangle {
public:
    SphericalTriangle(const UnitVector3& a,
                      const UnitVector3& b,
                      const UnitVector3& c) noexcept;

    [[nodiscard]] double solid_angle() const noexcept { return area_; }

    [[nodiscard]] UnitVector3 sample(double u,
                                     double v) const noexcept; ///< density 1/solid_angle()

private:
    Vector3 a_, b_, c_;
    double alpha_ = 0, cos_c_ = 0, area_ = 0;
};

/// Solid angle of a planar convex polygon seen from a point, sr, always >= 0; 0 from a point in
/// its plane. Triangles by A. van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983).
[[nodiscard]] double solid_angle(std::span<const Point3> vertices,
                                 const Point3& seen_from) noexcept;

/// Index drawn with probability weight/sum by inverting the running sum, and the number
/// stretched from the chosen interval to [0,1). @pre cumulative is non-decreasing and ends > 0
struct DiscreteSample {
    std::size_t index = 0;
    double stretched = 0.0;
};

/// An entry of weight 0 is never drawn.
[[nodiscard]] DiscreteSample sample_cumulative(std::span<const double> cumulative,
                                               double u) noexcept;

/// A running sum that is drawn from often. It knows for as many even steps of u as it has
/// entries (or more) where the search begins and ends; the draws are those of
/// sample_cumulative.
class CumulativeTable {
public:
    CumulativeTable() = default;
    explicit CumulativeTable(std::vector<double> sums);

    [[nodiscard]] DiscreteSample sample(double u) const noexcept;

private:
    std::vector<double> sums_;
    std::vector<std::uint32_t> start_; ///< entry drawn by u = k/(size - 1)
};

} // namespace isolux
