#include "isolux/transport/mirrored_light.h"

#include <algorithm>

#include "isolux/scene/material.h"

namespace isolux {

namespace {

/// A pane reflects about 8 %; what reflects more than this is a mirror.
constexpr double strong_reflectance = 0.3;

constexpr std::size_t draws_at_mirrors = 4;

} // namespace

MirroredLight::MirroredLight(const Scene& scene,
                             const Emission& emission,
                             const MirrorImages& images)
    : scene_(&scene), emission_(&emission), images_(&images) {
    if (images.chains().empty())
        return;
    for (const SceneTriangle& t : scene.triangles) {
        const auto* opaque = std::get_if<Opaque>(&scene.material(t.material).scattering);
        is_strong_ = is_strong_ || (opaque != nullptr && opaque->mirror > strong_reflectance);
    }
}

Rgb MirroredLight::estimate(const Point3& at,
                            const UnitVector3& normal,
                            const std::array<double, 4>& numbers,
                            std::uint64_t& rays) const noexcept {
    if (images_->chains().empty() || emission_->total_flux() <= 0.0)
        return {};
    const std::size_t draws = is_strong_ ? draws_at_mirrors : 1;
    Rgb sum;
    for (std::size_t d = 0; d < draws; ++d) {
        // Chains and luminaires are drawn systematically, with one offset; places on openings
        // too.
        const auto turned = [&](double u) {
            const double v = u + static_cast<double>(d) / static_cast<double>(draws);
            return v < 1.0 ? v : v - 1.0;
        };
        const auto [chain, among_all] =
            images_->draw_chain(turned(numbers[0]) * images_->draws());
        if (chain == nullptr)
            continue;
        const double probability = among_all / images_->draws();
        const TowardsSample sample = emission_->sample_towards(image_of(*images_, *chain, at),
                                                               turned(numbers[1]),
                                                               turned(numbers[2]),
                                                               turned(numbers[3]));
        if (!(sample.density > 0.0))
            continue;
        const ImageLight light =
            trace_image(*scene_, *emission_, *images_, *chain, at, sample, rays);
        const double cosine = dot(normal, light.arrival);
        if (light.strength > 0.0 && cosine > 0.0)
            sum += (light.strength * cosine / (probability * sample.density))
                   * emission_->colour(sample.from.luminaire);
    }
    return (1.0 / static_cast<double>(draws)) * sum;
}

} // namespace isolux
