#include "isolux/transport/vertex_kernel.h"

#include "isolux/base/check.h"

// This file is compiled once for every instruction set; the widest that the machine has is
// called.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "isolux/transport/vertex_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "isolux/transport/vertex_terms.inl"

HWY_BEFORE_NAMESPACE();

namespace isolux {
namespace HWY_NAMESPACE {
namespace {

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

/// One block and one receiver, and the sums over its rows.
template <IlluminanceKind kind, Weighting weighting>
void weigh_block(const VertexBlock& b,
                 const KernelReceiver& p,
                 float* u,
                 float* sums) noexcept {
    const hn::CappedTag<float, VertexBlock::columns> d;
    for (std::size_t column = 0; column < VertexBlock::columns; column += hn::Lanes(d)) {
        auto sum = hn::Zero(d);
        for (std::size_t row = 0; row < b.rows; ++row) {
            const std::size_t i = VertexBlock::columns * row + column;
            const auto value = weigh_vertices_at<kind, weighting>(d, b, i, p);
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
                weigh_block<kind, weighting>(
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
