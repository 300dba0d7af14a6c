#pragma once

#include <array>
#include <string>
#include <vector>

#include "isolux/scene/scene.h"

/// Scenes built triangle by triangle, for tests that must not depend on rooms and files.
namespace isolux::test {

struct Builder {
    std::vector<Material> materials;
    std::vector<SceneTriangle> triangles;
    std::vector<LuminaireType> types;
    std::vector<Luminaire> luminaires;

    MaterialId add_material(Material m) {
        materials.push_back(std::move(m));
        return MaterialId(materials.size() - 1);
    }

    MaterialId add_diffuse(double reflectance) {
        return add_material({"diffuse", Opaque{Rgb::grey(reflectance), 0.0}, Sides::both});
    }

    void add_triangle(const Point3& a, const Point3& b, const Point3& c, MaterialId m) {
        const Vector3 n = cross(b - a, c - a);
        triangles.push_back({{a, b, c}, UnitVector3(n), 0.5 * length(n), m, SurfaceId(0)});
    }

    /// corner + s u + t v; front where u x v points.
    void add_quad(const Point3& corner, const Vector3& u, const Vector3& v, MaterialId m) {
        add_triangle(corner, corner + u, corner + u + v, m);
        add_triangle(corner, corner + u + v, corner + v, m);
    }

    /// The six inner faces of a box from `lower` to `upper`: floor, ceiling, walls.
    void add_room(const Point3& lower,
                  const Point3& upper,
                  MaterialId floor,
                  MaterialId ceiling,
                  MaterialId walls) {
        const Vector3 x{upper.x - lower.x, 0, 0};
        const Vector3 y{0, upper.y - lower.y, 0};
        const Vector3 z{0, 0, upper.z - lower.z};
        add_quad(lower, x, y, floor);
        add_quad(lower + z, y, x, ceiling);
        add_quad(lower, y, z, walls);
        add_quad(lower + x, z, y, walls);
        add_quad(lower, z, x, walls);
        add_quad(lower + y, x, z, walls);
    }

    LuminaireTypeId add_type(LuminaireType t) {
        types.push_back(std::move(t));
        return LuminaireTypeId(types.size() - 1);
    }

    LuminaireTypeId add_isotropic_type(double flux) {
        LuminaireType t;
        t.name = "isotropic";
        t.source = IsotropicSource{Lumen(flux)};
        return add_type(std::move(t));
    }

    void add_point(const Point3& p, LuminaireTypeId type) {
        Luminaire l;
        l.placement.type = type;
        l.placement.world_from_luminaire.origin = p;
        l.flux = luminous_flux(types[type.index()]);
        luminaires.push_back(l);
    }

    /// A Lambertian quadrilateral that shines to the side u x v points to.
    void add_panel(const Point3& corner, const Vector3& u, const Vector3& v, double flux) {
        LuminaireType t;
        t.name = "panel";
        t.source = LambertianSource{Lumen(flux)};
        Luminaire l;
        l.placement.type = add_type(std::move(t));
        const UnitVector3 n(cross(u, v));
        Frame& f = l.placement.world_from_luminaire;
        f.origin = corner + 0.5 * (u + v);
        f.z = -n;
        f.x = UnitVector3(u);
        f.y = UnitVector3(cross(f.z, f.x));
        l.opening.form = OpeningForm::flat;
        l.opening.facets.push_back(
            {{corner, corner + u, corner + u + v, corner + v}, n, length(cross(u, v))});
        l.opening.largest_dimension = length(u + v);
        l.flux = Lumen(flux);
        luminaires.push_back(l);
    }

    /// @pre called once
    [[nodiscard]] Scene build() {
        std::vector<CasterTriangle> cast;
        Bounds bounds;
        double area = 0.0;
        bool is_first = true;
        for (const SceneTriangle& t : triangles) {
            CasterTriangle c{t.corner, false, false, 1.52, 1.0};
            if (const auto* pane =
                    std::get_if<ClearPane>(&materials[t.material.index()].scattering)) {
                c.is_pane = true;
                c.refractive_index = pane->refractive_index;
                c.internal_transmittance = pane->internal_transmittance;
            }
            cast.push_back(c);
            area += t.area;
            for (const Point3& p : t.corner) {
                if (is_first)
                    bounds = {p, p};
                is_first = false;
                bounds.lower = {std::min(bounds.lower.x, p.x),
                                std::min(bounds.lower.y, p.y),
                                std::min(bounds.lower.z, p.z)};
                bounds.upper = {std::max(bounds.upper.x, p.x),
                                std::max(bounds.upper.y, p.y),
                                std::max(bounds.upper.z, p.z)};
            }
        }
        Scene scene{materials,
                    {{"all", 0, triangles.size(), area, false}},
                    triangles,
                    types,
                    luminaires,
                    bounds,
                    area,
                    RayCaster(cast),
                    {}};
        return scene;
    }
};

} // namespace isolux::test
