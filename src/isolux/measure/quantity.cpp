#include "isolux/measure/quantity.h"

#include <array>
#include <utility>

namespace isolux {

namespace {

constexpr std::array<std::pair<IlluminanceKind, std::string_view>, 5> names{{
    {IlluminanceKind::planar, "illuminance"},
    {IlluminanceKind::cylindrical, "cylindrical illuminance"},
    {IlluminanceKind::semi_cylindrical, "semi-cylindrical illuminance"},
    {IlluminanceKind::hemispherical, "hemispherical illuminance"},
    {IlluminanceKind::mean_spherical, "mean spherical illuminance"},
}};

} // namespace

std::string_view quantity_name(IlluminanceKind kind) noexcept {
    for (const auto& [known, name] : names)
        if (known == kind)
            return name;
    return names.front().second;
}

std::optional<IlluminanceKind> find_quantity(std::string_view name) noexcept {
    for (const auto& [kind, known] : names)
        if (known == name)
            return kind;
    return std::nullopt;
}

} // namespace isolux
