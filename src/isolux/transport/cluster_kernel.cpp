#include <cmath>

#include "isolux/base/check.h"
#include "isolux/transport/vertex_tree.h"

// This file is compiled once for every instruction set; the widest that the machine has is
// called.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "isolux/transport/cluster_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "isolux/transport/vertex_terms.inl"

HWY_BEFORE_NAMESPACE();

namespace isolux {
namespace HWY_NAMESPACE {
namespace {

constexpr std::size_t lanes = ClusterRow::size;

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

/// Standard deviations of the place along the axes, and what follows from them.
template <class V> struct Spread {
    V sx, sy, sz;
    V variance;  ///< of the place
    V along_ray; ///< that along the way, times the distance squared
    V axis_ray;  ///< covariance of axis and way, times the distance
};

template <class D, class V = hn::Vec<D>>
Spread<V> spread_of(D d,
                    const ClusterRow& r,
                    std::size_t i,
                    const KernelReceiver& p,
                    const Way<V>& w) noexcept {
    Spread<V> s;
    s.sx = hn::Load(d, r.sx.data() + i);
    s.sy = hn::Load(d, r.sy.data() + i);
    s.sz = hn::Load(d, r.sz.data() + i);
    const V qx = hn::Mul(s.sx, s.sx), qy = hn::Mul(s.sy, s.sy), qz = hn::Mul(s.sz, s.sz);
    s.variance = hn::Add(hn::Add(qx, qy), qz);
    const V ex = hn::Mul(qx, w.x), ey = hn::Mul(qy, w.y), ez = hn::Mul(qz, w.z);
    s.along_ray = dot(ex, ey, ez, w.x, w.y, w.z);
    s.axis_ray =
        dot(hn::Set(d, p.axis[0]), hn::Set(d, p.axis[1]), hn::Set(d, p.axis[2]), ex, ey, ez);
    return s;
}

/// B of METHODS eq. (137): the positive part of the cosine at the vertices, times the distance.
template <class D, class V = hn::Vec<D>>
V cosine_of(D d, const ClusterRow& r, std::size_t i, const Way<V>& w) noexcept {
    const V mean = dot(hn::Load(d, r.nx.data() + i),
                       hn::Load(d, r.ny.data() + i),
                       hn::Load(d, r.nz.data() + i),
                       w.x,
                       w.y,
                       w.z);
    const V deviation = hn::MulAdd(
        hn::Load(d, r.wobble.data() + i), hn::Sqrt(w.square), hn::Load(d, r.depth.data() + i));
    return positive_part(
        d, hn::Sub(mean, hn::Load(d, r.lean.data() + i)), hn::Mul(deviation, deviation));
}

/// What `value` becomes where it bends by so much within the cluster, to second order: no less
/// than half.
template <class D, class V = hn::Vec<D>> V bent(D d, V value, V by) noexcept {
    return hn::Max(hn::Mul(hn::Set(d, 0.5F), value), hn::Add(value, by));
}

/// A of METHODS eq. (137), for planes.
template <class D, class V = hn::Vec<D>>
V ahead_of(D d,
           const ClusterRow& r,
           std::size_t i,
           const KernelReceiver& p,
           const Way<V>& w,
           const Spread<V>& s) noexcept {
    const V fx = hn::Set(d, std::abs(p.axis[0]));
    const V fy = hn::Set(d, std::abs(p.axis[1]));
    const V fz = hn::Set(d, std::abs(p.axis[2]));
    const V reach = dot(fx,
                        fy,
                        fz,
                        hn::Load(d, r.hx.data() + i),
                        hn::Load(d, r.hy.data() + i),
                        hn::Load(d, r.hz.data() + i));
    const V deviation = dot(fx, fy, fz, s.sx, s.sy, s.sz);
    const V ahead = hn::IfThenElse(hn::Lt(hn::Abs(w.ahead), reach),
                                   part_ahead(d, w.ahead, deviation),
                                   hn::Max(hn::Zero(d), w.ahead));
    const V share = hn::Sub(hn::Div(hn::Mul(hn::Set(d, 12.0F), s.along_ray), w.square),
                            hn::Add(s.variance, s.variance));
    const V bend = hn::MulAdd(ahead, share, hn::Mul(hn::Set(d, 4.0F), s.axis_ray));
    return bent(d, ahead, hn::Div(bend, w.square));
}

/// A row of clusters and one receiver, METHODS eq. (137).
template <IlluminanceKind kind, Weighting weighting>
void weigh_row(const ClusterRow& r, const KernelReceiver& p, float* u) noexcept {
    const hn::CappedTag<float, lanes> d;
    using V = hn::Vec<decltype(d)>;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const Way<V> w = way_to(d, p, r.x.data() + i, r.y.data() + i, r.z.data() + i);
        const Spread<V> s = spread_of(d, r, i, p, w);
        const V cosine = cosine_of(d, r, i, w);
        Terms<V> t;
        if constexpr (kind == IlluminanceKind::planar) {
            t = terms_of_plane(d, w, ahead_of(d, r, i, p, w, s), cosine);
        } else {
            t = terms_of_body<kind>(d, p, w, cosine, s.variance, [&](V mean) {
                return positive_part(d, mean, hn::Mul(hn::Set(d, 4.0F), s.variance));
            });
            const V share = hn::Sub(hn::Div(hn::Mul(hn::Set(d, 7.5F), s.along_ray), w.square),
                                    hn::Mul(hn::Set(d, 1.5F), s.variance));
            t.numerator = bent(d, t.numerator, hn::Mul(t.numerator, hn::Div(share, w.square)));
        }
        hn::StoreU(
            weigh<weighting>(d, p, t, r.strength.data() + i, r.rival.data() + i), d, u + i);
    }
}

/// A row of single vertices.
template <IlluminanceKind kind, Weighting weighting>
void weigh_row(const VertexBlock& b,
               std::size_t row,
               const KernelReceiver& p,
               float* u) noexcept {
    const hn::CappedTag<float, lanes> d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d))
        hn::StoreU(weigh_vertices_at<kind, weighting>(d, b, lanes * row + i, p), d, u + i);
}

/// In the same order for any width of the registers.
float sum_of(const float* u) noexcept {
    std::array<float, 4> s{};
    for (std::size_t k = 0; k < 4; ++k)
        s[k] = (u[k] + u[k + 4]) + (u[k + 8] + u[k + 12]);
    return (s[0] + s[1]) + (s[2] + s[3]);
}

/// Rows outside, receivers inside: a row stays in the nearest cache for all of them.
template <IlluminanceKind kind, Weighting weighting> void run(const CutTask& t) noexcept {
    const std::size_t rows = t.clusters.size() + t.leaves.size();
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t p = 0; p < t.receivers.size(); ++p) {
            const std::size_t place = p * rows + r;
            float* u = t.u.data() + place * lanes;
            if (r < t.clusters.size()) {
                weigh_row<kind, weighting>(t.clusters[r], t.receivers[p], u);
            } else {
                const std::uint32_t leaf = t.leaves[r - t.clusters.size()];
                weigh_row<kind, weighting>(t.blocks[leaf / VertexBlock::most_rows],
                                           leaf % VertexBlock::most_rows,
                                           t.receivers[p],
                                           u);
            }
            t.sums[place] = sum_of(u);
        }
}

template <IlluminanceKind kind, Weighting weighting> void run(const RowsTask& t) noexcept {
    for (std::size_t k = 0; k < t.rows.size(); ++k) {
        const RowOfTree& row = t.rows[k];
        const KernelReceiver& p = t.receivers[row.receiver];
        float* u = t.u.data() + k * lanes;
        if (row.clusters != nullptr)
            weigh_row<kind, weighting>(*row.clusters, p, u);
        else
            weigh_row<kind, weighting>(*row.block, row.row, p, u);
    }
}

template <Weighting weighting, class Task>
void run_kind(IlluminanceKind kind, const Task& t) noexcept {
    switch (kind) {
    case IlluminanceKind::planar:
        return run<IlluminanceKind::planar, weighting>(t);
    case IlluminanceKind::cylindrical:
        return run<IlluminanceKind::cylindrical, weighting>(t);
    case IlluminanceKind::semi_cylindrical:
        return run<IlluminanceKind::semi_cylindrical, weighting>(t);
    case IlluminanceKind::hemispherical:
        return run<IlluminanceKind::hemispherical, weighting>(t);
    case IlluminanceKind::mean_spherical:
        return run<IlluminanceKind::mean_spherical, weighting>(t);
    }
}

template <class Task> void run_task(const Task& t) noexcept {
    if (t.weighting == Weighting::balanced)
        run_kind<Weighting::balanced>(t.kind, t);
    else
        run_kind<Weighting::alone>(t.kind, t);
}

} // namespace

/// Behind one door each for every instruction set.
void weigh_cut_in(const CutTask& t) { run_task(t); }

void weigh_rows_in(const RowsTask& t) { run_task(t); }

} // namespace HWY_NAMESPACE
} // namespace isolux

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isolux {

HWY_EXPORT(weigh_cut_in);
HWY_EXPORT(weigh_rows_in);

void weigh_cut(const CutTask& t) noexcept {
    ISOLUX_EXPECT(t.sums.size() >= t.receivers.size() * (t.clusters.size() + t.leaves.size()));
    ISOLUX_EXPECT(t.u.size() >= t.receivers.size() * (t.clusters.size() + t.leaves.size())
                                    * ClusterRow::size);
    HWY_DYNAMIC_DISPATCH(weigh_cut_in)(t);
}

void weigh_rows(const RowsTask& t) noexcept {
    ISOLUX_EXPECT(t.u.size() >= t.rows.size() * ClusterRow::size);
    HWY_DYNAMIC_DISPATCH(weigh_rows_in)(t);
}

} // namespace isolux
#endif
