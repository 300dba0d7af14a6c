#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "isolux/transport/emission.h"

#include "support/normal_draws.h"
#include "support/test_scene.h"

/// Luminaires of every kind, made up at random: for statements that hold for all of them.
namespace isolux::test {

inline UnitVector3 random_direction(NormalDraws& random) {
    const double x = random();
    const double y = random();
    return UnitVector3(Vector3{x, y, random()});
}

inline Point3 random_point(NormalDraws& random, double half_side) {
    const auto draw = [&] { return half_side * (2.0 * random.uniform() - 1.0); };
    const double x = draw();
    const double y = draw();
    return {x, y, draw()};
}

/// A table of up to 12 planes and 13 polar angles over a random part of the sphere, some of its
/// values 0.
inline LuminairePhotometry random_table(NormalDraws& random) {
    const auto planes = 2 + static_cast<std::size_t>(10.0 * random.uniform());
    const auto gammas = 2 + static_cast<std::size_t>(11.0 * random.uniform());
    const double last = random.uniform() < 0.5 ? 180.0 : 20.0 + 160.0 * random.uniform();
    std::vector<Angle> plane;
    std::vector<Angle> gamma;
    std::vector<double> candela;
    for (std::size_t i = 0; i < planes; ++i)
        plane.push_back(
            degrees(360.0 * static_cast<double>(i) / static_cast<double>(planes - 1)));
    for (std::size_t i = 0; i < gammas; ++i)
        gamma.push_back(
            degrees(last * static_cast<double>(i) / static_cast<double>(gammas - 1)));
    for (std::size_t i = 0; i < planes * gammas; ++i)
        candela.push_back(random.uniform() < 0.3 ? 0.0 : 1000.0 * random.uniform());
    candela[1] = 100.0; // never all dark
    return {.symmetry = "",
            .manufacturer = "",
            .name = "",
            .catalogue_number = "",
            .distribution = IntensityDistribution(plane, gamma, candela),
            .opening = {},
            .housing = {},
            .declared_flux = {},
            .lamp_sets = {}};
}

/// Hangs a luminaire of a new type anyhow: point, panel, disc, box, cylinder, upright panel or
/// ellipsoid; table, Lambertian or isotropic.
inline void add_random_luminaire(Builder& b, NormalDraws& random, double half_side) {
    LuminaireType type;
    const double kind = random.uniform();
    if (kind < 0.6)
        type.source = random_table(random);
    else if (kind < 0.9)
        type.source = LambertianSource{Lumen(1000.0 * random.uniform() + 1.0)};
    else
        type.source = IsotropicSource{Lumen(1000.0 * random.uniform() + 1.0)};
    const auto size = [&] { return Metre(0.05 + 1.5 * random.uniform()); };
    const auto shapes = static_cast<double>(OpeningShape::vertical_ellipse) + 1.0;
    type.opening.shape = static_cast<OpeningShape>(static_cast<int>(shapes * random.uniform()));
    type.opening.extent_x = size();
    type.opening.extent_y = size();
    type.opening.extent_z = size();
    Luminaire l;
    Frame& frame = l.placement.world_from_luminaire;
    frame.z = random_direction(random);
    frame.x = UnitVector3(cross(frame.z, random_direction(random)));
    frame.y = UnitVector3(cross(frame.z, frame.x));
    frame.origin = random_point(random, half_side);
    l.placement.scale = 0.1 + random.uniform();
    l.opening = to_world(make_opening(type.opening), frame);
    l.flux = l.placement.scale * luminous_flux(type);
    l.placement.type = b.add_type(std::move(type));
    b.luminaires.push_back(l);
}

/// A small black triangle far below: scenes want something to hit.
inline void add_speck(Builder& b) {
    b.add_triangle({0, 0, -900}, {1, 0, -900}, {0, 1, -900}, b.add_diffuse(0.0));
}

inline Scene random_scene(NormalDraws& random, std::size_t luminaires, double half_side) {
    Builder b;
    add_speck(b);
    for (std::size_t i = 0; i < luminaires; ++i)
        add_random_luminaire(b, random, half_side);
    return b.build();
}

inline Receiver random_receiver(NormalDraws& random, double half_side) {
    Receiver r;
    r.point = random_point(random, half_side);
    r.axis = random_direction(random);
    r.kind = static_cast<IlluminanceKind>(static_cast<int>(5.0 * random.uniform()));
    r.reference = random_direction(random);
    return r;
}

} // namespace isolux::test
