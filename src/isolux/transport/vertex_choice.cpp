#include "isolux/transport/vertex_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "isolux/base/wide_vectors.h"
#include "isolux/transport/preference.h"

namespace isolux {

namespace {

static_assert(most_preferred == double{VertexHand::size});

const VertexHand& hand_of(const VertexCache& cache, double u) noexcept {
    const std::size_t n = cache.hands.size();
    return cache.hands[std::min(n - 1, static_cast<std::size_t>(u * static_cast<double>(n)))];
}

/// A place as the loop over a hand sees it, relative to the centre of the cache.
struct NarrowPlace {
    float x, y, z, nx, ny, nz;
    float rival; ///< 1/w2 of METHODS eq. (10) is 1 + continuation (even_rival + rival g)
    float even_rival;
    float least; ///< squared distance
};

/// Nobody who counts in double precision may be left out here, however the coordinates were
/// rounded.
float surely_nearer(const VertexCache& cache, const LitPlace& place) noexcept {
    constexpr float touching = 1e-12F; // m2, as in the kernel
    const Vector3 p = place.at - cache.centre;
    const double rounding =
        0x1p-21 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + place.nearest);
    const double surely = std::max(0.0, place.nearest - rounding);
    return std::max(touching, static_cast<float>(surely * surely));
}

NarrowPlace narrow(const VertexCache& cache, const LitPlace& place) noexcept {
    const Vector3 p = place.at - cache.centre;
    const bool prefers = place.area > 0.0;
    const double rival = place.rival / (prefers ? most_preferred : 1.0);
    const double even =
        prefers ? rival * (most_preferred - 1.0) * usual_nearness / place.area : 0.0;
    return {static_cast<float>(p.x),
            static_cast<float>(p.y),
            static_cast<float>(p.z),
            static_cast<float>(place.normal.x()),
            static_cast<float>(place.normal.y()),
            static_cast<float>(place.normal.z()),
            static_cast<float>(rival / std::numbers::pi),
            static_cast<float>(even),
            surely_nearer(cache, place)};
}

using Lights = VertexHand::Values;

/// t of METHODS eq. (139), up to a common factor.
ISOLUX_WIDE_VECTORS
void look_at(const VertexHand& hand, const NarrowPlace& p, Lights& t) noexcept {
    for (std::size_t i = 0; i < VertexHand::size; ++i) {
        const float dx = p.x - hand.x[i];
        const float dy = p.y - hand.y[i];
        const float dz = p.z - hand.z[i];
        const float d2 = dx * dx + dy * dy + dz * dz;
        const float cos_v = hand.nx[i] * dx + hand.ny[i] * dy + hand.nz[i] * dz;
        const float cos_y = -(p.nx * dx + p.ny * dy + p.nz * dz);
        const float both = std::max(0.0F, cos_v) * std::max(0.0F, cos_y);
        const float g = d2 >= p.least ? both / (d2 * d2) : 0.0F;
        t[i] =
            hand.strength[i] * g / (1.0F + hand.continuation[i] * (p.even_rival + p.rival * g));
    }
}

} // namespace

void fetch_hand(const VertexCache& cache, double u) noexcept {
    if (cache.empty())
        return;
    const auto* line = reinterpret_cast<const char*>(&hand_of(cache, u));
    for (std::size_t k = 0; k < sizeof(VertexHand); k += 64)
        __builtin_prefetch(line + k);
}

std::optional<ChosenVertex>
choose_vertex(const VertexCache& cache, const LitPlace& place, double u, double v) noexcept {
    if (cache.empty())
        return std::nullopt;
    const VertexHand& hand = hand_of(cache, u);
    Lights t;
    look_at(hand, narrow(cache, place), t);
    float sum = 0.0F;
    for (const float light : t)
        sum += light;
    if (!(sum > 0.0F))
        return std::nullopt;
    float rest = static_cast<float>(v) * sum;
    std::size_t chosen = 0;
    for (std::size_t k = 0; k < t.size(); ++k) {
        if (t[k] <= 0.0F)
            continue;
        chosen = k;
        if (rest < t[k])
            break;
        rest -= t[k];
    }
    const double odds = static_cast<double>(cache.hands.size())
                        / static_cast<double>(cache.offered())
                        * (static_cast<double>(sum) / static_cast<double>(t[chosen]));
    return ChosenVertex{hand.vertex[chosen], odds * cache.share_of(hand.vertex[chosen])};
}

} // namespace isolux
