#include "isolux/viz/drawing_parts.h"

#include <utility>

namespace isolux {

Shape make_rectangle(const Box& b) {
    Shape s;
    s.lines = {{{b.x, b.y}, {b.right(), b.y}, {b.right(), b.bottom()}, {b.x, b.bottom()}}};
    return s;
}

Shape make_line(Polyline points, const Stroke& stroke) {
    Shape s;
    s.lines = {std::move(points)};
    s.ends = Ends::open;
    s.stroke = stroke;
    return s;
}

Text make_text(
    std::string text, Point2 at, double size, Anchor anchor, Weight weight, Colour colour) {
    Text t;
    t.text = std::move(text);
    t.at = at;
    t.size = size;
    t.anchor = anchor;
    t.weight = weight;
    t.colour = colour;
    return t;
}

} // namespace isolux
