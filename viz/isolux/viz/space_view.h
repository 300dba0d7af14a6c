#pragma once

#include <vector>

#include "isolux/base/vec.h"
#include "isolux/viz/drawing_parts.h"

namespace isolux {

/// A flat piece in space: a face, or a line where its ends are open.
struct SpacePiece {
    std::vector<Point3> corners;
    Colour fill;
    double opacity = 1.0; ///< of the fill
    Stroke stroke;
    Ends ends = Ends::closed;
};

/// From where things in space are looked at, in parallel projection, z up.
struct ViewAngles {
    double azimuth = -60.0;  ///< degrees from x towards y: where the eye stands
    double elevation = 22.0; ///< degrees above the horizon
};

/// Parallel projection of space on a box of a page. Pieces are painted from the farthest to the
/// nearest by their middles, so that intersecting ones should be small.
class SpaceView {
public:
    SpaceView(const ViewAngles& angles, const Box& box);

    /// Scales and moves so that all of `pieces` fill the box but for a rim in mm.
    void fit(const std::vector<SpacePiece>& pieces, double rim);

    [[nodiscard]] Point2 on_page(const Point3& p) const;

    /// How bright a face looks: Lambert's law with a lamp above the eye, about 0.6 to 1.1; the
    /// same from both sides. @pre at least three corners
    [[nodiscard]] double light_on(const std::vector<Point3>& corners) const;

    void paint(Drawing& page, std::vector<SpacePiece> pieces) const;

private:
    [[nodiscard]] Point2 flat(const Point3& p) const;
    [[nodiscard]] double depth(const SpacePiece& piece) const;

    Box box_;
    UnitVector3 to_eye_;
    UnitVector3 right_;
    UnitVector3 up_;
    Point2 centre_;
    double scale_ = 1.0; ///< mm per metre
};

/// The colour `light` times as bright.
[[nodiscard]] Colour shade(const Colour& colour, double light);

} // namespace isolux
