#include "isolux/scene/luminaire_body.h"

#include <algorithm>
#include <variant>

namespace isolux {

namespace {

bool is_same(const LuminousOpening& a, const LuminousOpening& b) {
    return a.shape == b.shape && a.extent_x == b.extent_x && a.extent_y == b.extent_y
           && a.extent_z == b.extent_z;
}

std::optional<LongSide> find_long_side(const LuminousOpening& body) {
    const double x = in_metre(body.extent_x);
    const double y = in_metre(body.extent_y);
    constexpr double square = 1.05;
    if (std::max(x, y) <= square * std::min(x, y))
        return std::nullopt;
    return LongSide{y > x, std::max(x, y)};
}

} // namespace

LuminousOpening visible_body(const LuminaireType& type) {
    const auto* photometry = std::get_if<LuminairePhotometry>(&type.source);
    if (photometry == nullptr || !is_same(type.opening, photometry->opening))
        return type.opening;
    const LuminousOpening& housing = photometry->housing;
    constexpr double smallest = 1e-6; // m
    const double size = std::max(
        {in_metre(housing.extent_x), in_metre(housing.extent_y), in_metre(housing.extent_z)});
    return size > smallest ? housing : type.opening;
}

std::optional<LongSide> find_long_side(const LuminaireType& type) {
    if (const auto of_opening = find_long_side(type.opening))
        return of_opening;
    return find_long_side(visible_body(type));
}

} // namespace isolux
