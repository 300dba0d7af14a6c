#include "isolux/scene/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace isolux {
namespace {

double cross(const Point2& o, const Point2& a, const Point2& b) noexcept {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

double distance(const Point2& a, const Point2& b) noexcept {
    return std::hypot(a.x - b.x, a.y - b.y);
}

/// True if the open segments cross each other; touching ends do not count.
bool segments_cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
    const double c1 = cross(a, b, c), c2 = cross(a, b, d);
    const double d1 = cross(c, d, a), d2 = cross(c, d, b);
    return c1 * c2 < 0.0 && d1 * d2 < 0.0;
}

class EarCutter {
public:
    explicit EarCutter(const std::vector<std::vector<Point2>>& rings);

    [[nodiscard]] std::vector<TriangleCorners> cut();

private:
    using Index = std::uint32_t;

    void join(const std::vector<Index>& hole);
    [[nodiscard]] bool is_free(Index a, Index b) const;
    [[nodiscard]] bool opens_towards(std::size_t i, const Point2& p) const;
    [[nodiscard]] bool is_ear(std::size_t i, bool strict) const;
    void cut_at(std::size_t i);

    std::vector<Point2> points_;
    std::vector<std::vector<Index>> rings_;
    std::vector<Index> outline_; ///< what is left, bridges included
    std::vector<TriangleCorners> triangles_;
    double tiny_ = 0.0; ///< m; points closer than this are one
};

EarCutter::EarCutter(const std::vector<std::vector<Point2>>& rings) {
    double extent = 0.0;
    for (const auto& ring : rings) {
        auto& indices = rings_.emplace_back();
        for (const Point2& p : ring) {
            indices.push_back(static_cast<Index>(points_.size()));
            points_.push_back(p);
            extent =
                std::max({extent, std::abs(p.x - points_[0].x), std::abs(p.y - points_[0].y)});
        }
    }
    tiny_ = 1e-12 * extent;
}

/// True if nothing of any ring lies across the way from a to b.
bool EarCutter::is_free(Index a, Index b) const {
    const double reach = distance(points_[a], points_[b]);
    const auto blocks = [&](const std::vector<Index>& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Point2 &p = points_[ring[i]], &q = points_[ring[(i + 1) % ring.size()]];
            if (segments_cross(points_[a], points_[b], p, q))
                return true;
            // A corner on the way: within `tiny` of the segment and between its ends.
            const double along = ((p.x - points_[a].x) * (points_[b].x - points_[a].x)
                                  + (p.y - points_[a].y) * (points_[b].y - points_[a].y))
                                 / reach;
            if (std::abs(cross(points_[a], points_[b], p)) <= tiny_ * reach && along > tiny_
                && along < reach - tiny_)
                return true;
        }
        return false;
    };
    return std::ranges::none_of(rings_, blocks) && !blocks(outline_);
}

/// True if the way from corner i to `p` starts inside the outline. Corners that carry a bridge
/// appear several times in it, each time with another wedge.
bool EarCutter::opens_towards(std::size_t i, const Point2& p) const {
    const std::size_t n = outline_.size();
    const Point2& before = points_[outline_[(i + n - 1) % n]];
    const Point2& here = points_[outline_[i]];
    const Point2& after = points_[outline_[(i + 1) % n]];
    const bool left_of_in = cross(before, here, p) > 0.0;
    const bool left_of_out = cross(here, after, p) > 0.0;
    return cross(before, here, after) > 0.0 ? left_of_in && left_of_out
                                            : left_of_in || left_of_out;
}

/// Joins a hole to the outline by the shortest way that crosses nothing.
void EarCutter::join(const std::vector<Index>& hole) {
    struct Bridge {
        double length;
        std::size_t at_outline;
        std::size_t at_hole;
    };

    std::vector<Bridge> bridges;
    for (std::size_t i = 0; i < outline_.size(); ++i)
        for (std::size_t j = 0; j < hole.size(); ++j)
            bridges.push_back({distance(points_[outline_[i]], points_[hole[j]]), i, j});
    std::ranges::sort(bridges, {}, &Bridge::length);
    const auto found = std::ranges::find_if(bridges, [&](const Bridge& b) {
        return opens_towards(b.at_outline, points_[hole[b.at_hole]])
               && is_free(outline_[b.at_outline], hole[b.at_hole]);
    });
    if (found == bridges.end())
        return; // the hole is no hole; leave the outline as it is
    std::vector<Index> tour;
    for (std::size_t j = 0; j <= hole.size(); ++j)
        tour.push_back(hole[(found->at_hole + j) % hole.size()]);
    tour.push_back(outline_[found->at_outline]);
    outline_.insert(outline_.begin() + static_cast<std::ptrdiff_t>(found->at_outline) + 1,
                    tour.begin(),
                    tour.end());
}

/// An ear: a convex corner whose triangle holds no other corner. Not strict: flat corners and
/// corners of others on the triangle's border are let through.
bool EarCutter::is_ear(std::size_t i, bool strict) const {
    const std::size_t n = outline_.size();
    const Point2& a = points_[outline_[(i + n - 1) % n]];
    const Point2& b = points_[outline_[i]];
    const Point2& c = points_[outline_[(i + 1) % n]];
    const double ab = distance(a, b), bc = distance(b, c), ca = distance(c, a);
    const double area = cross(a, b, c);
    if (area <= 1e-9 * ab * bc && (strict || area < 0.0))
        return false;
    const double margin = strict ? -tiny_ : tiny_;
    return std::ranges::none_of(outline_, [&](Index other) {
        const Point2& p = points_[other];
        if (distance(p, a) <= tiny_ || distance(p, b) <= tiny_ || distance(p, c) <= tiny_)
            return false;
        return cross(a, b, p) >= margin * ab && cross(b, c, p) >= margin * bc
               && cross(c, a, p) >= margin * ca;
    });
}

void EarCutter::cut_at(std::size_t i) {
    const std::size_t n = outline_.size();
    triangles_.push_back({outline_[(i + n - 1) % n], outline_[i], outline_[(i + 1) % n]});
    outline_.erase(outline_.begin() + static_cast<std::ptrdiff_t>(i));
}

std::vector<TriangleCorners> EarCutter::cut() {
    if (rings_.empty())
        return {};
    outline_ = rings_[0];
    for (std::size_t i = 1; i < rings_.size(); ++i)
        join(rings_[i]);
    std::size_t at = 0;
    while (outline_.size() > 3) {
        const auto next_ear = [&](bool strict) {
            for (std::size_t step = 0; step < outline_.size(); ++step)
                if (is_ear((at + step) % outline_.size(), strict)) {
                    at = (at + step) % outline_.size();
                    return true;
                }
            return false;
        };
        if (!next_ear(true) && !next_ear(false))
            at = 0; // not a simple polygon: any cut ends the work
        cut_at(at);
        at = (at + 1) % outline_.size(); // go round, so that fans do not grow
    }
    if (outline_.size() == 3)
        cut_at(1);
    return std::move(triangles_);
}

} // namespace

std::vector<TriangleCorners> triangulate(const std::vector<std::vector<Point2>>& rings) {
    return EarCutter(rings).cut();
}

std::vector<TriangleCorners> triangulate(std::span<const Point3> polygon) {
    if (polygon.size() == 3)
        return {{0, 1, 2}};
    const Basis plane = make_basis(UnitVector3(twice_vector_area(polygon)));
    std::vector<Point2> flat;
    for (const Point3& p : polygon) {
        const Vector3 local = plane.to_local(p - polygon[0]);
        flat.push_back({local.x, local.y});
    }
    return triangulate(std::vector<std::vector<Point2>>{flat});
}

Vector3 twice_vector_area(std::span<const Point3> polygon) noexcept {
    Vector3 sum;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum = sum + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return sum;
}

} // namespace isolux
