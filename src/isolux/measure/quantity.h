#pragma once

#include <optional>
#include <string_view>

#include "isolux/base/receiver.h"

namespace isolux {

/// What a surface measures, in the words of EN 12665: "illuminance", "cylindrical illuminance",
/// "semi-cylindrical illuminance", "hemispherical illuminance", "mean spherical illuminance".
/// All are in lx.
[[nodiscard]] std::string_view quantity_name(IlluminanceKind kind) noexcept;

[[nodiscard]] std::optional<IlluminanceKind> find_quantity(std::string_view name) noexcept;

} // namespace isolux
