// What the kernels of vertices and of clusters share: METHODS eq. (60), lane by lane the same
// arithmetic for any width of the registers. Included once for every instruction set.

#if defined(ISOLUX_VERTEX_TERMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ISOLUX_VERTEX_TERMS_INL
#undef ISOLUX_VERTEX_TERMS_INL
#else
#define ISOLUX_VERTEX_TERMS_INL
#endif

#include <numbers>

#include <hwy/highway.h>

#include "isolux/transport/vertex_kernel.h"

HWY_BEFORE_NAMESPACE();

namespace isolux {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float inverse_pi = std::numbers::inv_pi_v<float>;

/// Squared distance below which a vertex and a receiver count as touching, m2.
constexpr float least_distance_squared = 1e-12F;

/// From a vertex, or the middle of a cluster, to a receiver.
template <class V> struct Way {
    V x, y, z;
    V square; ///< of the distance
    V ahead;  ///< how far the vertex lies along the receiver's axis
};

template <class V> V dot(V ax, V ay, V az, V bx, V by, V bz) noexcept {
    return hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz)));
}

template <class D, class V = hn::Vec<D>>
V along(D d, const std::array<float, 3>& a, const Way<V>& w) noexcept {
    return dot(hn::Set(d, -a[0]), hn::Set(d, -a[1]), hn::Set(d, -a[2]), w.x, w.y, w.z);
}

template <class D, class V = hn::Vec<D>>
Way<V> way_to(D d,
              const KernelReceiver& p,
              const float* x,
              const float* y,
              const float* z) noexcept {
    Way<V> w;
    w.x = hn::Sub(hn::Set(d, p.at[0]), hn::LoadU(d, x));
    w.y = hn::Sub(hn::Set(d, p.at[1]), hn::LoadU(d, y));
    w.z = hn::Sub(hn::Set(d, p.at[2]), hn::LoadU(d, z));
    w.square = hn::Max(hn::Set(d, least_distance_squared), dot(w.x, w.y, w.z, w.x, w.y, w.z));
    w.ahead = along(d, p.axis, w);
    return w;
}

/// METHODS eq. (60): u = strength numerator / (denominator + rival rays shared)
template <class V> struct Terms {
    V numerator, denominator, shared;
};

template <class D, class V = hn::Vec<D>>
Terms<V> terms_of_plane(D, const Way<V>& w, V ahead, V cosine) noexcept {
    const V both = hn::Mul(ahead, cosine);
    return {both, hn::Mul(w.square, w.square), both};
}

/// Of receivers other than planes. @param cosine    at the vertex, times the distance
/// @param spread    variance of the place, m2
/// @param positive  the positive part of something, in the mean over places so spread
template <IlluminanceKind kind, class D, class V, class Positive>
Terms<V> terms_of_body(D d,
                       const KernelReceiver& p,
                       const Way<V>& w,
                       V cosine,
                       V spread,
                       const Positive& positive) noexcept {
    const V distance = hn::Sqrt(w.square);
    V response = hn::Set(d, 0.25F);
    if constexpr (kind == IlluminanceKind::hemispherical)
        response = hn::Mul(response, hn::Div(positive(hn::Add(distance, w.ahead)), distance));
    if constexpr (kind == IlluminanceKind::cylindrical
                  || kind == IlluminanceKind::semi_cylindrical) {
        V side = hn::Sqrt(
            hn::Add(spread, hn::Max(hn::Zero(d), hn::NegMulAdd(w.ahead, w.ahead, w.square))));
        if constexpr (kind == IlluminanceKind::semi_cylindrical)
            side = positive(hn::Add(side, along(d, p.across, w)));
        response = hn::Div(hn::Mul(hn::Set(d, inverse_pi), side), distance);
    }
    return {hn::Mul(response, cosine),
            hn::Mul(w.square, distance),
            hn::Mul(hn::Set(d, 0.25F), cosine)};
}

/// u of the terms. @param strength, rival  where the lanes' values lie
template <Weighting weighting, class D, class V = hn::Vec<D>>
V weigh(D d,
        const KernelReceiver& p,
        const Terms<V>& t,
        const float* strength,
        const float* rival) noexcept {
    V denominator = t.denominator;
    if constexpr (weighting == Weighting::balanced)
        denominator = hn::MulAdd(
            hn::LoadU(d, rival), hn::Mul(hn::Set(d, p.rays), t.shared), denominator);
    return hn::Div(hn::Mul(hn::LoadU(d, strength), t.numerator), denominator);
}

/// u of the vertices from place i of a block on.
template <IlluminanceKind kind, Weighting weighting, class D, class V = hn::Vec<D>>
V weigh_vertices_at(D d,
                    const VertexBlock& b,
                    std::size_t i,
                    const KernelReceiver& p) noexcept {
    const V zero = hn::Zero(d);
    const auto positive = [&](V x) { return hn::Max(zero, x); };
    const Way<V> w = way_to(d, p, b.x.data() + i, b.y.data() + i, b.z.data() + i);
    const V cosine = positive(dot(hn::LoadU(d, b.nx.data() + i),
                                  hn::LoadU(d, b.ny.data() + i),
                                  hn::LoadU(d, b.nz.data() + i),
                                  w.x,
                                  w.y,
                                  w.z));
    Terms<V> t;
    if constexpr (kind == IlluminanceKind::planar)
        t = terms_of_plane(d, w, positive(w.ahead), cosine);
    else
        t = terms_of_body<kind>(d, p, w, cosine, zero, positive);
    return weigh<weighting>(d, p, t, b.strength.data() + i, b.rival.data() + i);
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace isolux

HWY_AFTER_NAMESPACE();

#endif
