#pragma once

#include "isolux/calc/plan.h"
#include "isolux/viz/map_page.h"

namespace isolux {

enum class Direction { tick, arrow };

/// How one luminaire is drawn.
struct LuminaireStyle {
    Stroke outline{ink::black, 0.28, 0.0};
    std::optional<Colour> fill;
    Direction c0 = Direction::tick;
};

/// Outlines of things seen from above, lines only.
void draw_lines(MapPage& page, const std::vector<PlanOutline>& things, const Stroke& stroke);

/// What things cover, painted without seams between their faces.
void draw_faces(MapPage& page, const std::vector<PlanOutline>& things, const Colour& fill);

/// Body to scale with a mark towards C0; a point-like or tiny one becomes a crossed circle; an
/// inclined one a dashed line the way it looks.
void draw_luminaire(MapPage& page, const PlanLuminaire& luminaire, const LuminaireStyle& style);

[[nodiscard]] Polyline circle(const Point2& centre, double radius);

[[nodiscard]] LegendEntry
luminaire_entry(const LuminaireStyle& style, bool is_point, std::string text);
[[nodiscard]] LegendEntry line_entry(const Stroke& stroke, std::string text);
[[nodiscard]] LegendEntry
area_entry(const Colour& fill, const Stroke& stroke, std::string text);

} // namespace isolux
