#include "isolux/transport/clear_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isolux {

namespace {

constexpr std::size_t leaf_size = 4;

/// Corners of a polygon that are looked at; rounder ones are left to the rays.
constexpr std::size_t most_corners = 40;

/// Deep enough for 2^60 triangles halved at every level.
constexpr std::size_t deepest = 64;

/// Points p with normal . p > offset lie inside.
struct Plane {
    Vector3 normal;
    double offset = 0.0;

    [[nodiscard]] double above(const Point3& p) const noexcept {
        return dot(normal, p - Point3{}) - offset;
    }
};

class Pyramid {
public:
    Pyramid(const Point3& apex, std::span<const Point3> polygon) noexcept
        : apex_(apex), polygon_(polygon) {
        // Area vector, a normal that survives corners on one line.
        Vector3 normal;
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
            normal = normal + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
        const double height = dot(normal, apex - polygon[0]);
        is_flat_ = !(std::abs(height) > 1e-12 * length(normal));
        if (is_flat_)
            return;
        const Vector3 up = height > 0.0 ? normal : -normal;
        add(up, polygon[0]);
        const double sense = height > 0.0 ? -1.0 : 1.0;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Point3& a = polygon[i];
            const Point3& b = polygon[(i + 1) % polygon.size()];
            add(sense * cross(a - apex, b - apex), apex);
        }
        lower_ = upper_ = apex;
        for (const Point3& p : polygon) {
            lower_ = {
                std::min(lower_.x, p.x), std::min(lower_.y, p.y), std::min(lower_.z, p.z)};
            upper_ = {
                std::max(upper_.x, p.x), std::max(upper_.y, p.y), std::max(upper_.z, p.z)};
        }
    }

    [[nodiscard]] bool is_flat() const noexcept { return is_flat_; }

    [[nodiscard]] bool misses_box(const Point3& middle, const Vector3& half) const noexcept {
        if (middle.x - half.x > upper_.x || middle.x + half.x < lower_.x
            || middle.y - half.y > upper_.y || middle.y + half.y < lower_.y
            || middle.z - half.z > upper_.z || middle.z + half.z < lower_.z)
            return true;
        for (std::size_t i = 0; i < planes_; ++i) {
            const Vector3& n = plane_[i].normal;
            const double most =
                std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
            if (plane_[i].above(middle) + most < 0.0)
                return true;
        }
        return false;
    }

    [[nodiscard]] bool misses(const std::array<Point3, 3>& t) const noexcept {
        for (std::size_t i = 0; i < planes_; ++i)
            if (plane_[i].above(t[0]) <= 0.0 && plane_[i].above(t[1]) <= 0.0
                && plane_[i].above(t[2]) <= 0.0)
                return true;
        // The pyramid on one side of the triangle's plane.
        const Vector3 n = cross(t[1] - t[0], t[2] - t[0]);
        const double first = dot(n, apex_ - t[0]);
        return std::all_of(polygon_.begin(), polygon_.end(), [&](const Point3& p) {
            return first > 0.0 ? dot(n, p - t[0]) >= 0.0 : dot(n, p - t[0]) <= 0.0;
        });
    }

private:
    void add(const Vector3& normal, const Point3& on) noexcept {
        plane_[planes_++] = {normal, dot(normal, on - Point3{})};
    }

    Point3 apex_;
    std::span<const Point3> polygon_;
    std::array<Plane, most_corners + 1> plane_;
    std::size_t planes_ = 0;
    Point3 lower_;
    Point3 upper_;
    bool is_flat_ = false;
};

} // namespace

ClearView::ClearView(const Scene& scene) {
    triangles_.reserve(scene.triangles.size());
    for (const SceneTriangle& t : scene.triangles)
        triangles_.push_back(t.corner);
    if (!triangles_.empty())
        build(0, triangles_.size());
}

void ClearView::build(std::size_t first, std::size_t last) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Point3 lower{inf, inf, inf};
    Point3 upper{-inf, -inf, -inf};
    for (std::size_t i = first; i < last; ++i)
        for (const Point3& p : triangles_[i]) {
            lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
            upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
        }
    const Vector3 half = 0.5 * (upper - lower);
    const std::size_t node = nodes_.size();
    nodes_.push_back({midpoint(lower, upper), half, 0, 0});
    if (last - first <= leaf_size) {
        nodes_[node].first = static_cast<std::uint32_t>(first);
        nodes_[node].count = static_cast<std::uint32_t>(last - first);
        return;
    }
    const auto key = [&half](const Triangle& t) {
        if (half.x >= half.y && half.x >= half.z)
            return t[0].x + t[1].x + t[2].x;
        if (half.y >= half.z)
            return t[0].y + t[1].y + t[2].y;
        return t[0].z + t[1].z + t[2].z;
    };
    const std::size_t middle = (first + last) / 2;
    const auto at = [this](std::size_t i) {
        return triangles_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(first),
                     at(middle),
                     at(last),
                     [&](const Triangle& a, const Triangle& b) { return key(a) < key(b); });
    build(first, middle);
    nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
    build(middle, last);
}

bool ClearView::is_clear(const Point3& apex, std::span<const Point3> polygon) const noexcept {
    if (polygon.size() < 3 || polygon.size() > most_corners)
        return false;
    const Pyramid pyramid(apex, polygon);
    if (pyramid.is_flat())
        return false;
    if (nodes_.empty())
        return true;
    std::array<std::uint32_t, deepest> waiting;
    std::size_t n = 0;
    waiting[n++] = 0;
    while (n > 0) {
        const std::uint32_t index = waiting[--n];
        const Node& node = nodes_[index];
        if (pyramid.misses_box(node.middle, node.half))
            continue;
        if (node.count == 0) {
            waiting[n++] = node.first;
            waiting[n++] = index + 1;
            continue;
        }
        for (std::uint32_t i = 0; i < node.count; ++i)
            if (!pyramid.misses(triangles_[node.first + i]))
                return false;
    }
    return true;
}

} // namespace isolux
