#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/transport/connections.h"
#include "isolux/transport/follow.h"
#include "isolux/transport/vertex_cache.h"

namespace isolux {

/// A receiver that sends rays.
struct RayPoint {
    const Receiver* receiver = nullptr;
    Point3 at; ///< clear_point of it
    PointRandomness random;
    std::size_t samples = 1; ///< walks, each worth 1/samples: N2 or S
    std::uint32_t first = 0; ///< number of the first of them in this replicate
    /// Whether light by two near surfaces is traced, METHODS eq. (122), beside gathering.
    bool leaves_corners = false;
    /// Whether gathering walks light the surfaces they meet straight; otherwise only what they
    /// meet by mirrors counts.
    bool connects = true;
    /// Whether light that mirrors throw on near surfaces is traced, METHODS eq. (145).
    bool leaves_mirrored = false;
};

/// Walks from neighbouring points into the room, all of them side by side so that their shadow
/// rays fill packets. A walk either gathers, METHODS "LE-MIS" technique T2: at the first
/// diffuse surface a luminaire sample and one cached vertex light it; or traces, METHODS "Path
/// tracing": luminaire samples light every surface, and roulette ends it. Behind a mirror,
/// where no light path can do the same, a gathering walk becomes a tracing one; where light is
/// left to it, METHODS eq. (122) and (145), it goes on from the near surface and traces that.
class WalkFront {
public:
    /// Forgets the walks of before. Everything referred to must live until run() is done.
    void start(const Scene& scene,
               const Emission& emission,
               const MirrorImages& images,
               std::span<const RayPoint> points);

    /// What gathering walks share their paths with.
    void share_with(const VertexCache& cache, const EffectiveCounts& counts);

    /// Adds the walks of every point.
    void add_gathering();
    void add_tracing();

    /// Walks them all to their ends. Light straight from luminaires, or by the mirrors that the
    /// images cover, is not included. @return rays traced
    std::uint64_t run(const LightLedger& ledger);

private:
    /// Light to a near surface that is left to the walk that met it.
    struct Left {
        bool corners = false; ///< METHODS eq. (122)
        bool mirrors = false; ///< METHODS eq. (145)

        [[nodiscard]] bool any() const noexcept { return corners || mirrors; }
    };

    struct Walk {
        NumberSequence numbers;
        std::uint32_t point = 0;
        bool gathers = false;
        double pdf = 0.0;       ///< of the first direction, per steradian
        Rgb throughput;         ///< lx at the point for one cd/m2 along the current rays
        Rgb carried;            ///< in proportion to throughput; steers roulette
        double passed_on = 0.0; ///< sum over the surfaces met of what each would pass on
        Point3 start;           ///< where the current flight began
        Meeting next;           ///< the one of them where the walk goes on
        bool goes_on = false;
        Left next_left;
        Left left; ///< on the way from a near surface: nothing else counts. None: all does
        std::uint32_t trail = Trails::none; ///< surfaces the walk was sent on from
    };

    struct Ray {
        Branch branch;
        std::uint32_t walk = 0;
    };

    void add(bool gathers);
    void trace(std::span<const Ray> rays, const LightLedger& ledger);
    void arrive(const Ray& ray, const SurfaceHit& hit);
    void gather_at(Walk& walk, const Meeting& y);
    void connect_vertex(Walk& walk, const Meeting& y, double u, double nearest);
    void collect_at(Walk& walk, const Meeting& y);
    void collect_images(Walk& walk, const Meeting& y);
    void take_on(Walk& walk, Meeting y, Left left);
    void offer(Walk& walk, const Meeting& y, Left left);

    /// N2 of the walk's point.
    [[nodiscard]] double gathered(const Walk& walk) const noexcept {
        return static_cast<double>(points_[walk.point].samples);
    }

    [[nodiscard]] bool wants(const Walk& walk, const Meeting& y) const noexcept;
    void send_on(std::uint32_t walk);
    [[nodiscard]] std::uint32_t reflected_by(MaterialId material, std::uint32_t before);

    const Scene* scene_ = nullptr;
    const Emission* emission_ = nullptr;
    const MirrorImages* images_ = nullptr;
    std::span<const RayPoint> points_;
    const VertexCache* cache_ = nullptr;
    EffectiveCounts counts_;
    const LightLedger* ledger_ = nullptr; ///< during run() only
    std::uint64_t rays_ = 0;
    std::vector<Walk> walks_;
    std::vector<Ray> current_;
    std::vector<Ray> following_;
    std::vector<std::uint32_t> collecting_; ///< walks that may go on after this round
    Connections connections_;
    Trails trails_; ///< written only where the ledger wants them
};

} // namespace isolux
