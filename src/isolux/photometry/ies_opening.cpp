#include "isolux/photometry/ies_opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "isolux/photometry/findings.h"

namespace isolux {

namespace {

/// Width, length and height in metres, signs as in the file.
struct Signed {
    double w = 0.0;
    double l = 0.0;
    double h = 0.0;
};

enum class Edition { e1986, e1995, e2002 };

LuminousOpening sized(OpeningShape shape, double x, double y, double z) {
    return {shape, Metre(std::abs(x)), Metre(std::abs(y)), Metre(std::abs(z))};
}

/// What every edition agrees about: nothing negative.
std::optional<LuminousOpening> plain_shape(const Signed& s) {
    if (s.w < 0 || s.l < 0 || s.h < 0)
        return std::nullopt;
    if (s.w == 0 && s.l == 0 && s.h == 0)
        return LuminousOpening{};
    if (s.w > 0 && s.l > 0 && s.h == 0)
        return sized(OpeningShape::rectangle, s.l, s.w, 0);
    if (s.h > 0 && (s.w > 0 || s.l > 0))
        return sized(OpeningShape::box, s.l, s.w, s.h);
    return std::nullopt;
}

std::optional<LuminousOpening> shape_1986(const Signed& s) {
    if (s.w >= 0 || s.l < 0 || s.h < 0)
        return std::nullopt;
    const double length = s.l == 0 ? s.w : s.l;
    if (s.h == 0)
        return sized(OpeningShape::ellipse, length, s.w, 0);
    return s.l == 0 ? sized(OpeningShape::vertical_cylinder, s.w, s.w, s.h)
                    : sized(OpeningShape::ellipsoid, s.l, s.w, s.h);
}

std::optional<LuminousOpening> shape_1995(const Signed& s) {
    const bool is_round = s.w < 0 && s.l == 0;
    const bool is_elliptic = (s.w < 0 && s.l > 0) || (s.w > 0 && s.l < 0);
    if (is_round || is_elliptic) {
        const double length = is_round ? s.w : s.l;
        if (s.h == 0)
            return sized(OpeningShape::ellipse, length, s.w, 0);
        if (s.h > 0)
            return sized(OpeningShape::vertical_cylinder, length, s.w, s.h);
        if (is_elliptic || std::abs(s.w - s.h) <= 1e-6 * std::abs(s.w))
            return sized(OpeningShape::ellipsoid, length, s.w, s.h);
    }
    if (s.w == 0 && s.l > 0 && s.h < 0)
        return sized(OpeningShape::cylinder_along_x, s.l, s.h, s.h);
    if (s.w > 0 && s.l == 0 && s.h < 0)
        return sized(OpeningShape::cylinder_along_y, s.h, s.w, s.h);
    return std::nullopt;
}

std::optional<LuminousOpening> shape_2002(const Signed& s) {
    if (s.w < 0 && s.l < 0) {
        if (s.h == 0)
            return sized(OpeningShape::ellipse, s.l, s.w, 0);
        return sized(
            s.h > 0 ? OpeningShape::vertical_cylinder : OpeningShape::ellipsoid, s.l, s.w, s.h);
    }
    if (s.h >= 0)
        return std::nullopt;
    if (s.w < 0 && s.l > 0)
        return sized(OpeningShape::cylinder_along_x, s.l, s.w, s.h);
    if (s.w > 0 && s.l < 0)
        return sized(OpeningShape::cylinder_along_y, s.l, s.w, s.h);
    if (s.w < 0 && s.l == 0)
        return sized(OpeningShape::vertical_ellipse, 0, s.w, s.h);
    return std::nullopt;
}

std::optional<LuminousOpening> shape_of(Edition edition, const Signed& s) {
    switch (edition) {
    case Edition::e1986:
        return shape_1986(s);
    case Edition::e1995:
        return shape_1995(s);
    case Edition::e2002:
        return shape_2002(s);
    }
    return std::nullopt;
}

/// The file's own edition first.
std::array<Edition, 3> editions_to_try(PhotometricFormat format) {
    using enum Edition;
    switch (format) {
    case PhotometricFormat::lm63_1986:
    case PhotometricFormat::lm63_1991:
        return {e1986, e1995, e2002};
    case PhotometricFormat::lm63_1995:
        return {e1995, e2002, e1986};
    default:
        return {e2002, e1995, e1986};
    }
}

std::string describe(const IesDocument& d) {
    return to_text(d.width.value) + " " + to_text(d.length.value) + " "
           + to_text(d.height.value);
}

} // namespace

LuminousOpening make_opening(const IesDocument& d, Findings& findings) {
    constexpr double metres_per_foot = 0.3048;
    constexpr double suspicious_size = 50.0; // m
    const double unit = d.units.value == 1.0 ? metres_per_foot : 1.0;
    const Signed s{unit * d.width.value, unit * d.length.value, unit * d.height.value};
    const std::size_t line = d.width.line;
    if (std::max({std::abs(s.w), std::abs(s.l), std::abs(s.h)}) > suspicious_size)
        findings.warn(line,
                      "luminous opening " + describe(d) + (unit == 1.0 ? " metres" : " feet")
                          + " (larger than a house)",
                      "Millimetres or inches by mistake?");
    if (const auto plain = plain_shape(s))
        return *plain;
    const auto editions = editions_to_try(d.format);
    for (const Edition edition : editions)
        if (const auto shape = shape_of(edition, s)) {
            if (edition != editions.front())
                findings.warn(line,
                              "luminous opening " + describe(d) + " is not a shape code of "
                                  + to_string(d.format) + " (read as another edition's: "
                                  + to_string(shape->shape) + ")");
            return *shape;
        }
    findings.warn(line,
                  "luminous opening " + describe(d)
                      + " is no shape code of any edition (read as a box of these sizes)");
    return sized(OpeningShape::box, s.l, s.w, s.h);
}

} // namespace isolux
