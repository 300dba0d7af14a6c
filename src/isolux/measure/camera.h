#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "isolux/base/angle.h"
#include "isolux/base/receiver.h"
#include "isolux/base/vec.h"

/// Eyes of the calculation: which way a place in a picture looks. No random numbers, no scene.
namespace isolux {

/// How directions become places in the picture. r is the distance from the picture's centre,
/// theta the angle from the axis, METHODS eq. (83).
enum class Projection {
    perspective,  ///< r ~ tan(theta): straight lines stay straight
    orthographic, ///< parallel rays: a plan, an elevation
    equidistant,  ///< fisheye, r ~ theta
    equal_area,   ///< fisheye, r ~ 2 sin(theta/2): areas are solid angles
    stereographic ///< fisheye, r ~ 2 tan(theta/2): small circles stay circles
};

/// A camera, and the picture it makes.
struct Camera {
    Projection projection = Projection::perspective;
    Point3 position;
    Point3 target;             ///< != position
    Vector3 up{0.0, 0.0, 1.0}; ///< need not be at right angles to the axis; along it: +y
    /// Across the picture's width; fisheye: across the circle, which touches the shorter side.
    Angle field_of_view = degrees(60.0);
    double width = 0.0;          ///< m across the picture, orthographic only
    double lens_radius = 0.0;    ///< m; 0: a pinhole. Perspective only
    double focus_distance = 0.0; ///< m along the axis; 0: the distance to the target
    std::size_t columns = 640;
    std::size_t rows = 400;
};

/// A picture that a project asks for.
struct View {
    std::string name;
    Camera camera;
};

inline constexpr std::size_t most_pixels_a_side = 16384;

/// The rays of a camera, its frame worked out once.
class CameraRays {
public:
    explicit CameraRays(const Camera& camera) noexcept;

    /// The ray through a place in the picture: x from 0 (left) to columns, y from 0 (top) to
    /// rows; (0.5, 0.5) is the centre of the first pixel. `lens_u`, `lens_v` in [0, 1) choose a
    /// place on the lens, uniformly; a pinhole takes no notice. Nothing outside a fisheye's
    /// circle. METHODS eq. (83), (84).
    [[nodiscard]] std::optional<SightLine>
    sight_line(double x, double y, double lens_u = 0.5, double lens_v = 0.5) const noexcept;

    /// Distance along the axis, m, that a thin lens shows sharp.
    [[nodiscard]] double focus_distance() const noexcept { return focus_; }

    [[nodiscard]] bool has_lens() const noexcept { return lens_radius_ > 0.0; }

    /// Pixels by which a place at distance `depth` along the axis moves when the eye moves by
    /// the lens's radius; negative behind the focus. 0 for a pinhole. METHODS eq. (85).
    [[nodiscard]] double lens_shift(double depth) const noexcept;

    /// Distance along the axis, m.
    [[nodiscard]] double depth_of(const Point3& p) const noexcept {
        return dot(forward_, p - origin_);
    }

    [[nodiscard]] const UnitVector3& forward() const noexcept { return forward_; }

private:
    Projection projection_;
    Point3 origin_;
    UnitVector3 forward_, right_, up_;
    double centre_x_, centre_y_; ///< pixels
    double scale_;               ///< picture units for a pixel; see the source
    double limit_ = 0.0;         ///< fisheye: largest theta, radians
    double lens_radius_, focus_;
};

} // namespace isolux
