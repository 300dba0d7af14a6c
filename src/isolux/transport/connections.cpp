#include "isolux/transport/connections.h"

#include <algorithm>
#include <array>

#include "isolux/transport/preference.h"

namespace isolux {

std::size_t
Connections::settle(const Scene& scene, const LightLedger& ledger, const Trails& trails) {
    std::array<SightSegment, packet_size> sights;
    std::array<float, packet_size> visible{};
    for (std::size_t first = 0; first < waiting_.size(); first += packet_size) {
        const std::size_t n = std::min(packet_size, waiting_.size() - first);
        for (std::size_t i = 0; i < n; ++i)
            sights[i] = waiting_[first + i].sight;
        scene.caster.transmittance16(std::span(sights).first(n),
                                     (1U << n) - 1U,
                                     std::span(visible).first(n),
                                     RayOrder::scattered);
        for (std::size_t i = 0; i < n; ++i) {
            if (visible[i] <= 0.0F)
                continue;
            const Connection& c = waiting_[first + i];
            const double passed = static_cast<double>(visible[i]);
            const double chain = c.chain * passed;
            const double gather = c.gather * preference(c.nearness * passed);
            if (chain + gather > 0.0)
                ledger.add(c.point,
                           c.luminaire,
                           (passed * gather / (chain + gather)) * c.light,
                           trails,
                           c.trail);
        }
    }
    const std::size_t rays = waiting_.size();
    waiting_.clear();
    return rays;
}

} // namespace isolux
