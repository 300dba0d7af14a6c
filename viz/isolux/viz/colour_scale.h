#pragma once

#include <span>
#include <vector>

#include "isolux/viz/drawing.h"

namespace isolux {

/// Isolux values for a field between `minimum` and `maximum` (lx, both >= 0), ascending, all
/// strictly between the two, 6 to 12 of them.
///
/// First choice is the photometric series 1 1.5 2 3 5 7.5 (times powers of ten); where it
/// gives too many, 1 2 5 and then whole decades; too few, equal steps of 1, 2, 2.5 or 5 times a
/// power of ten. Steps finer than `smallest_step` are not drawn (lines closer than the doubt of
/// the values would show noise), so that fewer, even no, breaks may come back.
[[nodiscard]] std::vector<double>
choose_breaks(double minimum, double maximum, double smallest_step);

/// Colour of each of `bands` bands, dark to light. Samples of a scale that is perceptually
/// uniform, monotonic in lightness (it survives grey print) and safe for colour-blind readers:
/// "viridis" by van der Walt and Smith, 2015 (released as CC0), lightened so that dark text
/// can be read on every band.
[[nodiscard]] std::vector<Colour> band_colours(std::size_t bands);

/// Contrast ratio of two colours, 1..21 (W3C, WCAG 2.1, "contrast ratio").
[[nodiscard]] double contrast_ratio(const Colour& a, const Colour& b) noexcept;

/// Illuminance for people: three digits that count, never an exponent: 0.42, 7.5, 48.3, 512,
/// 12300.
[[nodiscard]] std::string format_lux(double value);

/// A break or a step, exactly: 7.5, 100, 0.05.
[[nodiscard]] std::string format_break(double value);

} // namespace isolux
