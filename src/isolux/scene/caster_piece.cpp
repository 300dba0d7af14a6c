#include "isolux/scene/caster_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace isolux {
namespace {

bool boxes_overlap(const Piece& p, const Piece& q, double reach) noexcept {
    const auto apart =
        [reach](double a0, double a1, double a2, double b0, double b1, double b2) {
            return std::max({a0, a1, a2}) + reach < std::min({b0, b1, b2})
                   || std::max({b0, b1, b2}) + reach < std::min({a0, a1, a2});
        };
    const Vector3 p1 = p.a + p.ab, p2 = p.a + p.ac, q1 = q.a + q.ab, q2 = q.a + q.ac;
    return !apart(p.a.x, p1.x, p2.x, q.a.x, q1.x, q2.x)
           && !apart(p.a.y, p1.y, p2.y, q.a.y, q1.y, q2.y)
           && !apart(p.a.z, p1.z, p2.z, q.a.z, q1.z, q2.z);
}

} // namespace

Piece make_piece(const CasterTriangle& t, TriangleId id, const Point3& centre) {
    const Vector3 ab = t.corner[1] - t.corner[0];
    const Vector3 ac = t.corner[2] - t.corner[0];
    return {t.corner[0] - centre,
            ab,
            ac,
            UnitVector3(cross(ab, ac)),
            id,
            t.is_shell && !t.is_pane,
            {t.refractive_index, t.internal_transmittance}};
}

bool is_on(const Piece& piece, const Vector3& p, double reach) noexcept {
    const Vector3 ap = p - piece.a;
    if (std::abs(dot(piece.normal, ap)) > reach)
        return false;
    const Vector3 corner[] = {piece.a, piece.a + piece.ab, piece.a + piece.ac};
    for (int i = 0; i < 3; ++i) {
        const Vector3 edge = corner[(i + 1) % 3] - corner[i];
        const double outside = -dot(cross(piece.normal, edge), p - corner[i]);
        if (outside > reach * length(edge))
            return false;
    }
    return true;
}

std::vector<std::vector<std::uint32_t>> find_twins(const std::vector<Piece>& pieces,
                                                   double reach) {
    constexpr double parallel =
        1e-4; // rad; wider is no longer one plane over the size of a room
    std::vector<std::vector<std::uint32_t>> twins(pieces.size());
    std::vector<std::pair<double, std::uint32_t>> by_plane; // distance of the plane, piece
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
        if (pieces[i].is_shell)
            by_plane.emplace_back(std::abs(dot(pieces[i].normal, pieces[i].a)), i);
    std::sort(by_plane.begin(), by_plane.end());
    for (std::size_t i = 0; i < by_plane.size(); ++i)
        for (std::size_t j = i + 1;
             j < by_plane.size() && by_plane[j].first - by_plane[i].first <= 2.0 * reach;
             ++j) {
            const std::uint32_t pi = by_plane[i].second, qi = by_plane[j].second;
            const Piece &p = pieces[pi], &q = pieces[qi];
            if (length(Vector3(p.normal) + Vector3(q.normal)) < parallel
                && std::abs(dot(p.normal, q.a - p.a)) <= 2.0 * reach
                && boxes_overlap(p, q, reach)) {
                twins[pi].push_back(qi);
                twins[qi].push_back(pi);
            }
        }
    return twins;
}

double distance_to(const Piece& piece, const Vector3& p) noexcept {
    constexpr double rounding = 1e-9; // m, of the foot of the perpendicular
    const double height = dot(piece.normal, p - piece.a);
    if (is_on(piece, p - height * Vector3(piece.normal), rounding))
        return std::abs(height);
    const Vector3 corner[] = {piece.a, piece.a + piece.ab, piece.a + piece.ac};
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const Vector3 edge = corner[(i + 1) % 3] - corner[i];
        const double along =
            length_squared(edge) > 0.0 ? dot(p - corner[i], edge) / length_squared(edge) : 0.0;
        least = std::min(least, length(p - (corner[i] + std::clamp(along, 0.0, 1.0) * edge)));
    }
    return least;
}

bool continues(const Piece& p, const Piece& q) noexcept {
    constexpr double cos_20_degrees = 0.9397;
    if (std::abs(dot(p.normal, q.normal)) < cos_20_degrees)
        return false;
    const double size = std::max(length(p.ab), length(p.ac)) + length(q.a - p.a);
    return std::abs(dot(p.normal, q.a - p.a)) <= 0.35 * length(q.a - p.a) + 1e-9 * size
           && std::abs(dot(q.normal, p.a - q.a)) <= 0.35 * length(q.a - p.a) + 1e-9 * size;
}

PaneBox::PaneBox(std::span<const Piece> panes) {
    constexpr double slack = 1e-3; // m; far above what a float loses in a room
    constexpr double float_step = 1e-5;
    for (const Piece& piece : panes)
        for (const Vector3& p : {piece.a, piece.a + piece.ab, piece.a + piece.ac}) {
            const double s =
                slack + float_step * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            lower = {std::min(lower.x, p.x - s),
                     std::min(lower.y, p.y - s),
                     std::min(lower.z, p.z - s)};
            upper = {std::max(upper.x, p.x + s),
                     std::max(upper.y, p.y + s),
                     std::max(upper.z, p.z + s)};
        }
}

} // namespace isolux
