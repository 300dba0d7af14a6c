#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "isolux/base/colour.h"

namespace isolux {

/// Reflects the share `diffuse` of the incident light as Lambert's law says and the share
/// `mirror` as an ideal mirror; absorbs the rest. max_channel(diffuse) + mirror <= 1. Black is
/// the default.
struct Opaque {
    Rgb diffuse;
    double mirror = 0.0;
};

/// A thin clear pane: transmits without bending, reflects like a mirror; METHODS, "Slab".
struct ClearPane {
    double refractive_index = 1.52;
    double internal_transmittance = 1.0; ///< of the glass itself at normal incidence, 0..1
};

enum class Sides {
    both, ///< the back reflects like the front
    front ///< the back absorbs
};

struct Material {
    std::string name;
    std::variant<Opaque, ClearPane> scattering;
    Sides sides = Sides::both;
};

struct SlabOptics {
    double transmittance = 0.0;
    double reflectance = 0.0;
};

/// Transmittance and reflectance of a pane with all internal reflections, mean of the two
/// polarisations, METHODS "Slab". @param cos_theta  of the angle of incidence in air, 0..1
[[nodiscard]] SlabOptics evaluate_slab(const ClearPane& pane, double cos_theta) noexcept;

/// Everyday materials by name ("white paint", "oak", "mirror", "window glass", ...), each with
/// the source of its value in METHODS.md.
[[nodiscard]] std::span<const Material> everyday_materials();

[[nodiscard]] const Material* find_everyday_material(std::string_view name);

} // namespace isolux
