#include "isolux/transport/vertex_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "isolux/base/parallel.h"

namespace isolux {

namespace {

// ---- order ---------------------------------------------------------------------------------

constexpr std::uint32_t curve_bits = 12; ///< of each of two coordinates
constexpr std::uint32_t layer_bits = 5;

/// Where a place lies on Hilbert's curve through a square of 2^curve_bits cells a side.
std::uint32_t along_hilbert_curve(std::uint32_t x, std::uint32_t y) noexcept {
    std::uint32_t place = 0;
    for (std::uint32_t s = 1U << (curve_bits - 1); s > 0; s >>= 1U) {
        const std::uint32_t right = (x & s) != 0 ? 1U : 0U;
        const std::uint32_t above = (y & s) != 0 ? 1U : 0U;
        place = place << 2U | ((3U * right) ^ above);
        if (above == 0) { // turn the quarter so that the curve enters and leaves it at a side
            if (right != 0) {
                x = ~x;
                y = ~y;
            }
            std::swap(x, y);
        }
    }
    return place;
}

/// Key of the order: facing, layer along it, place on the curve across it.
class CurveOrder {
public:
    explicit CurveOrder(const Bounds& bounds) : lower_(bounds.lower) {
        const Vector3 size = bounds.upper - bounds.lower;
        const double longest = std::max({size.x, size.y, size.z, 1e-9});
        // one measure for all axes: cells are squares
        scale_ = (1.0 - 1e-9) / longest;
    }

    [[nodiscard]] std::uint32_t key(const Point3& at, const UnitVector3& n) const noexcept {
        const Vector3 p = scale_ * (at - lower_);
        const double ax = std::abs(n.x()), ay = std::abs(n.y()), az = std::abs(n.z());
        if (az >= ax && az >= ay)
            return key(n.z() < 0.0 ? 0U : 1U, p.z, p.x, p.y);
        if (ax >= ay)
            return key(n.x() < 0.0 ? 2U : 3U, p.x, p.y, p.z);
        return key(n.y() < 0.0 ? 4U : 5U, p.y, p.z, p.x);
    }

private:
    static std::uint32_t cell(double t, double cells) noexcept {
        return static_cast<std::uint32_t>(std::clamp(cells * t, 0.0, cells - 1.0));
    }

    static std::uint32_t key(std::uint32_t facing, double along, double x, double y) noexcept {
        constexpr double cells = 1U << curve_bits;
        constexpr double layers = (1U << layer_bits) - 1U;
        // Surfaces like to lie at whole parts of a room; borders of layers do not.
        const std::uint32_t layer = cell(along + 0.5 / layers, layers);
        return facing << (layer_bits + 2 * curve_bits) | layer << (2 * curve_bits)
               | along_hilbert_curve(cell(x, cells), cell(y, cells));
    }

    Point3 lower_;
    double scale_ = 0.0;
};

struct Keyed {
    std::uint32_t key;
    std::uint32_t number;
};

/// Three rounds of counting; equal keys stay in order.
void sort_by_key(std::vector<Keyed>& items) {
    constexpr std::uint32_t digit = 11;
    std::vector<Keyed> other(items.size());
    for (std::uint32_t shift = 0; shift < 32; shift += digit) {
        std::array<std::uint32_t, (1U << digit) + 1> starts{};
        const auto of = [&](const Keyed& k) { return k.key >> shift & ((1U << digit) - 1U); };
        for (const Keyed& k : items)
            ++starts[of(k) + 1];
        for (std::size_t i = 1; i < starts.size(); ++i)
            starts[i] += starts[i - 1];
        for (const Keyed& k : items)
            other[starts[of(k)]++] = k;
        std::swap(items, other);
    }
}

// ---- clusters ------------------------------------------------------------------------------

/// What is known of a cluster, or of one vertex.
struct Cluster {
    Vector3 mean;          ///< position
    Vector3 variance;      ///< of it, axis by axis
    Vector3 lower, upper;  ///< box of the positions
    Vector3 normal;        ///< mean
    Vector3 common;        ///< the normal that all share, or 0
    double strength = 0.0; ///< sum
    double rival = 0.0;
    double lean = 0.0, depth = 0.0, wobble = 0.0, lowest = 0.0;
};

Vector3 squares(const Vector3& v) noexcept { return {v.x * v.x, v.y * v.y, v.z * v.z}; }

Vector3 lesser(const Vector3& a, const Vector3& b) noexcept {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

Vector3 greater(const Vector3& a, const Vector3& b) noexcept {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// From the mean to the farther side of the box.
Vector3 reach_of(const Cluster& c) noexcept {
    return greater(c.mean - c.lower, c.upper - c.mean);
}

/// Means, and deviations that are nowhere too small.
Cluster unite(std::span<const Cluster> members) noexcept {
    Cluster u = members.front();
    if (members.size() == 1)
        return u;
    u.strength = 0.0;
    for (const Cluster& m : members)
        u.strength += m.strength;
    // Without light their places still count.
    const auto share = [&](const Cluster& m) {
        return u.strength > 0.0 ? m.strength / u.strength
                                : 1.0 / static_cast<double>(members.size());
    };
    u.mean = u.normal = u.variance = {};
    for (const Cluster& m : members) {
        u.mean = u.mean + share(m) * m.mean;
        u.normal = u.normal + share(m) * m.normal;
        u.lower = lesser(u.lower, m.lower);
        u.upper = greater(u.upper, m.upper);
        if (m.common != u.common)
            u.common = {};
    }
    if (u.common != Vector3{})
        u.normal = u.common;
    const double least = std::max(1e-8, length_squared(reach_of(u)) / 32.0);
    double square = 0.0;
    double weight = 0.0; // of 1/(least + q)
    u.lean = 0.0;
    u.lowest = std::numeric_limits<double>::infinity();
    for (const Cluster& m : members) {
        const Vector3 step = m.mean - u.mean;
        u.variance = u.variance + share(m) * (m.variance + squares(step));
        const double lean = m.lean + dot(m.normal, step);
        const double depth = m.depth + m.wobble * length(step);
        u.lean += share(m) * lean;
        square += share(m) * (lean * lean + depth * depth);
        weight += share(m) / (least + m.rival);
        u.lowest = std::min(u.lowest, m.lowest + dot(m.normal, step));
    }
    u.rival = std::max(0.0, 1.0 / weight - least);
    u.depth = std::sqrt(std::max(0.0, square - u.lean * u.lean));
    u.wobble = 0.0;
    if (u.common == Vector3{}) {
        u.wobble = std::sqrt(std::max(0.0, 1.0 - length_squared(u.normal)));
        u.lowest = -std::numeric_limits<double>::infinity();
    }
    return u;
}

Cluster vertex(const VertexBlock& b, std::size_t i) noexcept {
    Cluster c;
    c.mean = c.lower = c.upper = {b.x[i], b.y[i], b.z[i]};
    c.normal = c.common = {b.nx[i], b.ny[i], b.nz[i]};
    c.strength = static_cast<double>(b.strength[i]);
    c.rival = static_cast<double>(b.rival[i]);
    return c;
}

void put(ClusterRow& row, std::size_t i, const Cluster& c) noexcept {
    const auto narrow = [](double x) { return static_cast<float>(x); };
    // Rounding breaks no bound: all is a little wider.
    constexpr double slack = 1.0 + 1e-6;
    const double size = std::max({std::abs(c.mean.x), std::abs(c.mean.y), std::abs(c.mean.z)});
    const double blur = 1e-6 * size;
    row.x[i] = narrow(c.mean.x), row.y[i] = narrow(c.mean.y), row.z[i] = narrow(c.mean.z);
    row.nx[i] = narrow(c.normal.x), row.ny[i] = narrow(c.normal.y),
    row.nz[i] = narrow(c.normal.z);
    row.strength[i] = narrow(c.strength);
    row.rival[i] = narrow(c.rival);
    row.sx[i] = narrow(slack * std::sqrt(c.variance.x));
    row.sy[i] = narrow(slack * std::sqrt(c.variance.y));
    row.sz[i] = narrow(slack * std::sqrt(c.variance.z));
    row.lean[i] = narrow(c.lean);
    row.depth[i] = narrow(slack * c.depth + blur);
    row.wobble[i] = narrow(slack * c.wobble);
    const Vector3 reach = slack * reach_of(c);
    row.hx[i] = narrow(reach.x + blur), row.hy[i] = narrow(reach.y + blur);
    row.hz[i] = narrow(reach.z + blur);
    row.lowest[i] = narrow(c.lowest - blur);
}

} // namespace

std::vector<std::uint32_t> sort_along_curve(std::span<const PathVertex> vertices,
                                            const Bounds& bounds) {
    const CurveOrder order(bounds);
    std::vector<Keyed> items(vertices.size());
    for_each_range(vertices.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            items[i] = {order.key(vertices[i].position, vertices[i].normal),
                        static_cast<std::uint32_t>(i)};
    });
    sort_by_key(items);
    std::vector<std::uint32_t> sorted;
    sorted.reserve(items.size());
    for (const Keyed& k : items)
        sorted.push_back(k.number);
    return sorted;
}

VertexTree build_vertex_tree(std::span<const VertexBlock> blocks, std::size_t count) {
    VertexTree tree;
    if (count == 0)
        return tree;
    std::vector<Cluster> below((count + VertexTree::leaf - 1) / VertexTree::leaf);
    for_each_range(below.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::array<Cluster, VertexTree::leaf> members;
        for (std::size_t k = begin; k < end; ++k) {
            const std::size_t first = k * VertexTree::leaf;
            const std::size_t n = std::min(VertexTree::leaf, count - first);
            for (std::size_t i = 0; i < n; ++i)
                members[i] = vertex(blocks[(first + i) / VertexBlock::size],
                                    (first + i) % VertexBlock::size);
            below[k] = unite(std::span(members).first(n));
        }
    });
    for (;;) {
        std::vector<ClusterRow>& rows =
            tree.levels.emplace_back((below.size() + ClusterRow::size - 1) / ClusterRow::size);
        for (std::size_t k = 0; k < below.size(); ++k)
            put(rows[k / ClusterRow::size], k % ClusterRow::size, below[k]);
        if (below.size() <= VertexTree::roots)
            return tree;
        std::vector<Cluster> above((below.size() + VertexTree::forks - 1) / VertexTree::forks);
        for_each_range(above.size(), 256, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                const std::size_t first = k * VertexTree::forks;
                const std::size_t n = std::min(VertexTree::forks, below.size() - first);
                above[k] = unite(std::span(below).subspan(first, n));
            }
        });
        below = std::move(above);
    }
}

} // namespace isolux
