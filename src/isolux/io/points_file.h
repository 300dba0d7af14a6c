#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/base/vec.h"

namespace isolux {

/// A measurement point and the way it faces.
struct DirectedPoint {
    Point3 point;
    UnitVector3 normal; ///< straight up unless the line says otherwise
};

struct NoPoint {}; ///< an empty line or a comment

/// One line of a points file: `x y z` or `x y z nx ny nz`, blanks, tabs, commas or semicolons
/// between the numbers, `#` starts a comment. Metres. The message has no place yet.
[[nodiscard]] std::variant<DirectedPoint, NoPoint, Message>
parse_point_line(std::string_view line);

/// A whole points file.
/// @throws InputError  every wrong line as `source:line: ...` (the first hundred), or no point
/// at all
[[nodiscard]] std::vector<DirectedPoint> parse_points(std::string_view text,
                                                      std::string_view source);

} // namespace isolux
