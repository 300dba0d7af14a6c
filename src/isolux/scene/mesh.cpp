#include "isolux/scene/mesh.h"

#include <algorithm>
#include <unordered_map>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "isolux/base/check.h"
#include "isolux/scene/mesh_findings.h"
#include "isolux/scene/triangulate.h"

namespace isolux {
namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;
using VertexHandles = std::vector<PolyMesh::VertexHandle>;
using Face = std::vector<std::uint32_t>;

Point3 from_open_mesh(const OpenMesh::Vec3d& p) noexcept { return {p[0], p[1], p[2]}; }

struct PointHash {
    std::size_t operator()(const Point3& p) const noexcept {
        const std::hash<double> hash;
        return (hash(p.x) * 31 + hash(p.y)) * 31 + hash(p.z);
    }
};

/// True if OpenMesh can join the face to what it holds already: every edge is free on this
/// side and every corner has room between its faces. (`add_face` would answer the same, but
/// print it.)
bool is_joinable(const PolyMesh& mesh, const VertexHandles& corners) {
    const std::size_t n = corners.size();
    std::vector<PolyMesh::HalfedgeHandle> edges(n);
    for (std::size_t i = 0; i < n; ++i) {
        edges[i] = mesh.find_halfedge(corners[i], corners[(i + 1) % n]);
        if (!mesh.is_boundary(corners[i])
            || (edges[i].is_valid() && !mesh.is_boundary(edges[i])))
            return false;
    }
    for (std::size_t i = 0; i < n; ++i) {
        const auto in = edges[i], out = edges[(i + 1) % n];
        if (!in.is_valid() || !out.is_valid() || mesh.next_halfedge_handle(in) == out)
            continue;
        auto around = mesh.opposite_halfedge_handle(out); // look for another gap at the corner
        do
            around = mesh.opposite_halfedge_handle(mesh.next_halfedge_handle(around));
        while (!mesh.is_boundary(around));
        if (around == in)
            return false;
    }
    return true;
}

} // namespace

struct SurfaceMesh::Implementation {
    PolyMesh mesh;
    OpenMesh::FPropHandleT<std::uint32_t> slot;
    /// Faces that cannot be joined stand on copies of their corners; this is the first copy.
    OpenMesh::VPropHandleT<PolyMesh::VertexHandle> original;
    std::vector<std::string> slots;
    std::vector<MeshFinding> collapsed; ///< faces that fell to a line or point, not held

    Implementation() {
        mesh.add_property(slot);
        mesh.add_property(original);
    }

    PolyMesh::VertexHandle add_vertex(const Point3& p) {
        const auto v = mesh.add_vertex({p.x, p.y, p.z});
        mesh.property(original, v) = v;
        return v;
    }

    void add_face(VertexHandles corners, std::uint32_t slot_of_face) {
        if (!is_joinable(mesh, corners))
            for (auto& corner : corners) {
                const OpenMesh::Vec3d place = mesh.point(corner); // add_vertex may move it
                const auto copy = mesh.add_vertex(place);
                mesh.property(original, copy) = mesh.property(original, corner);
                corner = copy;
            }
        mesh.property(slot, mesh.add_face(corners)) = slot_of_face;
    }

    /// Adds a face; one that visits a corner twice (OpenMesh cannot hold it) as triangles.
    void add_polygon(VertexHandles corners, std::uint32_t slot_of_face) {
        const VertexHandles all = corners;
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        while (corners.size() > 1 && corners.back() == corners.front())
            corners.pop_back();
        if (corners.size() < 3) {
            if (!all.empty())
                collapsed.push_back(
                    {MeshFinding::Kind::degenerate,
                     from_open_mesh(mesh.point(all[0])),
                     "a face has fewer than three different corners (left out)"});
            return;
        }
        VertexHandles sorted = corners;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) {
            add_face(std::move(corners), slot_of_face);
            return;
        }
        std::vector<Point3> places;
        for (const auto v : corners)
            places.push_back(from_open_mesh(mesh.point(v)));
        for (const auto& t : triangulate(places))
            if (corners[t[0]] != corners[t[1]] && corners[t[1]] != corners[t[2]]
                && corners[t[2]] != corners[t[0]])
                add_face({corners[t[0]], corners[t[1]], corners[t[2]]}, slot_of_face);
    }

    [[nodiscard]] std::vector<Point3> corners_of(PolyMesh::FaceHandle f) const {
        std::vector<Point3> corners;
        for (const auto v : mesh.fv_range(f))
            corners.push_back(from_open_mesh(mesh.point(v)));
        return corners;
    }
};

SurfaceMesh::SurfaceMesh() : implementation_(std::make_unique<Implementation>()) {
    implementation_->slots = {""};
}

SurfaceMesh::SurfaceMesh(std::span<const Point3> points,
                         std::span<const std::vector<std::uint32_t>> faces,
                         std::span<const std::uint32_t> slot_of_face,
                         std::vector<std::string> slots)
    : SurfaceMesh() {
    ISOLUX_EXPECT(slot_of_face.empty() || slot_of_face.size() == faces.size());
    auto& self = *implementation_;
    self.slots = std::move(slots);
    // Points at one place are one vertex: many files repeat them face by face.
    std::unordered_map<Point3, PolyMesh::VertexHandle, PointHash> vertex_at;
    const auto vertex_of = [&](const Point3& p) {
        const Point3 key{p.x + 0.0, p.y + 0.0, p.z + 0.0}; // -0 and 0 are one place
        const auto [found, is_new] = vertex_at.try_emplace(key);
        if (is_new)
            found->second = self.add_vertex(p);
        return found->second;
    };
    for (std::size_t f = 0; f < faces.size(); ++f) {
        VertexHandles corners;
        for (const std::uint32_t i : faces[f])
            corners.push_back(vertex_of(points[i]));
        self.add_polygon(corners, slot_of_face.empty() ? 0 : slot_of_face[f]);
    }
}

SurfaceMesh::~SurfaceMesh() = default;
SurfaceMesh::SurfaceMesh(SurfaceMesh&&) noexcept = default;
SurfaceMesh& SurfaceMesh::operator=(SurfaceMesh&&) noexcept = default;

std::vector<MeshTriangle> SurfaceMesh::triangles() const {
    const auto& self = *implementation_;
    std::vector<MeshTriangle> result;
    for (const auto f : self.mesh.faces()) {
        const auto corners = self.corners_of(f);
        for (const auto& t : triangulate(corners)) {
            const MeshTriangle triangle{{corners[t[0]], corners[t[1]], corners[t[2]]},
                                        self.mesh.property(self.slot, f)};
            if (length_squared(twice_vector_area(triangle.corner)) > 0.0)
                result.push_back(triangle);
        }
    }
    return result;
}

const std::vector<std::string>& SurfaceMesh::slots() const noexcept {
    return implementation_->slots;
}

SurfaceMesh SurfaceMesh::transformed(const Vector3& scale,
                                     const Frame& world_from_object) const {
    ISOLUX_EXPECT(scale.x * scale.y * scale.z != 0.0);
    const auto& self = *implementation_;
    const auto place = [&](const Point3& p) {
        return world_from_object.point_from_local(
            {scale.x * p.x, scale.y * p.y, scale.z * p.z});
    };
    std::vector<Point3> points;
    for (const auto v : self.mesh.vertices())
        points.push_back(place(from_open_mesh(self.mesh.point(v))));
    const bool mirrors = scale.x * scale.y * scale.z < 0.0;
    std::vector<Face> faces;
    std::vector<std::uint32_t> slot_of_face;
    for (const auto f : self.mesh.faces()) {
        auto& face = faces.emplace_back();
        for (const auto v : self.mesh.fv_range(f))
            face.push_back(static_cast<std::uint32_t>(v.idx()));
        if (mirrors)
            std::ranges::reverse(face);
        slot_of_face.push_back(self.mesh.property(self.slot, f));
    }
    SurfaceMesh result(points, faces, slot_of_face, self.slots);
    for (MeshFinding finding : self.collapsed) {
        finding.place = place(finding.place);
        result.implementation_->collapsed.push_back(std::move(finding));
    }
    return result;
}

std::vector<MeshFinding> SurfaceMesh::inspect() const {
    const auto& self = *implementation_;
    std::vector<Point3> points;
    for (const auto v : self.mesh.vertices())
        points.push_back(from_open_mesh(self.mesh.point(v)));
    std::vector<Face> faces;
    for (const auto f : self.mesh.faces()) {
        auto& face = faces.emplace_back();
        for (const auto v : self.mesh.fv_range(f))
            face.push_back(
                static_cast<std::uint32_t>(self.mesh.property(self.original, v).idx()));
    }
    auto findings = self.collapsed;
    std::ranges::move(find_oddities(points, faces), std::back_inserter(findings));
    return findings;
}

} // namespace isolux
