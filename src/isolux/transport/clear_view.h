#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/scene/scene.h"

namespace isolux {

/// Proves, where it can, that nothing stands between a place and a luminous opening: then rays
/// are not needed. A search tree over the scene's triangles, panes included, is asked whether
/// any meets the pyramid over the opening (METHODS "Whole visibility").
class ClearView {
public:
    explicit ClearView(const Scene& scene);

    /// Whether the open pyramid from `apex` over a convex polygon is empty. True is certain up
    /// to rounding; false means that a triangle may touch it.
    /// @param polygon  planar; both it and the apex moved off their surfaces, like ends of rays
    [[nodiscard]] bool is_clear(const Point3& apex,
                                std::span<const Point3> polygon) const noexcept;

private:
    struct Node {
        Point3 middle;
        Vector3 half;            ///< sides of the box
        std::uint32_t first = 0; ///< of the triangles of a leaf, else the right child
        std::uint32_t count = 0; ///< triangles of a leaf, else 0; the left child comes next
    };

    using Triangle = std::array<Point3, 3>;

    void build(std::size_t first, std::size_t last);

    std::vector<Node> nodes_;
    std::vector<Triangle> triangles_;
};

} // namespace isolux
