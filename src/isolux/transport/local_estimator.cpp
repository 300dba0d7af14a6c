#include "isolux/transport/local_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "isolux/base/check.h"
#include "isolux/base/grow.h"

namespace isolux {

namespace {

constexpr std::size_t columns = VertexBlock::columns;

/// Weighs all vertices for points [first, last), all of one kind.
void weigh(const VertexCache& cache,
           std::span<const LocalPoint> points,
           std::size_t first,
           std::size_t last,
           Weighting weighting,
           LocalScratch& s) {
    const std::size_t blocks = cache.blocks.size();
    weigh_vertices(cache.blocks,
                   points[first].receiver->kind,
                   weighting,
                   std::span(s.receivers).subspan(first, last - first),
                   std::span(s.u).subspan(first * blocks * VertexBlock::size),
                   std::span(s.column_sums).subspan(first * blocks * columns));
}

void weigh_points(const VertexCache& cache,
                  std::span<const LocalPoint> points,
                  Weighting weighting,
                  LocalScratch& s) {
    const std::size_t blocks = cache.blocks.size();
    grow(s.u, points.size() * blocks * VertexBlock::size);
    grow(s.column_sums, points.size() * blocks * columns);
    s.receivers.clear();
    for (const LocalPoint& p : points)
        s.receivers.push_back(make_kernel_receiver(cache, *p.receiver, p.at, p.rays));
    for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
        const IlluminanceKind kind = points[first].receiver->kind;
        while (last < points.size() && points[last].receiver->kind == kind)
            ++last;
        weigh(cache, points, first, last, weighting, s);
    }
}

/// Whether anything in a block may be nearer to a place than that.
bool reaches(const VertexBlock& block, const Vector3& place, double radius) noexcept {
    const std::array<double, 3> p{place.x, place.y, place.z};
    double d2 = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double outside = std::max({static_cast<double>(block.lower[k]) - p[k],
                                         p[k] - static_cast<double>(block.upper[k]),
                                         0.0});
        d2 += outside * outside;
    }
    constexpr double rounding = 1e-3; // m, of the box
    return d2 < (radius + rounding) * (radius + rounding);
}

/// A point takes nothing from those vertices that are near. The sums of the columns they stand
/// in are made again, as the kernel does.
void leave(const VertexCache& cache,
           const LeftVertices& vertices,
           std::size_t point,
           const Point3& at,
           LocalScratch& s) {
    const std::size_t blocks = cache.blocks.size();
    float* u = s.u.data() + point * blocks * VertexBlock::size;
    float* sums = s.column_sums.data() + point * blocks * columns;
    const auto leave_one = [&](std::size_t b, const LeftVertices::Vertex& v) {
        float& sum = sums[b * columns + v.place % columns];
        // Where the sum is 0 the kernel may have left the block out.
        if (sum == 0.0F || length_squared(v.position - at) >= vertices.radius * vertices.radius)
            return;
        u[v.place] = 0.0F;
        sum = 0.0F;
        const float* column = u + b * VertexBlock::size + v.place % columns;
        for (std::size_t row = 0; row < cache.blocks[b].rows; ++row)
            sum += column[row * columns];
    };
    for (std::size_t b = 0; b < blocks; ++b)
        if (vertices.first[b] < vertices.first[b + 1]
            && reaches(cache.blocks[b], at - cache.centre, vertices.radius))
            for (std::size_t i = vertices.first[b]; i < vertices.first[b + 1]; ++i)
                leave_one(b, vertices.all[i]);
}

/// METHODS eq. (122), (145).
void leave_to_rays(const VertexCache& cache,
                   std::span<const LocalPoint> points,
                   LocalScratch& s) {
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (points[p].leaves_corners)
            leave(cache, cache.close, p, points[p].at, s);
        if (points[p].leaves_mirrored)
            leave(cache, cache.mirrored, p, points[p].at, s);
    }
}

/// Which of some numbers, `stride` apart, the running sum passes `left` with; never one that is
/// 0. @param left  what is left of it there  @pre one of them is not 0
template <std::size_t stride>
std::size_t pass(const float* values, std::size_t count, float& left) noexcept {
    const auto at = [values](std::size_t i) { return values[i * stride]; };
    std::size_t found = 0;
    float before = 0.0F;
    static_assert(columns == 16);
    if (count == columns) {        // by fours, without a branch that could be guessed wrong
        std::array<float, 4> to{}; // running sum up to a four
        for (std::size_t k = 1; k < 4; ++k) {
            const std::size_t f = 4 * (k - 1);
            to[k] = to[k - 1] + ((at(f) + at(f + 1)) + (at(f + 2) + at(f + 3)));
        }
        const std::size_t four = std::size_t{to[1] <= left} + std::size_t{to[2] <= left}
                                 + std::size_t{to[3] <= left};
        std::array<float, 4> in{to[four]};
        for (std::size_t k = 1; k < 4; ++k)
            in[k] = in[k - 1] + at(4 * four + k - 1);
        const std::size_t one = std::size_t{in[1] <= left} + std::size_t{in[2] <= left}
                                + std::size_t{in[3] <= left};
        found = 4 * four + one;
        before = in[one];
    } else {
        while (found + 1 < count && before + at(found) <= left)
            before += at(found++);
    }
    // Rounding may have led to one without light: the nearest one before it, else after it.
    while (found > 0 && at(found) <= 0.0F)
        --found;
    while (found + 1 < count && at(found) <= 0.0F)
        ++found;
    left -= before;
    return found;
}

/// The running sum of one point over all vertices, by blocks, columns and rows.
class RunningSum {
public:
    RunningSum(const LocalScratch& s,
               std::size_t point,
               const VertexCache& cache,
               std::vector<double>& block_sums)
        : cache_(&cache), u_(s.u.data() + point * cache.blocks.size() * VertexBlock::size),
          columns_(s.column_sums.data() + point * cache.blocks.size() * columns),
          block_sums_(&block_sums) {
        block_sums.resize(cache.blocks.size());
        for (std::size_t b = 0; b < cache.blocks.size(); ++b) {
            const float* c = columns_ + b * columns;
            std::array<double, 4> sum{};
            for (std::size_t k = 0; k < columns; k += 4)
                for (std::size_t j = 0; j < 4; ++j)
                    sum[j] += static_cast<double>(c[k + j]);
            block_sums[b] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
            total_ += block_sums[b];
        }
    }

    [[nodiscard]] double total() const noexcept { return total_; }

    /// The place in the blocks where the running sum passes `target`. Targets must ascend.
    [[nodiscard]] std::size_t find(double target) noexcept {
        while (block_ + 1 < block_sums_->size() && before_ + (*block_sums_)[block_] <= target)
            before_ += (*block_sums_)[block_++];
        const std::size_t block = with_light(block_);
        auto left = static_cast<float>(target - before_);
        const std::size_t column = pass<1>(columns_ + block * columns, columns, left);
        const std::size_t row = pass<columns>(
            u_ + block * VertexBlock::size + column, cache_->blocks[block].rows, left);
        return block * VertexBlock::size + row * columns + column;
    }

private:
    /// The block itself, or, where rounding led to one without light, the last one before it.
    [[nodiscard]] std::size_t with_light(std::size_t block) const noexcept {
        while (block > 0 && (*block_sums_)[block] <= 0.0)
            --block;
        while ((*block_sums_)[block] <= 0.0)
            ++block;
        return block;
    }

    const VertexCache* cache_;
    const float* u_;
    const float* columns_;
    const std::vector<double>* block_sums_;
    double total_ = 0.0;
    double before_ = 0.0;
    std::size_t block_ = 0;
};

/// Where the draws of every round begin, the first ones of all points first; points that are
/// done leave the round. Draw k of all points stand together: they look the same way.
void start_rounds(std::span<const LocalPoint> points, LocalScratch& s) {
    std::size_t most = 0;
    for (const LocalPoint& p : points)
        most = std::max(most, p.draws);
    s.rounds.assign(most + 1, 0);
    for (const LocalPoint& p : points) {
        ISOLUX_EXPECT(p.draws >= 1);
        for (std::size_t k = 0; k < p.draws; ++k)
            ++s.rounds[k + 1];
    }
    for (std::size_t k = 0; k < most; ++k)
        s.rounds[k + 1] += s.rounds[k];
    s.draws.assign(s.rounds[most], {});
    s.segments.resize(s.rounds[most]);
}

/// Aims the draws of a point. @param share_of  of draw k: its light over the colour of its
/// vertex; 0: it brings none
template <class Share>
void aim(const VertexCache& cache,
         std::span<const LocalPoint> points,
         std::size_t p,
         LocalScratch& s,
         Share&& share_of) {
    for (std::size_t k = 0; k < points[p].draws; ++k) {
        const std::size_t place = s.rounds[k]++;
        LocalDraw& draw = s.draws[place];
        draw.point = static_cast<std::uint32_t>(p);
        s.segments[place] = {points[p].at, points[p].at};
        const double share = share_of(k);
        if (share <= 0.0)
            continue;
        const PathVertex& v = cache.vertices[draw.vertex];
        draw.light = (share / luminance_sum(v.radiant)) * v.radiant;
        s.segments[place].b = v.position;
    }
}

/// Told early what will be read: the vertices lie anywhere in memory.
void choose(const VertexCache& cache, LocalDraw& draw, std::size_t place) noexcept {
    draw.vertex = cache.vertex_at[place];
    __builtin_prefetch(&cache.vertices[draw.vertex].position);
    __builtin_prefetch(&cache.vertices[draw.vertex].radiant);
}

/// Systematic draws along the running sum: vertices chosen in proportion to u, METHODS "Shared
/// cache", step 2.
void draw_vertices(const VertexCache& cache,
                   std::span<const LocalPoint> points,
                   LocalScratch& s) {
    for (std::size_t p = 0; p < points.size(); ++p) {
        RunningSum sum(s, p, cache, s.block_sums);
        const bool is_lit = sum.total() > 0.0;
        const double step = sum.total() / static_cast<double>(points[p].draws);
        const double share = step / static_cast<double>(cache.paths);
        for (std::size_t k = 0; is_lit && k < points[p].draws; ++k) {
            const double target = (static_cast<double>(k) + points[p].offset) * step;
            choose(cache, s.draws[s.rounds[k]], sum.find(target));
        }
        aim(cache, points, p, s, [&](std::size_t) { return is_lit ? share : 0.0; });
    }
}

/// The same by the tree, for runs of points of one kind.
void draw_vertices_by_tree(const VertexCache& cache,
                           std::span<const LocalPoint> points,
                           Weighting weighting,
                           LocalScratch& s) {
    const double paths = static_cast<double>(cache.paths);
    for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
        const IlluminanceKind kind = points[first].receiver->kind;
        s.tree_points.clear();
        std::size_t count = 0;
        for (; last < points.size() && points[last].receiver->kind == kind; ++last) {
            const LocalPoint& p = points[last];
            s.tree_points.push_back({make_kernel_receiver(cache, *p.receiver, p.at, p.rays),
                                     p.at,
                                     p.offset,
                                     p.draws,
                                     p.leaves_corners,
                                     p.leaves_mirrored});
            count += p.draws;
        }
        s.tree_draws.resize(count);
        draw_by_tree(cache, s.tree_points, kind, weighting, s.tree, s.tree_draws);
        const TreeDraw* own = s.tree_draws.data();
        for (std::size_t p = first; p < last; own += points[p++].draws) {
            for (std::size_t k = 0; k < points[p].draws; ++k)
                if (own[k].share > 0.0)
                    choose(cache, s.draws[s.rounds[k]], own[k].place);
            aim(cache, points, p, s, [&](std::size_t k) { return own[k].share / paths; });
        }
    }
}

} // namespace

Point3 clear_point(const Scene& scene, const Receiver& receiver) noexcept {
    if (receiver.kind != IlluminanceKind::planar)
        return receiver.point;
    return scene.caster.offset_point(receiver.point, receiver.axis);
}

KernelReceiver make_kernel_receiver(const VertexCache& cache,
                                    const Receiver& r,
                                    const Point3& at,
                                    double rays) noexcept {
    const auto narrow = [](const Vector3& v) {
        return std::array<float, 3>{
            static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    KernelReceiver k{narrow(at - cache.centre), narrow(r.axis), {}, static_cast<float>(rays)};
    if (r.kind == IlluminanceKind::semi_cylindrical) {
        const Vector3 across =
            Vector3(r.reference) - dot(r.reference, r.axis) * Vector3(r.axis);
        if (length(across) > 0.0)
            k.across = narrow(UnitVector3(across));
    }
    return k;
}

std::span<const LocalDraw> gather_local_estimates(const Scene& scene,
                                                  const VertexCache& cache,
                                                  std::span<const LocalPoint> points,
                                                  Weighting weighting,
                                                  LocalScratch& scratch,
                                                  std::span<Rgb> result) {
    ISOLUX_EXPECT(result.size() >= points.size());
    scratch.draws.clear();
    if (cache.empty() || points.empty())
        return {};
    start_rounds(points, scratch);
    if (cache.tree.empty()) {
        weigh_points(cache, points, weighting, scratch);
        leave_to_rays(cache, points, scratch);
        draw_vertices(cache, points, scratch);
    } else {
        draw_vertices_by_tree(cache, points, weighting, scratch);
    }

    // Look at them, sixteen at a time.
    std::array<float, packet_size> visible{};
    std::size_t kept = 0;
    for (std::size_t first = 0; first < scratch.draws.size(); first += packet_size) {
        const std::size_t n = std::min(packet_size, scratch.draws.size() - first);
        std::uint32_t wanted = 0;
        for (std::size_t i = 0; i < n; ++i)
            if (max_channel(scratch.draws[first + i].light) > 0.0)
                wanted |= 1U << i;
        scene.caster.transmittance16(std::span(scratch.segments).subspan(first, n),
                                     wanted,
                                     std::span(visible).first(n),
                                     RayOrder::scattered);
        for (std::size_t i = 0; i < n; ++i) {
            LocalDraw draw = scratch.draws[first + i];
            if ((wanted >> i & 1U) == 0 || visible[i] <= 0.0F)
                continue;
            draw.light = static_cast<double>(visible[i]) * draw.light;
            result[draw.point] += draw.light;
            scratch.draws[kept++] = draw;
        }
    }
    return std::span(scratch.draws).first(kept);
}

} // namespace isolux
