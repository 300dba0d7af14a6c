#include "isolux/transport/vertex_kernel.h"

#include <numbers>

#include "isolux/base/check.h"

// This file is compiled once for every instruction set; the widest that the machine has is
// called.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "isolux/transport/vertex_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace isolux {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float inverse_pi = std::numbers::inv_pi_v<float>;

/// Squared distance below which a vertex and a receiver count as touching, m2.
constexpr float least_distance_squared = 1e-12F;

/// Whether no vertex of the block can light the receiver: all lie behind its plane, or it lies
/// behind theirs.
bool is_dark(const VertexBlock& b, const KernelReceiver& p, bool is_planar) noexcept {
    float ahead = 0.0F; // farthest place of the box along the receiver's axis
    float above = 0.0F; // of the receiver over the lowest vertex along the common normal
    for (std::size_t k = 0; k < 3; ++k) {
        const float low = b.lower[k] - p.at[k];
        const float high = b.upper[k] - p.at[k];
        ahead += p.axis[k] * (p.axis[k] > 0.0F ? high : low);
        above -= b.common_normal[k] * (b.common_normal[k] > 0.0F ? low : high);
    }
    const bool have_normal =
        b.common_normal[0] != 0.0F || b.common_normal[1] != 0.0F || b.common_normal[2] != 0.0F;
    return (is_planar && ahead <= 0.0F) || (have_normal && above <= 0.0F);
}

/// One block and one receiver, lane by lane the same arithmetic for any width of the registers.
template <IlluminanceKind kind, Weighting weighting>
void weigh(const VertexBlock& b, const KernelReceiver& p, float* u, float* sums) noexcept {
    const hn::CappedTag<float, VertexBlock::columns> d;
    using V = hn::Vec<decltype(d)>;
    const V px = hn::Set(d, p.at[0]), py = hn::Set(d, p.at[1]), pz = hn::Set(d, p.at[2]);
    const V ax = hn::Set(d, -p.axis[0]), ay = hn::Set(d, -p.axis[1]),
            az = hn::Set(d, -p.axis[2]);
    const V rays = hn::Set(d, p.rays);
    const V zero = hn::Zero(d);
    const V least = hn::Set(d, least_distance_squared);
    for (std::size_t column = 0; column < VertexBlock::columns; column += hn::Lanes(d)) {
        V sum = zero;
        for (std::size_t row = 0; row < b.rows; ++row) {
            const std::size_t i = VertexBlock::columns * row + column;
            // from the vertex to the receiver
            const V dx = hn::Sub(px, hn::Load(d, b.x.data() + i));
            const V dy = hn::Sub(py, hn::Load(d, b.y.data() + i));
            const V dz = hn::Sub(pz, hn::Load(d, b.z.data() + i));
            const V d2 =
                hn::Max(least, hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))));
            // distance times the cosine at the vertex, and along the receiver's axis
            const V cv =
                hn::Max(zero,
                        hn::MulAdd(hn::Load(d, b.nx.data() + i),
                                   dx,
                                   hn::MulAdd(hn::Load(d, b.ny.data() + i),
                                              dy,
                                              hn::Mul(hn::Load(d, b.nz.data() + i), dz))));
            const V ca = hn::MulAdd(ax, dx, hn::MulAdd(ay, dy, hn::Mul(az, dz)));
            // METHODS eq. (60): strength numerator / (denominator + rival shared)
            V numerator, denominator, shared;
            if constexpr (kind == IlluminanceKind::planar) {
                numerator = hn::Mul(hn::Max(zero, ca), cv);
                denominator = hn::Mul(d2, d2);
                shared = numerator;
            } else {
                const V distance = hn::Sqrt(d2);
                denominator = hn::Mul(d2, distance);
                shared = hn::Mul(hn::Set(d, 0.25F), cv);
                V response = hn::Set(d, 0.25F);
                if constexpr (kind == IlluminanceKind::hemispherical)
                    response = hn::Mul(
                        response,
                        hn::Max(zero, hn::Add(hn::Set(d, 1.0F), hn::Div(ca, distance))));
                if constexpr (kind == IlluminanceKind::cylindrical
                              || kind == IlluminanceKind::semi_cylindrical) {
                    V side = hn::Sqrt(hn::Max(zero, hn::NegMulAdd(ca, ca, d2)));
                    if constexpr (kind == IlluminanceKind::semi_cylindrical) {
                        const V along =
                            hn::MulAdd(hn::Set(d, -p.across[0]),
                                       dx,
                                       hn::MulAdd(hn::Set(d, -p.across[1]),
                                                  dy,
                                                  hn::Mul(hn::Set(d, -p.across[2]), dz)));
                        side = hn::Max(zero, hn::Add(side, along));
                    }
                    response = hn::Div(hn::Mul(hn::Set(d, inverse_pi), side), distance);
                }
                numerator = hn::Mul(response, cv);
            }
            if constexpr (weighting == Weighting::balanced)
                denominator = hn::MulAdd(
                    hn::Load(d, b.rival.data() + i), hn::Mul(rays, shared), denominator);
            const V value =
                hn::Div(hn::Mul(hn::Load(d, b.strength.data() + i), numerator), denominator);
            hn::StoreU(value, d, u + i);
            sum = hn::Add(sum, value);
        }
        hn::StoreU(sum, d, sums + column);
    }
}

struct Task {
    const VertexBlock* blocks;
    std::size_t block_count;
    const KernelReceiver* receivers;
    std::size_t receiver_count;
    float* u;
    float* sums;
};

/// Blocks outside, receivers inside: a block stays in the nearest cache for all of them.
template <IlluminanceKind kind, Weighting weighting> void weigh_all(const Task& t) noexcept {
    for (std::size_t b = 0; b < t.block_count; ++b)
        for (std::size_t r = 0; r < t.receiver_count; ++r) {
            const std::size_t place = r * t.block_count + b;
            float* sums = t.sums + place * VertexBlock::columns;
            if (is_dark(t.blocks[b], t.receivers[r], kind == IlluminanceKind::planar))
                for (std::size_t c = 0; c < VertexBlock::columns; ++c)
                    sums[c] = 0.0F;
            else
                weigh<kind, weighting>(
                    t.blocks[b], t.receivers[r], t.u + place * VertexBlock::size, sums);
        }
}

template <Weighting weighting> void weigh_kind(IlluminanceKind kind, const Task& t) noexcept {
    switch (kind) {
    case IlluminanceKind::planar:
        return weigh_all<IlluminanceKind::planar, weighting>(t);
    case IlluminanceKind::cylindrical:
        return weigh_all<IlluminanceKind::cylindrical, weighting>(t);
    case IlluminanceKind::semi_cylindrical:
        return weigh_all<IlluminanceKind::semi_cylindrical, weighting>(t);
    case IlluminanceKind::hemispherical:
        return weigh_all<IlluminanceKind::hemispherical, weighting>(t);
    case IlluminanceKind::mean_spherical:
        return weigh_all<IlluminanceKind::mean_spherical, weighting>(t);
    }
}

void weigh_task(IlluminanceKind kind, Weighting weighting, const Task* t) noexcept {
    if (weighting == Weighting::balanced)
        weigh_kind<Weighting::balanced>(kind, *t);
    else
        weigh_kind<Weighting::alone>(kind, *t);
}

} // namespace

/// Behind one door for every instruction set.
void weigh_in(IlluminanceKind kind,
              Weighting weighting,
              std::span<const VertexBlock> blocks,
              std::span<const KernelReceiver> receivers,
              float* u,
              float* sums) {
    const Task task{blocks.data(), blocks.size(), receivers.data(), receivers.size(), u, sums};
    weigh_task(kind, weighting, &task);
}

const char* name_of_target() { return hwy::TargetName(HWY_TARGET); }

} // namespace HWY_NAMESPACE
} // namespace isolux

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace isolux {

HWY_EXPORT(weigh_in);
HWY_EXPORT(name_of_target);

void weigh_vertices(std::span<const VertexBlock> blocks,
                    IlluminanceKind kind,
                    Weighting weighting,
                    std::span<const KernelReceiver> receivers,
                    std::span<float> u,
                    std::span<float> column_sums) noexcept {
    ISOLUX_EXPECT(u.size() >= receivers.size() * blocks.size() * VertexBlock::size);
    ISOLUX_EXPECT(column_sums.size()
                  >= receivers.size() * blocks.size() * VertexBlock::columns);
    HWY_DYNAMIC_DISPATCH(weigh_in)
    (kind, weighting, blocks, receivers, u.data(), column_sums.data());
}

const char* vertex_kernel_instructions() noexcept {
    return HWY_DYNAMIC_DISPATCH(name_of_target)();
}

} // namespace isolux
#endif
