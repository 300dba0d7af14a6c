#include <cmath>
#include <numbers>

#include "isolux/base/check.h"
#include "isolux/transport/vertex_tree.h"

// This file is compiled once for every instruction set; the widest that the machine has is
// called.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "isolux/transport/cluster_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace isolux {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float inverse_pi = std::numbers::inv_pi_v<float>;
constexpr std::size_t lanes = ClusterRow::size;

/// Squared distance below which a vertex and a receiver count as touching, m2.
constexpr float least_distance_squared = 1e-12F;

/// Where the values of a row lie; `spread` is null for single vertices.
struct RowView {
    const float *x, *y, *z, *nx, *ny, *nz, *strength, *rival;
    const ClusterRow* spread;
};

RowView view(const ClusterRow& r) noexcept {
    return {r.x.data(),
            r.y.data(),
            r.z.data(),
            r.nx.data(),
            r.ny.data(),
            r.nz.data(),
            r.strength.data(),
            r.rival.data(),
            &r};
}

RowView view(const VertexBlock& b, std::size_t row) noexcept {
    const std::size_t i = VertexBlock::columns * row;
    return {b.x.data() + i,
            b.y.data() + i,
            b.z.data() + i,
            b.nx.data() + i,
            b.ny.data() + i,
            b.nz.data() + i,
            b.strength.data() + i,
            b.rival.data() + i,
            nullptr};
}

/// P of METHODS eq. (137): the most that the positive part of something of this mean and
/// variance can have as its mean.
template <class D, class V = hn::Vec<D>> V positive_part(D d, V mean, V variance) noexcept {
    const V size = hn::Abs(mean);
    const V half = hn::Max(
        hn::Set(d, 1e-18F),
        hn::Mul(hn::Set(d, 0.5F), hn::Add(size, hn::Sqrt(hn::MulAdd(mean, mean, variance)))));
    // the same without cancellation where the mean is negative
    return hn::IfThenElse(
        hn::Lt(mean, hn::Zero(d)), hn::Div(variance, hn::Mul(hn::Set(d, 4.0F), half)), half);
}

/// The same for places on both sides of a plane: as if they were spread evenly, but never much
/// less than it can be.
template <class D, class V = hn::Vec<D>> V part_ahead(D d, V mean, V deviation) noexcept {
    const V half = hn::Max(hn::Set(d, 1e-18F), hn::Mul(hn::Set(d, 1.7320508F), deviation));
    const V over = hn::Min(hn::Max(hn::Zero(d), hn::Add(mean, half)), hn::Add(half, half));
    const V evenly = hn::Div(hn::Mul(over, over), hn::Mul(hn::Set(d, 4.0F), half));
    const V most = positive_part(d, mean, hn::Mul(deviation, deviation));
    return hn::Max(hn::Max(mean, evenly), hn::Mul(hn::Set(d, 0.125F), most));
}

/// One row and one receiver, lane by lane the same arithmetic for any width of the registers.
template <IlluminanceKind kind, Weighting weighting, bool has_spread>
void weigh(const RowView& v, const KernelReceiver& p, float* u) noexcept {
    const hn::CappedTag<float, lanes> d;
    using V = hn::Vec<decltype(d)>;
    const V zero = hn::Zero(d);
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        // from the vertex to the receiver
        const V dx = hn::Sub(hn::Set(d, p.at[0]), hn::LoadU(d, v.x + i));
        const V dy = hn::Sub(hn::Set(d, p.at[1]), hn::LoadU(d, v.y + i));
        const V dz = hn::Sub(hn::Set(d, p.at[2]), hn::LoadU(d, v.z + i));
        const V d2 = hn::Max(hn::Set(d, least_distance_squared),
                             hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))));
        // distance times the cosine at the vertex, and along the receiver's axis
        V cv = hn::MulAdd(
            hn::LoadU(d, v.nx + i),
            dx,
            hn::MulAdd(hn::LoadU(d, v.ny + i), dy, hn::Mul(hn::LoadU(d, v.nz + i), dz)));
        const V ca = hn::MulAdd(
            hn::Set(d, -p.axis[0]),
            dx,
            hn::MulAdd(hn::Set(d, -p.axis[1]), dy, hn::Mul(hn::Set(d, -p.axis[2]), dz)));
        V sx = zero, sy = zero, sz = zero; // standard deviations
        // of the place: variance, that along d times d2, covariance of axis and d times d
        V spread = zero, along_ray = zero, across_axis = zero;
        if constexpr (has_spread) {
            sx = hn::LoadU(d, v.spread->sx.data() + i);
            sy = hn::LoadU(d, v.spread->sy.data() + i);
            sz = hn::LoadU(d, v.spread->sz.data() + i);
            const V qx = hn::Mul(sx, sx), qy = hn::Mul(sy, sy), qz = hn::Mul(sz, sz);
            spread = hn::Add(hn::Add(qx, qy), qz);
            const V ex = hn::Mul(qx, dx), ey = hn::Mul(qy, dy), ez = hn::Mul(qz, dz);
            along_ray = hn::MulAdd(ex, dx, hn::MulAdd(ey, dy, hn::Mul(ez, dz)));
            across_axis = hn::MulAdd(
                hn::Set(d, p.axis[0]),
                ex,
                hn::MulAdd(hn::Set(d, p.axis[1]), ey, hn::Mul(hn::Set(d, p.axis[2]), ez)));
            const V deviation = hn::MulAdd(hn::LoadU(d, v.spread->wobble.data() + i),
                                           hn::Sqrt(d2),
                                           hn::LoadU(d, v.spread->depth.data() + i));
            cv = positive_part(d,
                               hn::Sub(cv, hn::LoadU(d, v.spread->lean.data() + i)),
                               hn::Mul(deviation, deviation));
        } else {
            cv = hn::Max(zero, cv);
        }
        const auto positive = [&](V mean) {
            if constexpr (has_spread)
                return positive_part(d, mean, hn::Mul(hn::Set(d, 4.0F), spread));
            else
                return hn::Max(zero, mean);
        };
        // METHODS eq. (60), (137): strength numerator / (denominator + rival shared)
        V numerator, denominator, shared;
        if constexpr (kind == IlluminanceKind::planar) {
            V ahead = hn::Max(zero, ca);
            if constexpr (has_spread) {
                const V fx = hn::Set(d, std::abs(p.axis[0]));
                const V fy = hn::Set(d, std::abs(p.axis[1]));
                const V fz = hn::Set(d, std::abs(p.axis[2]));
                const auto load = [&](const ClusterRow::Values& values) {
                    return hn::Load(d, values.data() + i);
                };
                const V reach = hn::MulAdd(
                    fx,
                    load(v.spread->hx),
                    hn::MulAdd(fy, load(v.spread->hy), hn::Mul(fz, load(v.spread->hz))));
                const V deviation = hn::MulAdd(fx, sx, hn::MulAdd(fy, sy, hn::Mul(fz, sz)));
                ahead = hn::IfThenElse(
                    hn::Lt(hn::Abs(ca), reach), part_ahead(d, ca, deviation), ahead);
                // what curves within the cluster, to second order
                const V bend = hn::Div(
                    hn::MulAdd(ahead,
                               hn::Sub(hn::Div(hn::Mul(hn::Set(d, 12.0F), along_ray), d2),
                                       hn::Add(spread, spread)),
                               hn::Mul(hn::Set(d, 4.0F), across_axis)),
                    d2);
                ahead = hn::Max(hn::Mul(hn::Set(d, 0.5F), ahead), hn::Add(ahead, bend));
            }
            numerator = hn::Mul(ahead, cv);
            denominator = hn::Mul(d2, d2);
            shared = numerator;
        } else {
            const V distance = hn::Sqrt(d2);
            denominator = hn::Mul(d2, distance);
            shared = hn::Mul(hn::Set(d, 0.25F), cv);
            V response = hn::Set(d, 0.25F);
            if constexpr (kind == IlluminanceKind::hemispherical)
                response =
                    hn::Mul(response, hn::Div(positive(hn::Add(distance, ca)), distance));
            if constexpr (kind == IlluminanceKind::cylindrical
                          || kind == IlluminanceKind::semi_cylindrical) {
                V side = hn::Sqrt(hn::Add(spread, hn::Max(zero, hn::NegMulAdd(ca, ca, d2))));
                if constexpr (kind == IlluminanceKind::semi_cylindrical) {
                    const V along =
                        hn::MulAdd(hn::Set(d, -p.across[0]),
                                   dx,
                                   hn::MulAdd(hn::Set(d, -p.across[1]),
                                              dy,
                                              hn::Mul(hn::Set(d, -p.across[2]), dz)));
                    side = positive(hn::Add(side, along));
                }
                response = hn::Div(hn::Mul(hn::Set(d, inverse_pi), side), distance);
            }
            numerator = hn::Mul(response, cv);
            if constexpr (has_spread) {
                const V bend =
                    hn::Div(hn::Sub(hn::Div(hn::Mul(hn::Set(d, 7.5F), along_ray), d2),
                                    hn::Mul(hn::Set(d, 1.5F), spread)),
                            d2);
                numerator = hn::Max(hn::Mul(hn::Set(d, 0.5F), numerator),
                                    hn::MulAdd(numerator, bend, numerator));
            }
        }
        if constexpr (weighting == Weighting::balanced)
            denominator = hn::MulAdd(
                hn::LoadU(d, v.rival + i), hn::Mul(hn::Set(d, p.rays), shared), denominator);
        hn::StoreU(
            hn::Div(hn::Mul(hn::LoadU(d, v.strength + i), numerator), denominator), d, u + i);
    }
}

/// In the same order for any width of the registers.
float sum_of(const float* u) noexcept {
    std::array<float, 4> s{};
    for (std::size_t k = 0; k < 4; ++k)
        s[k] = (u[k] + u[k + 4]) + (u[k + 8] + u[k + 12]);
    return (s[0] + s[1]) + (s[2] + s[3]);
}

/// Rows outside, receivers inside: a row stays in the nearest cache for all of them.
struct CutJob {
    std::span<const ClusterRow> clusters;
    std::span<const VertexBlock> blocks;
    std::span<const std::uint32_t> leaves;
    std::span<const KernelReceiver> receivers;
    float* u;
    float* sums;

    template <IlluminanceKind kind, Weighting weighting> void run() const noexcept {
        for (std::size_t r = 0; r < clusters.size(); ++r)
            weigh_row<kind, weighting, true>(view(clusters[r]), r);
        for (std::size_t i = 0; i < leaves.size(); ++i)
            weigh_row<kind, weighting, false>(view(blocks[leaves[i] / VertexBlock::most_rows],
                                                   leaves[i] % VertexBlock::most_rows),
                                              clusters.size() + i);
    }

private:
    template <IlluminanceKind kind, Weighting weighting, bool has_spread>
    void weigh_row(const RowView& row, std::size_t number) const noexcept {
        const std::size_t rows = clusters.size() + leaves.size();
        for (std::size_t p = 0; p < receivers.size(); ++p) {
            const std::size_t place = p * rows + number;
            weigh<kind, weighting, has_spread>(row, receivers[p], u + place * lanes);
            sums[place] = sum_of(u + place * lanes);
        }
    }
};

struct RowJob {
    std::span<const RowTask> tasks;
    std::span<const KernelReceiver> receivers;
    float* u;

    template <IlluminanceKind kind, Weighting weighting> void run() const noexcept {
        for (std::size_t t = 0; t < tasks.size(); ++t) {
            const RowTask& task = tasks[t];
            const KernelReceiver& p = receivers[task.receiver];
            if (task.clusters != nullptr)
                weigh<kind, weighting, true>(view(*task.clusters), p, u + t * lanes);
            else
                weigh<kind, weighting, false>(view(*task.block, task.row), p, u + t * lanes);
        }
    }
};

template <Weighting weighting, class Job>
void run_kind(IlluminanceKind kind, const Job& job) noexcept {
    switch (kind) {
    case IlluminanceKind::planar:
        return job.template run<IlluminanceKind::planar, weighting>();
    case IlluminanceKind::cylindrical:
        return job.template run<IlluminanceKind::cylindrical, weighting>();
    case IlluminanceKind::semi_cylindrical:
        return job.template run<IlluminanceKind::semi_cylindrical, weighting>();
    case IlluminanceKind::hemispherical:
        return job.template run<IlluminanceKind::hemispherical, weighting>();
    case IlluminanceKind::mean_spherical:
        return job.template run<IlluminanceKind::mean_spherical, weighting>();
    }
}

template <class Job>
void run_job(IlluminanceKind kind, Weighting weighting, const Job& job) noexcept {
    if (weighting == Weighting::balanced)
        run_kind<Weighting::balanced>(kind, job);
    else
        run_kind<Weighting::alone>(kind, job);
}

} // namespace

/// Behind one door each for every instruction set.
void weigh_cut_in(IlluminanceKind kind,
                  Weighting weighting,
                  std::span<const ClusterRow> clusters,
                  std::span<const VertexBlock> blocks,
                  std::span<const std::uint32_t> leaves,
                  std::span<const KernelReceiver> receivers,
                  float* u,
                  float* sums) {
    run_job(kind, weighting, CutJob{clusters, blocks, leaves, receivers, u, sums});
}

void weigh_rows_in(IlluminanceKind kind,
                   Weighting weighting,
                   std::span<const RowTask> tasks,
                   std::span<const KernelReceiver> receivers,
                   float* u) {
    run_job(kind, weighting, RowJob{tasks, receivers, u});
}

} // namespace HWY_NAMESPACE
} // namespace isolux

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isolux {

HWY_EXPORT(weigh_cut_in);
HWY_EXPORT(weigh_rows_in);

void weigh_cut(std::span<const ClusterRow> clusters,
               std::span<const VertexBlock> blocks,
               std::span<const std::uint32_t> leaves,
               IlluminanceKind kind,
               Weighting weighting,
               std::span<const KernelReceiver> receivers,
               std::span<float> u,
               std::span<float> sums) noexcept {
    ISOLUX_EXPECT(sums.size() >= receivers.size() * (clusters.size() + leaves.size()));
    ISOLUX_EXPECT(u.size()
                  >= receivers.size() * (clusters.size() + leaves.size()) * ClusterRow::size);
    HWY_DYNAMIC_DISPATCH(weigh_cut_in)
    (kind, weighting, clusters, blocks, leaves, receivers, u.data(), sums.data());
}

void weigh_rows(std::span<const RowTask> tasks,
                IlluminanceKind kind,
                Weighting weighting,
                std::span<const KernelReceiver> receivers,
                std::span<float> u) noexcept {
    ISOLUX_EXPECT(u.size() >= tasks.size() * ClusterRow::size);
    HWY_DYNAMIC_DISPATCH(weigh_rows_in)(kind, weighting, tasks, receivers, u.data());
}

} // namespace isolux
#endif
