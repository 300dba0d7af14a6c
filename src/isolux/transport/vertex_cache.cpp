#include "isolux/transport/vertex_cache.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "isolux/base/parallel.h"
#include "isolux/transport/preference.h"

namespace isolux {

namespace {

// METHODS "Memory"
static_assert(sizeof(PathVertex) == 120 && sizeof(VertexHand) == 36 * VertexHand::size);

/// Paths one task walks.
constexpr std::size_t paths_per_task = 64;

/// A thread keeps so many tasks' slots for its next batch: fresh memory costs about a sixth
/// of the time of the walks.
constexpr std::size_t most_kept = 1024;

/// Picks take their number as if they were these paths: beyond all branches.
constexpr std::uint64_t pick_path = 1ULL << 63U;

/// Numbers of the vertices by cell, by counting; those of one cell stay in path order.
/// @return  valid until the thread sorts again
std::span<const std::uint32_t> sort_by_cell(const std::vector<PathVertex>& vertices,
                                            const Bounds& bounds) {
    thread_local std::vector<std::uint32_t> keys, starts, sorted;
    const CellOrder order(bounds);
    keys.resize(vertices.size());
    starts.assign(CellOrder::keys + 1, 0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        keys[i] = order.key(vertices[i].position, vertices[i].normal);
        ++starts[keys[i] + 1];
    }
    for (std::size_t k = 0; k < CellOrder::keys; ++k)
        starts[k + 1] += starts[k];
    sorted.resize(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        sorted[starts[keys[i]]++] = static_cast<std::uint32_t>(i);
    return sorted;
}

/// n2/n1 of METHODS eq. (10) with (144).
double ratio_of(const VertexCache& cache, std::size_t vertex, const EffectiveCounts& counts) {
    const PathVertex& v = cache.vertices[vertex];
    if (v.is_first)
        return counts.gather_first / counts.paths;
    const double even = counts.gather_later / counts.vertices;
    return v.back == 0 ? even
                       : even
                             * preference(counts.area * v.density
                                          / cache.vertices[vertex - v.back].continuation);
}

/// METHODS eq. (60): what the gather rays do beside the chain, m2.
float rival_of(const VertexCache& cache, std::size_t vertex, const EffectiveCounts& counts) {
    constexpr double most = 1e30;
    const double rival =
        ratio_of(cache, vertex, counts) / (std::numbers::pi * cache.vertices[vertex].density);
    return static_cast<float>(rival < most ? rival : most);
}

/// Where a vertex lies and faces. @param row  a block or a hand
template <class Row>
void put_geometry(Row& row, std::size_t place, const PathVertex& v, const Point3& centre) {
    const Vector3 p = v.position - centre;
    row.x[place] = static_cast<float>(p.x);
    row.y[place] = static_cast<float>(p.y);
    row.z[place] = static_cast<float>(p.z);
    row.nx[place] = static_cast<float>(v.normal.x());
    row.ny[place] = static_cast<float>(v.normal.y());
    row.nz[place] = static_cast<float>(v.normal.z());
}

void put(VertexBlock& block,
         std::size_t place,
         const VertexCache& cache,
         std::size_t vertex,
         const EffectiveCounts& counts) noexcept {
    const PathVertex& v = cache.vertices[vertex];
    put_geometry(block, place, v, cache.centre);
    block.strength[place] = static_cast<float>(luminance_sum(v.radiant));
    block.rival[place] = rival_of(cache, vertex, counts);
}

/// The box and the common normal, from which the kernel sees whether a block is dark.
void find_bounds(VertexBlock& block, std::span<const std::size_t> places) noexcept {
    const std::size_t first = places.front();
    block.lower = block.upper = {block.x[first], block.y[first], block.z[first]};
    block.common_normal = {block.nx[first], block.ny[first], block.nz[first]};
    for (const std::size_t i : places) {
        const std::array<float, 3> p{block.x[i], block.y[i], block.z[i]};
        for (std::size_t k = 0; k < 3; ++k) {
            block.lower[k] = std::min(block.lower[k], p[k]);
            block.upper[k] = std::max(block.upper[k], p[k]);
        }
        if (std::array<float, 3>{block.nx[i], block.ny[i], block.nz[i]} != block.common_normal)
            block.common_normal = {};
    }
}

/// METHODS eq. (122): whether a chain came to a vertex straight from nearby.
bool is_close(const VertexCache& cache, std::size_t vertex) noexcept {
    const PathVertex& v = cache.vertices[vertex];
    const double radius = cache.close.radius;
    return v.back != 0 && v.density != after_mirror
           && length_squared(v.position - cache.vertices[vertex - v.back].position)
                  < radius * radius;
}

/// What points may leave to their rays: bits of VertexTree::left.
std::uint8_t left_to_rays(const VertexCache& cache, std::size_t vertex) noexcept {
    const PathVertex& v = cache.vertices[vertex];
    if (v.is_hidden)
        return 0;
    const bool is_mirrored =
        cache.mirrored.radius > 0.0 && v.density == after_mirror && !v.is_first;
    return static_cast<std::uint8_t>((is_close(cache, vertex) ? VertexTree::close : 0U)
                                     | (is_mirrored ? VertexTree::mirrored : 0U));
}

void list(VertexCache& cache, std::uint8_t left, std::size_t vertex, std::size_t place) {
    const Point3& position = cache.vertices[vertex].position;
    if ((left & VertexTree::close) != 0)
        cache.close.add(position, place);
    if ((left & VertexTree::mirrored) != 0)
        cache.mirrored.add(position, place);
}

void end_lists(VertexCache& cache) {
    for (LeftVertices* v : {&cache.close, &cache.mirrored})
        v->first.resize(cache.blocks.size() + 1, static_cast<std::uint32_t>(v->all.size()));
}

/// Fills the blocks row by row, so that clusters of the tree are rows, and builds it.
void pack_for_tree(VertexCache& cache, const Bounds& bounds, const EffectiveCounts& counts) {
    cache.vertex_at = sort_along_curve(cache.vertices, bounds);
    const std::size_t n = cache.vertex_at.size();
    cache.blocks.resize((n + VertexBlock::size - 1) / VertexBlock::size);
    cache.vertex_at.resize(cache.blocks.size() * VertexBlock::size, 0);
    std::vector<std::uint8_t> left(cache.vertex_at.size(), 0);
    for_each_index(cache.blocks.size(), 16, [&](std::size_t b) {
        std::array<std::size_t, VertexBlock::size> places{};
        VertexBlock& block = cache.blocks[b];
        const std::size_t first = b * VertexBlock::size;
        const std::size_t count = std::min(VertexBlock::size, n - first);
        block.rows = static_cast<std::uint32_t>((count + VertexBlock::columns - 1)
                                                / VertexBlock::columns);
        for (std::size_t i = 0; i < count; ++i) {
            places[i] = i;
            const std::size_t vertex = cache.vertex_at[first + i];
            put(block, i, cache, vertex, counts);
            left[first + i] = left_to_rays(cache, vertex);
        }
        find_bounds(block, std::span(places).first(count));
    });
    for (std::size_t i = 0; i < n; ++i)
        list(cache, left[i], cache.vertex_at[i], i);
    end_lists(cache);
    cache.tree = build_vertex_tree(cache.blocks, n);
    cache.tree.left = std::move(left);
}

/// Fills the blocks, each column by column, so that the running sum follows the sorted order.
void pack(VertexCache& cache, const Bounds& bounds, const EffectiveCounts& counts) {
    const std::span<const std::uint32_t> sorted = sort_by_cell(cache.vertices, bounds);
    const std::size_t n = sorted.size();
    cache.blocks.resize((n + VertexBlock::size - 1) / VertexBlock::size);
    cache.vertex_at.assign(cache.blocks.size() * VertexBlock::size, 0);
    std::array<std::size_t, VertexBlock::size> places{};
    for (std::size_t b = 0; b < cache.blocks.size(); ++b) {
        VertexBlock& block = cache.blocks[b];
        const std::size_t first = b * VertexBlock::size;
        const std::size_t count = std::min(VertexBlock::size, n - first);
        const std::size_t rows = (count + VertexBlock::columns - 1) / VertexBlock::columns;
        block.rows = static_cast<std::uint32_t>(rows);
        for (std::size_t i = 0; i < count; ++i) {
            places[i] = VertexBlock::columns * (i % rows) + i / rows;
            cache.vertex_at[first + places[i]] = sorted[first + i];
            const std::size_t vertex = sorted[first + i];
            put(block, places[i], cache, vertex, counts);
            list(cache, left_to_rays(cache, vertex), vertex, first + places[i]);
        }
        find_bounds(block, std::span(places).first(count));
    }
    end_lists(cache);
}

/// Systematic draws along the running sum of what the vertices carry, as many as there would be
/// if all carried the same.
void draw_picks(VertexCache& cache, double carried_by_a_path, double offset) {
    for (const PathVertex& v : cache.vertices)
        cache.carried += v.carried;
    const double wanted = std::max(1.0, std::floor(cache.carried / carried_by_a_path));
    const double step = cache.carried / wanted;
    double running = 0.0;
    for (std::uint32_t i = 0; i < cache.vertices.size(); ++i) {
        running += cache.vertices[i].carried;
        while ((static_cast<double>(cache.picks.size()) + offset) * step < running)
            cache.picks.push_back(i);
    }
}

/// Vertices as they are offered to who wants one at random.
void deal_hands(VertexCache& cache) {
    cache.hands.resize((cache.offered() + VertexHand::size - 1) / VertexHand::size);
    for (std::size_t k = 0; k < cache.offered(); ++k) {
        VertexHand& hand = cache.hands[k / VertexHand::size];
        const std::size_t i = k % VertexHand::size;
        const std::size_t vertex = cache.offer(k);
        const PathVertex& v = cache.vertices[vertex];
        put_geometry(hand, i, v, cache.centre);
        hand.strength[i] =
            static_cast<float>(cache.share_of(vertex) * luminance_sum(v.radiant));
        hand.continuation[i] = static_cast<float>(v.continuation);
        hand.vertex[i] = static_cast<std::uint32_t>(vertex);
        cache.has_hidden = cache.has_hidden || v.is_hidden;
    }
}

} // namespace

void LeftVertices::add(const Point3& position, std::size_t place) {
    first.resize(std::max(first.size(), place / VertexBlock::size + 1),
                 static_cast<std::uint32_t>(all.size()));
    all.push_back({position, static_cast<std::uint32_t>(place)});
}

void VertexCache::clear() noexcept {
    VertexCache fresh;
    const auto keep = [](auto& empty, auto& memory) {
        memory.clear();
        empty = std::move(memory);
    };
    keep(fresh.vertices, vertices);
    keep(fresh.blocks, blocks);
    keep(fresh.vertex_at, vertex_at);
    keep(fresh.hands, hands);
    keep(fresh.picks, picks);
    keep(fresh.close.all, close.all);
    keep(fresh.close.first, close.first);
    keep(fresh.mirrored.all, mirrored.all);
    keep(fresh.mirrored.first, mirrored.first);
    *this = std::move(fresh);
}

VertexCache build_vertex_cache(const Scene& scene,
                               const Emission& emission,
                               const PathRandomness& random,
                               std::uint64_t first,
                               std::size_t count,
                               const EffectiveCounts& counts,
                               const PathImportance& importance,
                               const Roulette& roulette,
                               Weighing weighing,
                               VertexCache used) {
    VertexCache cache = std::move(used);
    cache.clear();
    cache.paths = count;
    cache.close.radius = counts.corner;
    cache.mirrored.radius = counts.caustic;
    cache.centre = midpoint(scene.bounds.lower, scene.bounds.upper);
    if (emission.total_flux() <= 0.0 || count == 0)
        return cache;

    // Generate: every task into its own slot, then joined in path order.
    const std::size_t tasks = (count + paths_per_task - 1) / paths_per_task;
    thread_local std::vector<std::vector<PathVertex>> kept;
    std::vector<std::vector<PathVertex>> slots = std::exchange(kept, {});
    slots.resize(std::max(slots.size(), tasks));
    std::vector<FluxTally> tallies(tasks);
    for_each_index(tasks, 1, [&](std::size_t t) {
        slots[t].clear();
        slots[t].reserve(4 * paths_per_task);
        const std::size_t end = std::min(count, (t + 1) * paths_per_task);
        for (std::size_t i = t * paths_per_task; i < end; ++i) {
            const FluxTally f = walk_light_path(scene,
                                                emission,
                                                random,
                                                first + i,
                                                slots[t],
                                                importance,
                                                roulette,
                                                counts.images);
            tallies[t].absorbed += f.absorbed;
            tallies[t].escaped += f.escaped;
            tallies[t].rays += f.rays;
        }
    });
    std::size_t vertices = 0;
    for (std::size_t t = 0; t < tasks; ++t)
        vertices += slots[t].size();
    cache.vertices.reserve(vertices);
    for (std::size_t t = 0; t < tasks; ++t) {
        cache.vertices.insert(cache.vertices.end(), slots[t].begin(), slots[t].end());
        cache.flux.absorbed += tallies[t].absorbed;
        cache.flux.escaped += tallies[t].escaped;
        cache.flux.rays += tallies[t].rays;
    }
    slots.resize(std::min(slots.size(), most_kept));
    kept = std::move(slots);
    if (!importance.is_even() && !cache.empty())
        draw_picks(cache, emission.total_flux(), random(pick_path + first, 0));
    deal_hands(cache);
    if (weighing == Weighing::tree)
        pack_for_tree(cache, scene.bounds, counts);
    else
        pack(cache, scene.bounds, counts);
    return cache;
}

} // namespace isolux
