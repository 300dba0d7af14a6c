#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "isolux/scene/scene.h"

namespace isolux {

/// Tells the places that no light of a room reaches: those outside every room and those inside
/// closed, opaque objects without a luminaire. Keeps what it needs of the description.
class SceneSpace {
public:
    explicit SceneSpace(const SceneDescription& description);

    /// Borders count as inside. Without rooms nothing is outside.
    [[nodiscard]] bool is_outside(const Point3& p) const noexcept;

    /// The object around the point, as index into SceneDescription::objects. A point on an
    /// object's surface (1e-6 m) is not inside; neither is one in an open or transparent
    /// object, or in one that holds a luminaire.
    [[nodiscard]] std::optional<std::size_t> object_around(const Point3& p) const noexcept;

    /// Whether some room has an opening that light passes.
    [[nodiscard]] bool has_open_wall() const noexcept;

    /// Whether a ray crosses an opening that light passes. @pre `along` has a length
    [[nodiscard]] bool looks_through_opening(const Point3& from,
                                             const Vector3& along) const noexcept;

    [[nodiscard]] const std::vector<Room>& rooms() const noexcept { return rooms_; }

private:
    /// A closed object; its triangles sorted into the cells of a grid over its plan.
    struct Solid {
        std::size_t object = 0;
        Bounds bounds;
        std::vector<std::array<Point3, 3>> triangles;
        std::size_t columns = 1; ///< and as many rows
        std::vector<std::vector<std::uint32_t>> cells;
    };

    static void sort_into_cells(Solid& solid);
    static bool is_inside(const Solid& solid, const Point3& p) noexcept;

    std::vector<Room> rooms_;
    std::vector<Solid> solids_;
};

/// `Room "hall" reaches from (0, 0, 0) to (6, 4, 3), room "store" ...`, the first three.
[[nodiscard]] std::string extents_in_words(const std::vector<Room>& rooms);

} // namespace isolux
