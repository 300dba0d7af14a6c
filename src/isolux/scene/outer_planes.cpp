#include "isolux/scene/outer_planes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "isolux/base/wide_vectors.h"

namespace isolux {

namespace {

/// A plane that holds less than this share of all surfaces is not worth a look at every ray.
constexpr double least_share = 0.01;

/// So much of all surfaces may lie beyond a plane, window reveals say; who lies there is seen
/// by the search tree of everything.
constexpr double most_beyond = 0.02;

constexpr std::size_t most_planes = 16;

/// So many of the largest planes are looked at.
constexpr std::size_t most_candidates = 32;

/// Nearer to a plane than this part of the step that rays keep off surfaces counts as in it.
constexpr double spare_part = 0.2;

std::array<Vector3, 3> corners_of(const Piece& p) noexcept {
    return {p.a, p.a + p.ab, p.a + p.ac};
}

double area_of(const Piece& p) noexcept { return 0.5 * length(cross(p.ab, p.ac)); }

/// A triangle's plane, its normal turned so that both sides of a wall have the same.
struct Face {
    std::array<long long, 4> key{}; ///< rounded: triangles of one plane stand together
    UnitVector3 normal;
    double offset = 0.0;
    double area = 0.0;
};

Face face_of(const Piece& piece) {
    constexpr double grid = 1e4;
    const Vector3 n = piece.normal;
    const double first = std::abs(n.x) > 1e-3 ? n.x : std::abs(n.y) > 1e-3 ? n.y : n.z;
    Face f;
    f.normal = first < 0.0 ? -piece.normal : piece.normal;
    f.offset = dot(f.normal, piece.a);
    f.area = area_of(piece);
    f.key = {std::llround(grid * f.normal.x()),
             std::llround(grid * f.normal.y()),
             std::llround(grid * f.normal.z()),
             std::llround(grid * f.offset)};
    return f;
}

/// One face for all of a plane, the largest planes first; small ones are left out.
std::vector<Face> large_planes(std::span<const Piece> pieces, double least) {
    std::vector<Face> faces;
    faces.reserve(pieces.size());
    for (const Piece& p : pieces)
        faces.push_back(face_of(p));
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
        return a.key != b.key ? a.key < b.key : a.area > b.area;
    });
    std::vector<Face> planes;
    for (const Face& f : faces)
        if (!planes.empty() && planes.back().key == f.key)
            planes.back().area += f.area;
        else
            planes.push_back(f);
    std::erase_if(planes, [least](const Face& f) { return f.area < least; });
    std::stable_sort(planes.begin(), planes.end(), [](const Face& a, const Face& b) {
        return a.area > b.area;
    });
    planes.resize(std::min(planes.size(), most_candidates));
    return planes;
}

/// How much of the surfaces has a corner beyond a plane, m2; more than `most` is not counted
/// on.
double
area_beyond(std::span<const Piece> pieces, const Vector3& normal, double limit, double most) {
    double beyond = 0.0;
    for (const Piece& p : pieces) {
        double highest = -1e300;
        for (const Vector3& c : corners_of(p))
            highest = std::max(highest, dot(normal, c));
        if (highest > limit)
            beyond += area_of(p);
        if (beyond > most)
            break;
    }
    return beyond;
}

/// How far the ends of each ray are beyond the planes, at most.
ISOLUX_WIDE_VECTORS void find_farthest(const RayPacket& rays,
                                       std::span<const OuterPlanes::Rounded> planes,
                                       float* __restrict farthest) noexcept {
    for (const OuterPlanes::Rounded& p : planes)
        for (std::size_t i = 0; i < RayPacket::width; ++i) {
            const float from =
                p.x * rays.from_x[i] + p.y * rays.from_y[i] + p.z * rays.from_z[i] - p.limit;
            const float along = p.x * rays.direction_x[i] + p.y * rays.direction_y[i]
                                + p.z * rays.direction_z[i];
            const float beyond = along > 0.0F ? from + along : from;
            farthest[i] = farthest[i] < beyond ? beyond : farthest[i];
        }
}

} // namespace

OuterPlanes::OuterPlanes(std::span<const Piece> pieces) {
    double area = 0.0;
    for (const Piece& p : pieces)
        area += area_of(p);
    double left = most_beyond * area;
    for (const Face& face : large_planes(pieces, least_share * area)) {
        if (planes_.size() == most_planes)
            break;
        const double spare = spare_part * float_offset({face.offset, 0.0, 0.0});
        for (const double sign : {1.0, -1.0}) {
            const UnitVector3 normal = sign > 0.0 ? face.normal : -face.normal;
            const double limit = sign * face.offset + spare;
            const double beyond = area_beyond(pieces, normal, limit, left);
            if (beyond > left)
                continue;
            left -= beyond;
            planes_.push_back({normal, sign * face.offset, spare});
            rounded_.push_back({static_cast<float>(normal.x()),
                                static_cast<float>(normal.y()),
                                static_cast<float>(normal.z()),
                                static_cast<float>(limit)});
            break;
        }
    }
}

bool OuterPlanes::hold(const Piece& piece) const noexcept {
    const auto corners = corners_of(piece);
    return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
        return std::all_of(corners.begin(), corners.end(), [&](const Vector3& c) {
            return std::abs(dot(plane.normal, c) - plane.offset) <= plane.spare;
        });
    });
}

bool OuterPlanes::enclose(const Vector3& p, const Vector3& q) const noexcept {
    return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
        return std::max(dot(plane.normal, p), dot(plane.normal, q))
               <= plane.offset + plane.spare;
    });
}

bool OuterPlanes::enclose(const RayPacket& rays, std::uint32_t wanted) const noexcept {
    std::array<float, RayPacket::width> farthest{};
    farthest.fill(-1.0F);
    find_farthest(rays, rounded_, farthest.data());
    std::uint32_t beyond = 0;
    for (std::size_t i = 0; i < RayPacket::width; ++i)
        beyond |= static_cast<std::uint32_t>(farthest[i] > 0.0F) << i;
    return (beyond & wanted) == 0;
}

} // namespace isolux
