#pragma once

/// Share of the flux of one Lambertian rectangle that reaches another, with nothing between.
namespace isolux {

/// Two equal rectangles a by b, opposite each other, c apart (m, all > 0).
[[nodiscard]] double parallel_form_factor(double a, double b, double c) noexcept;

/// From a rectangle `edge` by `depth` to one at right angles, `edge` by `height`, which share
/// the edge (m, all > 0).
[[nodiscard]] double
perpendicular_form_factor(double edge, double depth, double height) noexcept;

} // namespace isolux
