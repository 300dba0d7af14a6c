#include <algorithm>
#include <array>

#include "isolux/scene/material.h"

/// A small library of materials for a first calculation: middles of the ranges that lighting
/// handbooks print. METHODS "Everyday materials" names the source of each value.
namespace isolux {
namespace {

Material matt(const char* name, double reflectance) {
    return {name, Opaque{Rgb::grey(reflectance), 0.0}};
}

/// Part of the light is scattered, part reflected like a mirror would.
Material shiny(const char* name, double diffuse, double mirror) {
    return {name, Opaque{Rgb::grey(diffuse), mirror}};
}

/// A pane by its transmittance at normal incidence; refractive index of float glass.
Material pane(const char* name, double internal_transmittance) {
    return {name, ClearPane{1.52, internal_transmittance}};
}

const auto& library() {
    static const std::array materials{
        // the default room of a lighting design, EN 12464-1
        matt("ceiling", 0.70),
        matt("wall", 0.50),
        matt("floor", 0.20),
        matt("furniture", 0.30),
        // paints and plasters
        matt("white paint", 0.80),
        matt("light yellow paint", 0.65),
        matt("light green paint", 0.50),
        matt("light grey paint", 0.40),
        matt("medium grey paint", 0.30),
        matt("brown paint", 0.25),
        matt("dark green paint", 0.17),
        matt("dark blue paint", 0.17),
        matt("dark red paint", 0.17),
        matt("black paint", 0.05),
        matt("white plaster", 0.80),
        matt("light plaster", 0.42),
        matt("dark plaster", 0.20),
        // stone, tiles
        matt("concrete", 0.25),
        matt("breeze block", 0.10),
        matt("red brick", 0.13),
        matt("sandstone", 0.30),
        matt("limestone", 0.45),
        matt("granite", 0.22),
        matt("marble", 0.50),
        matt("white tiles", 0.70),
        // wood
        matt("maple", 0.60),
        matt("birch", 0.60),
        matt("light oak", 0.40),
        matt("oak", 0.30),
        matt("dark oak", 0.20),
        matt("walnut", 0.20),
        matt("plywood", 0.33),
        // other furnishings
        matt("white paper", 0.75),
        matt("white enamel", 0.70),
        matt("whiteboard", 0.70),
        matt("light carpet", 0.30),
        matt("dark carpet", 0.10),
        // metals
        matt("matt aluminium", 0.65),
        matt("anodised aluminium", 0.82),
        shiny("polished aluminium", 0.0, 0.70),
        shiny("reflector aluminium", 0.0, 0.84),
        shiny("chrome", 0.0, 0.65),
        // mirrors and glass
        shiny("mirror", 0.0, 0.84),
        pane("window glass", 0.98),
        pane("perfectly clear glass", 1.0),
        pane("tinted glass", 0.60),
        // no light comes back
        matt("black", 0.0),
    };
    return materials;
}

} // namespace

std::span<const Material> everyday_materials() { return library(); }

const Material* find_everyday_material(std::string_view name) {
    const auto& all = library();
    const auto* found = std::ranges::find(all, name, &Material::name);
    return found == all.end() ? nullptr : found;
}

} // namespace isolux
