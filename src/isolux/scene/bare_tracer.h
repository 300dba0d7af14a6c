#pragma once

#include <memory>
#include <span>

#include "isolux/scene/scene.h"

namespace isolux {

/// The same triangles in the ray tracer alone, nothing of ours around it: what the scene's own
/// shadow rays are measured against. Panes count as walls.
class BareTracer {
public:
    /// @throws DeviceError
    explicit BareTracer(const Scene& scene);
    ~BareTracer();
    BareTracer(const BareTracer&) = delete;
    BareTracer& operator=(const BareTracer&) = delete;

    /// Traces packets of 16 shadow rays that were prepared before the clock starts.
    /// @param segments  packet_size of them to a packet; a last incomplete packet is left out
    /// @return          seconds, the best of `turns`
    [[nodiscard]] double time_packets(std::span<const SightSegment> segments, int turns) const;

private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
};

} // namespace isolux
