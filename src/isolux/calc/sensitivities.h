#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isolux/base/estimate.h"
#include "isolux/scene/scene.h"

/// How illuminance changes with the reflectance of each material: its derivatives, from the
/// same light paths as the illuminance itself (METHODS "Derivatives").
namespace isolux {

/// A material whose reflectance may be asked about.
struct SensitiveMaterial {
    std::string name;
    double reflectance = 0.0; ///< diffuse, Y-sum of the channels
    MaterialId id;
};

/// Materials with a diffuse part that some surface of the scene is made of, in the scene's
/// order. A black one is missing: no path tells what it would reflect.
[[nodiscard]] std::vector<SensitiveMaterial> find_sensitive_materials(const Scene& scene);

/// Derivatives dE/drho by material, replicate and point, lx for a reflectance of 1. A
/// material's colour stays as it is while its reflectance changes; mirror shares and panes stay
/// too. Points stand as in the results, surface after surface. 4 bytes each.
struct Sensitivities {
    std::vector<SensitiveMaterial> materials;
    std::size_t replicates = 0;
    std::size_t points = 0;
    std::vector<float> values; ///< [material][replicate][point]

    [[nodiscard]] std::span<const float> row(std::size_t material,
                                             std::size_t replicate) const noexcept {
        return std::span(values).subspan((material * replicates + replicate) * points, points);
    }

    /// dE/drho of one point.
    [[nodiscard]] Estimate at(std::size_t material, std::size_t point) const;

    /// d(mean illuminance)/drho of the points [first, first + count). @pre count > 0
    [[nodiscard]] Estimate
    of_mean(std::size_t material, std::size_t first, std::size_t count) const;
};

} // namespace isolux
