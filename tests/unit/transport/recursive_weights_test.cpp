// METHODS 7.2 row 16: for random complete paths the weights of all techniques, from the partial
// sums carried along the subpaths, equal those of the plain list of densities and sum to one.

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/recursive_weights.h"

namespace isolux {
namespace {

/// A path z_0 (luminaire), z_1, ..., z_{k-1}, x (receiver) as numbers only. Vertex 0 is on the
/// luminaire, vertex k is the receiver.
struct RandomPath {
    std::size_t k = 2;
    bool is_point_source = false;
    double direct = 1.0;          ///< of drawing z_0 from z_1
    double emit = 1.0;            ///< of z_0 and its direction
    double gather_pdf = 1.0;      ///< of the receiver's direction, 1/sr
    double light_paths = 1.0;     ///< n_l
    std::vector<double> distance; ///< of edge i: vertex i to i + 1
    std::vector<double> to_next;  ///< cosine at vertex i towards i + 1
    std::vector<double> to_last;  ///< cosine at vertex i towards i - 1
    std::vector<double> forward;  ///< at vertex i: density of i + 1's direction from i - 1
    std::vector<double> backward; ///< at vertex i: density of i - 1's direction from i + 1
    std::vector<bool> is_mirror;  ///< Dirac vertex: densities cancel, nothing connects
};

RandomPath make_path(std::mt19937& engine) {
    std::uniform_real_distribution<double> u(0.05, 1.0);
    RandomPath p;
    p.k = 2 + engine() % 6;
    p.is_point_source = engine() % 2 == 0;
    p.direct = 3.0 * u(engine);
    p.emit = u(engine);
    p.gather_pdf = u(engine);
    p.light_paths = 1.0 + static_cast<double>(engine() % 8);
    for (std::size_t i = 0; i <= p.k; ++i) {
        p.distance.push_back(0.1 + 4.0 * u(engine));
        p.to_next.push_back(u(engine));
        p.to_last.push_back(u(engine));
        p.forward.push_back(u(engine));
        p.backward.push_back(u(engine));
        const bool is_inner = i > 0 && i < p.k;
        p.is_mirror.push_back(is_inner && engine() % 4 == 0);
        if (p.is_mirror.back()) {
            p.forward.back() = p.backward.back() = u(engine);
            p.to_last.back() = p.to_next.back();
        }
    }
    if (p.is_point_source)
        p.to_next[0] = 1.0; // a point has no cosine
    return p;
}

/// Area density of vertex i + 1 from vertex i of a light path, and of i - 1 from i of a sensor
/// path.
double light_density(const RandomPath& p, std::size_t i) {
    const double pdf = i == 0 ? p.emit : p.forward[i];
    return pdf * p.to_last[i + 1] / (p.distance[i] * p.distance[i]);
}

double sensor_density(const RandomPath& p, std::size_t i) {
    const double pdf = i == p.k ? p.gather_pdf : p.backward[i];
    return pdf * p.to_next[i - 1] / (p.distance[i - 1] * p.distance[i - 1]);
}

/// Count times density of making the path with `s` light vertices (the rest is the sensor's);
/// 0 where no such technique exists. s = 0: the sensor path meets the luminaire; s = k: the
/// light path is joined to the receiver. s = 1 is next-event estimation.
double technique(const RandomPath& p, std::size_t s) {
    if (s == 0 && p.is_point_source)
        return 0.0;
    // the two ends that are joined must not be mirrors
    if (s > 0 && (p.is_mirror[s - 1] || p.is_mirror[s]))
        return 0.0;
    double density = s == p.k ? p.light_paths : 1.0;
    if (s == 1)
        density *= p.direct;
    for (std::size_t i = 0; i + 1 < s; ++i)
        density *= light_density(p, i);
    for (std::size_t i = p.k; i > s; --i)
        density *= sensor_density(p, i);
    return density;
}

/// Partial sums at light vertex i, after arrive(). Emission of z_0 is inside `emit` once.
PartialWeights light_weights(const RandomPath& p, std::size_t i) {
    PartialWeights w =
        start_light_subpath(p.direct, p.emit, p.is_point_source ? 0.0 : p.to_next[0]);
    w.arrive(p.distance[0], p.to_last[1]);
    for (std::size_t j = 1; j < i; ++j) {
        if (p.is_mirror[j])
            w.mirror(p.to_next[j]);
        else
            w.scatter(p.to_next[j], p.forward[j], p.backward[j]);
        w.arrive(p.distance[j], p.to_last[j + 1]);
    }
    return w;
}

PartialWeights sensor_weights(const RandomPath& p, std::size_t i) {
    PartialWeights w = start_sensor_subpath(p.light_paths, p.gather_pdf);
    w.arrive(p.distance[p.k - 1], p.to_next[p.k - 1]);
    for (std::size_t j = p.k - 1; j > i; --j) {
        if (p.is_mirror[j])
            w.mirror(p.to_last[j]);
        else
            w.scatter(p.to_last[j], p.backward[j], p.forward[j]);
        w.arrive(p.distance[j - 1], p.to_next[j - 1]);
    }
    return w;
}

double recursive_weight(const RandomPath& p, std::size_t s) {
    const std::size_t y = s; // the sensor's end
    if (s == 0)
        return weight_of_met_opening(
            sensor_weights(p, 0), p.is_mirror[1] ? 0.0 : p.direct, p.emit);
    if (s == p.k)
        return weight_at_receiver(
            sensor_density(p, p.k), p.light_paths, light_weights(p, s - 1), p.backward[s - 1]);
    const PartialWeights sensor = sensor_weights(p, y);
    if (s == 1) {
        const double found = p.is_point_source ? 0.0 : sensor_density(p, 1) / p.direct;
        return weight_of_next_event(
            found, light_density(p, 0) / p.direct, sensor, p.forward[1]);
    }
    return weight_of_connection(sensor_density(p, y),
                                light_weights(p, s - 1),
                                p.backward[s - 1],
                                light_density(p, s - 1),
                                sensor,
                                p.forward[y]);
}

TEST(RecursiveWeights, EqualTheListOfDensitiesAndSumToOne) {
    std::mt19937 engine(20120401);
    std::size_t checked = 0;
    for (int n = 0; n < 100000; ++n) {
        const RandomPath p = make_path(engine);
        // Emission's density is per place and direction, so the list holds z_0 through
        // light_density(0) and next-event estimation through `direct` alone.
        double all = 0.0;
        for (std::size_t s = 0; s <= p.k; ++s)
            all += technique(p, s);
        if (!(all > 0.0))
            continue;
        double sum = 0.0;
        for (std::size_t s = 0; s <= p.k; ++s) {
            const double brute = technique(p, s) / all;
            if (brute == 0.0)
                continue;
            const double recursive = recursive_weight(p, s);
            ASSERT_NEAR(recursive, brute, 1e-4 * brute) << "path " << n << ", technique " << s;
            sum += recursive;
            ++checked;
        }
        ASSERT_NEAR(sum, 1.0, 1e-4) << n;
    }
    EXPECT_GT(checked, 200000U);
}

} // namespace
} // namespace isolux
