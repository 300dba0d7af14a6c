#include "isolux/calc/sensitivities.h"

namespace isolux {

std::vector<SensitiveMaterial> find_sensitive_materials(const Scene& scene) {
    std::vector<bool> is_used(scene.materials.size(), false);
    for (const SceneTriangle& t : scene.triangles)
        is_used[t.material.index()] = true;
    std::vector<SensitiveMaterial> found;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const auto* opaque = std::get_if<Opaque>(&scene.materials[m].scattering);
        if (!is_used[m] || opaque == nullptr)
            continue;
        const double reflectance = luminance_sum(opaque->diffuse);
        if (reflectance > 0.0)
            found.push_back({scene.materials[m].name, reflectance, MaterialId(m)});
    }
    return found;
}

Estimate Sensitivities::at(std::size_t material, std::size_t point) const {
    return of_mean(material, point, 1);
}

Estimate
Sensitivities::of_mean(std::size_t material, std::size_t first, std::size_t count) const {
    std::vector<double> means(replicates, 0.0);
    for (std::size_t r = 0; r < replicates; ++r) {
        for (const float v : row(material, r).subspan(first, count))
            means[r] += static_cast<double>(v);
        means[r] /= static_cast<double>(count);
    }
    return estimate_from_replicates(means);
}

} // namespace isolux
