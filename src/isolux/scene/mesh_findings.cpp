#include "isolux/scene/mesh_findings.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "isolux/scene/triangulate.h"

namespace isolux {
namespace {

using Index = std::uint32_t;
using Face = std::vector<Index>;

/// Disjoint sets of indices, joined pair by pair.
class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), Index{0});
    }

    Index find(Index i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    void join(Index a, Index b) { parent_[find(a)] = find(b); }

private:
    std::vector<Index> parent_;
};

/// An edge between two points and the faces that use it, from the lower index to the higher and
/// back.
struct Edge {
    Index a = 0;
    Index b = 0;
    int there = 0;
    int back = 0;

    [[nodiscard]] bool is_open() const noexcept { return there + back == 1; }

    [[nodiscard]] bool is_crowded() const noexcept { return there + back > 2; }

    [[nodiscard]] bool is_turned() const noexcept { return there + back == 2 && there != back; }
};

std::vector<Edge> collect_edges(std::span<const Face> faces) {
    std::vector<Edge> uses;
    for (const Face& face : faces)
        for (std::size_t i = 0; i < face.size(); ++i) {
            const Index a = face[i], b = face[(i + 1) % face.size()];
            uses.push_back({std::min(a, b), std::max(a, b), a<b, a> b});
        }
    std::ranges::sort(uses, [](const Edge& p, const Edge& q) {
        return std::pair(p.a, p.b) < std::pair(q.a, q.b);
    });
    std::vector<Edge> edges;
    for (const Edge& use : uses) {
        if (edges.empty() || edges.back().a != use.a || edges.back().b != use.b)
            edges.push_back({use.a, use.b, 0, 0});
        edges.back().there += use.there;
        edges.back().back += use.back;
    }
    return edges;
}

double area_of(std::span<const Point3> points, const Face& face) {
    std::vector<Point3> corners;
    for (const Index i : face)
        corners.push_back(points[i]);
    return 0.5 * length(twice_vector_area(corners));
}

class Inspection {
public:
    Inspection(std::span<const Point3> points, std::span<const Face> faces)
        : points_(points), faces_(faces), edges_(collect_edges(faces)) {}

    std::vector<MeshFinding> run() {
        find_degenerate_faces();
        find_duplicate_faces();
        find_chains(&Edge::is_open,
                    MeshFinding::Kind::open_edge,
                    "open border, {} long in {} edges (the surface does not close)");
        find_chains(&Edge::is_crowded,
                    MeshFinding::Kind::non_manifold_edge,
                    "more than two faces meet along {} in {} edges");
        find_chains(&Edge::is_turned,
                    MeshFinding::Kind::non_manifold_edge,
                    "neighbouring faces are wound against each other along {} in {} edges "
                    "(their fronts and backs do not match)");
        find_inside_out_pieces();
        return std::move(findings_);
    }

private:
    void find_degenerate_faces();
    void find_duplicate_faces();
    void find_chains(bool (Edge::*is_odd)() const noexcept,
                     MeshFinding::Kind kind,
                     const char* text);
    void find_inside_out_pieces();

    std::span<const Point3> points_;
    std::span<const Face> faces_;
    std::vector<Edge> edges_;
    std::vector<MeshFinding> findings_;
};

void Inspection::find_degenerate_faces() {
    // A height below 1e-12 of the longest side is nothing but rounding.
    for (const Face& face : faces_) {
        double longest = 0.0;
        for (std::size_t i = 0; i < face.size(); ++i)
            longest = std::max(
                longest, distance(points_[face[i]], points_[face[(i + 1) % face.size()]]));
        if (area_of(points_, face) <= 1e-12 * longest * longest)
            findings_.push_back({MeshFinding::Kind::degenerate,
                                 points_[face[0]],
                                 "a face without area (its corners lie on one line)"});
    }
}

void Inspection::find_duplicate_faces() {
    std::map<Face, int> seen;
    for (const Face& face : faces_) {
        Face key = face;
        std::ranges::sort(key);
        if (++seen[key] == 2)
            findings_.push_back({MeshFinding::Kind::duplicate_face,
                                 points_[face[0]],
                                 "two faces share all their corners (one hides the other)"});
    }
}

/// One finding for every connected run of odd edges, at its first corner.
void Inspection::find_chains(bool (Edge::*is_odd)() const noexcept,
                             MeshFinding::Kind kind,
                             const char* text) {
    struct Chain {
        Index start = 0;
        double length = 0.0;
        int edges = 0;
    };

    Groups groups(points_.size());
    for (const Edge& e : edges_)
        if ((e.*is_odd)())
            groups.join(e.a, e.b);
    std::map<Index, Chain> chains;
    for (const Edge& e : edges_)
        if ((e.*is_odd)()) {
            Chain& chain = chains[groups.find(e.a)];
            if (chain.edges++ == 0)
                chain.start = e.a;
            chain.length += distance(points_[e.a], points_[e.b]);
        }
    for (const auto& [group, chain] : chains)
        findings_.push_back({kind,
                             points_[chain.start],
                             fmt::format(fmt::runtime(text),
                                         fmt::format("{:.4g} m", chain.length),
                                         chain.edges)});
}

void Inspection::find_inside_out_pieces() {
    Groups groups(points_.size());
    for (const Edge& e : edges_)
        groups.join(e.a, e.b);
    std::map<Index, double> volume; // six times the volume of each closed piece
    for (const Face& face : faces_)
        volume[groups.find(face[0])] = 0.0;
    for (const Edge& e : edges_)
        if (e.there != 1 || e.back != 1)
            volume.erase(groups.find(e.a));
    for (const Face& face : faces_) {
        const Index piece = groups.find(face[0]);
        const auto found = volume.find(piece);
        if (found == volume.end())
            continue;
        const Point3& origin = points_[piece]; // near by, so that far meshes lose no digits
        const Vector3 p = points_[face[0]] - origin;
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
            found->second +=
                dot(p, cross(points_[face[i]] - origin, points_[face[i + 1]] - origin));
    }
    for (const auto& [piece, six_volumes] : volume)
        if (six_volumes < 0.0)
            findings_.push_back(
                {MeshFinding::Kind::inside_out,
                 points_[piece],
                 fmt::format("a closed surface of {:.4g} m3 is turned inside out (its faces "
                             "are wound clockwise seen from outside)",
                             -six_volumes / 6.0)});
}

} // namespace

std::vector<MeshFinding> find_oddities(std::span<const Point3> points,
                                       std::span<const Face> faces) {
    return Inspection(points, faces).run();
}

} // namespace isolux
