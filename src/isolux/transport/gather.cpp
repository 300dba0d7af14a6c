#include "isolux/transport/gather.h"

#include "isolux/transport/local_estimator.h"
#include "isolux/transport/walk_front.h"

namespace isolux {

Rgb gather_indirect(const Scene& scene,
                    const Emission& emission,
                    const MirrorImages& images,
                    const VertexCache& cache,
                    const EffectiveCounts& counts,
                    const Receiver& receiver,
                    GatherPart part,
                    std::size_t directions,
                    std::uint32_t first,
                    const PointRandomness& random,
                    std::uint64_t& rays) {
    const RayPoint point{&receiver,
                         clear_point(scene, receiver),
                         random,
                         directions,
                         first,
                         false,
                         part == GatherPart::balanced};
    Rgb sum;
    WalkFront front;
    front.start(scene, emission, images, {&point, 1});
    front.share_with(cache, counts);
    front.add_gathering();
    rays += front.run({{&sum, 1}, nullptr, {}, {}});
    return sum;
}

} // namespace isolux
