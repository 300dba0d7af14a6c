#include "isolux/transport/vertex_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace isolux {

namespace {

/// Candidate k of u.
std::size_t candidate(const VertexCache& cache, double u, std::size_t k) noexcept {
    return cache.draw((u + static_cast<double>(k)) / static_cast<double>(vertex_candidates));
}

/// METHODS eq. (139): what a vertex would add, up to a common factor.
class UnshadowedLight {
public:
    UnshadowedLight(const VertexCache& cache, const LitPlace& place) noexcept
        : x_(static_cast<float>(place.at.x - cache.centre.x)),
          y_(static_cast<float>(place.at.y - cache.centre.y)),
          z_(static_cast<float>(place.at.z - cache.centre.z)),
          nx_(static_cast<float>(place.normal.x())), ny_(static_cast<float>(place.normal.y())),
          nz_(static_cast<float>(place.normal.z())),
          rival_(static_cast<float>(place.rival / std::numbers::pi)),
          least_(surely_nearer(cache, place)) {}

    [[nodiscard]] float operator()(const VertexRecord& v) const noexcept {
        constexpr float touching = 1e-12F; // m2, as in the kernel
        const float dx = x_ - v.x, dy = y_ - v.y, dz = z_ - v.z;
        const float d2 = dx * dx + dy * dy + dz * dz;
        const float cos_v = v.nx * dx + v.ny * dy + v.nz * dz;
        const float cos_y = -(nx_ * dx + ny_ * dy + nz_ * dz);
        if (!(cos_v > 0.0F && cos_y > 0.0F && d2 > touching && d2 >= least_))
            return 0.0F;
        const float g = cos_v * cos_y / (d2 * d2);
        return v.strength * g / (1.0F + rival_ * v.continuation * g);
    }

private:
    /// Squared. Who counts is decided in double precision later; here none of them may be left
    /// out, however the coordinates were rounded.
    static float surely_nearer(const VertexCache& cache, const LitPlace& place) noexcept {
        const Vector3 p = place.at - cache.centre;
        const double rounding =
            0x1p-21 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + place.nearest);
        const double surely = std::max(0.0, place.nearest - rounding);
        return static_cast<float>(surely * surely);
    }

    float x_, y_, z_, nx_, ny_, nz_, rival_, least_;
};

} // namespace

void fetch_candidates(const VertexCache& cache, double u) noexcept {
    for (std::size_t k = 0; k < vertex_candidates && !cache.empty(); ++k)
        __builtin_prefetch(&cache.records[candidate(cache, u, k)]);
}

std::optional<ChosenVertex>
choose_vertex(const VertexCache& cache, const LitPlace& place, double u, double v) noexcept {
    if (cache.empty())
        return std::nullopt;
    const UnshadowedLight light(cache, place);
    std::array<std::size_t, vertex_candidates> vertices{};
    std::array<float, vertex_candidates> added{};
    float sum = 0.0F;
    for (std::size_t k = 0; k < vertex_candidates; ++k) {
        vertices[k] = candidate(cache, u, k);
        added[k] = light(cache.records[vertices[k]]);
        sum += added[k];
    }
    if (!(sum > 0.0F))
        return std::nullopt;
    float rest = static_cast<float>(v) * sum;
    std::size_t chosen = 0;
    for (std::size_t k = 0; k < vertex_candidates; ++k) {
        if (added[k] <= 0.0F)
            continue;
        chosen = k;
        if (rest < added[k])
            break;
        rest -= added[k];
    }
    const double odds =
        static_cast<double>(sum)
        / (static_cast<double>(vertex_candidates) * static_cast<double>(added[chosen]));
    return ChosenVertex{vertices[chosen], odds * cache.share_of(vertices[chosen])};
}

} // namespace isolux
