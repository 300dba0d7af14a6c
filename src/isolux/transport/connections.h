#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/scene/scene.h"
#include "isolux/transport/light_ledger.h"

namespace isolux {

/// A path that is complete but for one look through the scene.
struct Connection {
    SightSegment sight;
    Rgb light;           ///< lx at the point if nothing stands in the way and nobody shares
    double chain = 0.0;  ///< n1 p1 of METHODS eq. (10) for an undimmed sight; 0: nobody shares
    double gather = 1.0; ///< n2 p2, without h of (144)
    /// Of an undimmed sight, for METHODS eq. (144); 0: there was no choice
    double nearness = 0.0;
    std::uint32_t point = 0;
    std::uint32_t luminaire = 0;
    std::uint32_t trail = Trails::none; ///< its diffuse reflections, where they are wanted
};

/// Connections wait here until there are enough for whole packets of rays.
class Connections {
public:
    void clear() noexcept { waiting_.clear(); }

    void add(const Connection& c) {
        if (max_channel(c.light) > 0.0)
            waiting_.push_back(c);
    }

    [[nodiscard]] std::size_t size() const noexcept { return waiting_.size(); }

    /// Looks along all of them and writes down the light that comes through, weighted by
    /// METHODS eq. (10). @return how many rays that took
    std::size_t settle(const Scene& scene, const LightLedger& ledger, const Trails& trails);

private:
    std::vector<Connection> waiting_;
};

} // namespace isolux
