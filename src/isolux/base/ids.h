#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace isolux {

/// An index that knows what it counts. There is no "-1": use std::optional.
template <class Tag> class Id {
public:
    constexpr Id() noexcept = default;

    explicit constexpr Id(std::size_t index) noexcept
        : index_(static_cast<std::uint32_t>(index)) {}

    [[nodiscard]] constexpr std::size_t index() const noexcept { return index_; }

    friend constexpr auto operator<=>(const Id&, const Id&) = default;

private:
    std::uint32_t index_ = 0;
};

using MaterialId = Id<struct MaterialTag>;
using SurfaceId = Id<struct SurfaceTag>;
using TriangleId = Id<struct TriangleTag>;
using LuminaireId = Id<struct LuminaireTag>;
using LuminaireTypeId = Id<struct LuminaireTypeTag>;

} // namespace isolux
