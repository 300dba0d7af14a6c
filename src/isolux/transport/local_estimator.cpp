#include "isolux/transport/local_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "isolux/base/check.h"

// One source, compiled for several instruction sets; the loader takes the widest the machine
// has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ISOLUX_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ISOLUX_VECTOR_CLONES
#endif

namespace isolux {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Squared distance below which a vertex and the receiver count as touching, m2.
constexpr float least_distance_squared = 1e-12F;

struct KernelView {
    std::size_t count;
    const float *x, *y, *z, *nx, *ny, *nz, *strength, *density;
    float px, py, pz; // receiver
    float ax, ay, az; // its axis
    float rx, ry, rz; // semi-cylindrical: unit vector across the axis, towards the reference
};

/// The arithmetic of METHODS eq. (5) and (10), one vertex a turn, without branches.
template <IlluminanceKind kind, Weighting weighting>
[[gnu::always_inline]] inline void evaluate(const KernelView& v, float* __restrict u) noexcept {
    for (std::size_t i = 0; i < v.count; ++i) {
        const float dx = v.x[i] - v.px;
        const float dy = v.y[i] - v.py;
        const float dz = v.z[i] - v.pz;
        const float d2 = std::max(dx * dx + dy * dy + dz * dz, least_distance_squared);
        const float inverse = 1.0F / d2;
        const float root = std::sqrt(inverse);
        // cosine at the vertex and along the receiver's axis
        const float cv = std::max(0.0F, -(v.nx[i] * dx + v.ny[i] * dy + v.nz[i] * dz) * root);
        const float ca = (v.ax * dx + v.ay * dy + v.az * dz) * root;
        float response = 0.25F;
        if constexpr (kind == IlluminanceKind::planar)
            response = std::max(0.0F, ca);
        if constexpr (kind == IlluminanceKind::hemispherical)
            response = 0.25F * std::max(0.0F, 1.0F + ca);
        if constexpr (kind == IlluminanceKind::cylindrical)
            response = std::sqrt(std::max(0.0F, 1.0F - ca * ca)) / pi;
        if constexpr (kind == IlluminanceKind::semi_cylindrical) {
            const float along = (v.rx * dx + v.ry * dy + v.rz * dz) * root;
            response = std::max(0.0F, std::sqrt(std::max(0.0F, 1.0F - ca * ca)) + along) / pi;
        }
        const float solid = cv * inverse;
        float value = v.strength[i] * response * solid;
        if constexpr (weighting == Weighting::balanced) {
            const float gather =
                (kind == IlluminanceKind::planar ? response / pi : 0.25F / pi) * solid;
            const float chain = v.density[i];
            const float sum = chain + gather;
            value = sum > 0.0F ? value * (chain / sum) : 0.0F;
        }
        u[i] = value;
    }
}

#define ISOLUX_KERNEL(name, kind)                                                              \
    ISOLUX_VECTOR_CLONES void name##_alone(const KernelView& v, float* u) noexcept {           \
        evaluate<IlluminanceKind::kind, Weighting::alone>(v, u);                               \
    }                                                                                          \
    ISOLUX_VECTOR_CLONES void name##_balanced(const KernelView& v, float* u) noexcept {        \
        evaluate<IlluminanceKind::kind, Weighting::balanced>(v, u);                            \
    }

ISOLUX_KERNEL(planar, planar)
ISOLUX_KERNEL(cylindrical, cylindrical)
ISOLUX_KERNEL(semi_cylindrical, semi_cylindrical)
ISOLUX_KERNEL(hemispherical, hemispherical)
ISOLUX_KERNEL(spherical, mean_spherical)

/// Sum of 16 neighbours in a fixed order that maps to vector registers.
ISOLUX_VECTOR_CLONES void sum_blocks(const float* u, std::size_t blocks, float* sums) noexcept {
    for (std::size_t b = 0; b < blocks; ++b) {
        const float* p = u + 16 * b;
        std::array<float, 8> a{};
        for (std::size_t i = 0; i < 8; ++i)
            a[i] = p[i] + p[i + 8];
        sums[b] = ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
    }
}

KernelView make_view(const VertexCache& c, const Receiver& r, const Point3& at) noexcept {
    const Vector3 p = at - c.centre;
    const Vector3 a = r.axis;
    const Vector3 across = Vector3(r.reference) - dot(r.reference, r.axis) * a;
    const Vector3 f = length(across) > 0.0 ? Vector3(UnitVector3(across)) : Vector3{};
    const auto narrow = [](double v) { return static_cast<float>(v); };
    return {c.x.size(),
            c.x.data(),
            c.y.data(),
            c.z.data(),
            c.nx.data(),
            c.ny.data(),
            c.nz.data(),
            c.strength.data(),
            c.density.data(),
            narrow(p.x),
            narrow(p.y),
            narrow(p.z),
            narrow(a.x),
            narrow(a.y),
            narrow(a.z),
            narrow(f.x),
            narrow(f.y),
            narrow(f.z)};
}

/// Systematic draws along the running sum: vertices chosen in proportion to u, METHODS "Shared
/// cache", step 2.
std::size_t draw_vertices(std::span<const float> u,
                          std::span<const float> block_sums,
                          double total,
                          std::size_t draws,
                          double offset,
                          std::array<std::uint32_t, packet_size>& chosen) noexcept {
    const double step = total / static_cast<double>(draws);
    double running = 0.0;
    std::size_t block = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < draws; ++k) {
        const double target = (static_cast<double>(k) + offset) * step;
        while (block + 1 < block_sums.size() && running + block_sums[block] <= target)
            running += block_sums[block++];
        double inside = running;
        std::size_t last = 16 * block;
        for (std::size_t i = 16 * block; i < 16 * block + 16; ++i) {
            if (u[i] <= 0.0F)
                continue;
            last = i;
            inside += u[i];
            if (inside > target)
                break;
        }
        chosen[count++] = static_cast<std::uint32_t>(last);
    }
    return count;
}

} // namespace

Point3 clear_point(const Scene& scene, const Receiver& receiver) noexcept {
    if (receiver.kind != IlluminanceKind::planar)
        return receiver.point;
    return scene.caster.offset_point(receiver.point, receiver.axis);
}

void evaluate_unshadowed(const VertexCache& cache,
                         const Receiver& receiver,
                         const Point3& at,
                         Weighting weighting,
                         std::span<float> u) noexcept {
    ISOLUX_EXPECT(u.size() >= cache.x.size());
    const KernelView view = make_view(cache, receiver, at);
    const bool alone = weighting == Weighting::alone;
    switch (receiver.kind) {
    case IlluminanceKind::planar:
        return alone ? planar_alone(view, u.data()) : planar_balanced(view, u.data());
    case IlluminanceKind::cylindrical:
        return alone ? cylindrical_alone(view, u.data()) : cylindrical_balanced(view, u.data());
    case IlluminanceKind::semi_cylindrical:
        return alone ? semi_cylindrical_alone(view, u.data())
                     : semi_cylindrical_balanced(view, u.data());
    case IlluminanceKind::hemispherical:
        return alone ? hemispherical_alone(view, u.data())
                     : hemispherical_balanced(view, u.data());
    case IlluminanceKind::mean_spherical:
        return alone ? spherical_alone(view, u.data()) : spherical_balanced(view, u.data());
    }
}

Rgb gather_local_estimate(const Scene& scene,
                          const VertexCache& cache,
                          const Receiver& receiver,
                          Weighting weighting,
                          std::size_t draws,
                          double offset,
                          std::vector<float>& scratch) {
    ISOLUX_EXPECT(draws >= 1 && draws <= packet_size);
    if (cache.empty())
        return {};
    const std::size_t padded = cache.x.size();
    const std::size_t blocks = padded / 16;
    if (scratch.size() < padded + blocks)
        scratch.resize(padded + blocks);
    const std::span<float> u(scratch.data(), padded);
    const std::span<float> sums(scratch.data() + padded, blocks);
    const Point3 at = clear_point(scene, receiver);

    // Weigh every vertex.
    evaluate_unshadowed(cache, receiver, at, weighting, u);
    sum_blocks(u.data(), blocks, sums.data());
    double total = 0.0;
    for (const float s : sums)
        total += s;
    if (!(total > 0.0))
        return {};

    // Look at a few, drawn in proportion.
    std::array<std::uint32_t, packet_size> chosen{};
    const std::size_t count = draw_vertices(u, sums, total, draws, offset, chosen);
    std::array<SightSegment, packet_size> segments;
    std::array<float, packet_size> visible{};
    for (std::size_t k = 0; k < count; ++k)
        segments[k] = {at, cache.vertices[chosen[k]].position};
    scene.caster.transmittance16(
        std::span(segments).first(count), (1U << count) - 1U, std::span(visible).first(count));
    Rgb sum;
    for (std::size_t k = 0; k < count; ++k) {
        const Rgb& radiant = cache.vertices[chosen[k]].radiant;
        sum += (static_cast<double>(visible[k]) / luminance_sum(radiant)) * radiant;
    }
    return (total / (static_cast<double>(cache.paths) * static_cast<double>(count))) * sum;
}

} // namespace isolux
