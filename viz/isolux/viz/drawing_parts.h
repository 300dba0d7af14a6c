#pragma once

#include <string>

#include "isolux/viz/drawing.h"
#include "isolux/viz/map_page.h"

/// The strokes every diagram is made of.
namespace isolux {

/// A rectangle on a page, mm.
struct Box {
    double x = 0.0;
    double y = 0.0;
    double width = 0.0;
    double height = 0.0;

    [[nodiscard]] double right() const noexcept { return x + width; }

    [[nodiscard]] double bottom() const noexcept { return y + height; }
};

[[nodiscard]] Shape make_rectangle(const Box& box);
[[nodiscard]] Shape make_line(Polyline points, const Stroke& stroke);
[[nodiscard]] Text make_text(std::string text,
                             Point2 at,
                             double size,
                             Anchor anchor = Anchor::start,
                             Weight weight = Weight::normal,
                             Colour colour = ink::black);

/// Intensities as every diagram of a page counts them.
struct IntensityScale {
    double per_candela = 1.0; ///< what one candela becomes
    std::string unit = "cd";
};

/// Strokes of the two section planes, apart in colour and in pattern.
inline constexpr Stroke c0_stroke{{0, 90, 160}, 0.6, 0.0};
inline constexpr Stroke c90_stroke{{190, 70, 0}, 0.6, 1.6};

} // namespace isolux
