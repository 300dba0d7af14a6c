#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "isolux/base/receiver.h"
#include "isolux/scene/scene.h"
#include "isolux/validate/sobolev.h"

/// Building blocks of scenes with known answers.
namespace isolux {

/// A grey material that reflects by Lambert's law.
[[nodiscard]] Material make_grey(double reflectance);

/// Adds a grey material. @return its id
MaterialId add_material(SceneDescription& scene, double reflectance);

/// A flat rectangle, corners counter-clockwise seen from the front.
[[nodiscard]] Object
make_plate(std::string name, const std::array<Point3, 4>& corners, MaterialId material);

/// A sphere around the origin that faces inwards: an icosahedron whose triangles were halved
/// `halvings` times, all corners on the sphere (20 * 4^halvings triangles).
struct SphereMesh {
    Object object;
    double area = 0.0;                ///< m2 of the triangles
    std::vector<Point3> centres;      ///< of the triangles
    std::vector<UnitVector3> normals; ///< inwards
};

[[nodiscard]] SphereMesh make_sphere(double radius, int halvings, MaterialId material);

/// A room from the origin to (x, y, z) of which every surface has one of these materials.
[[nodiscard]] Room make_box_room(
    double x, double y, double z, MaterialId floor, MaterialId ceiling, MaterialId wall);

void add_isotropic_source(SceneDescription& scene, const Point3& position, Lumen flux);

/// A Lambertian opening. @param frame  its centre; shines towards -z of the frame
void add_lambertian_source(SceneDescription& scene,
                           const Frame& frame,
                           const LuminousOpening& opening,
                           Lumen flux);

/// Sobolev's problem with square plates whose half side is 60 separations. What their rim is
/// missing is below 1e-7 of the value at five separations from the foot of the source.
[[nodiscard]] SceneDescription make_sobolev_plates(const SobolevProblem& problem);

/// A point of those plates at `r` from the foot of the source, each radius in another
/// direction.
[[nodiscard]] Receiver
make_sobolev_receiver(const SobolevProblem& problem, SobolevPlane plane, Metre r);

} // namespace isolux
