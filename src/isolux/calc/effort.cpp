#include "isolux/calc/effort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "isolux/transport/direct_light.h"

namespace isolux {

namespace {

/// Of the variance that is allowed the first look at traced points should find so much used up:
/// half of the points have more than the mean.
constexpr double aim = 0.7;

/// A class that shares light paths is finished when it has so much: its points differ, and the
/// few that are left over pay for all paths.
constexpr double class_aim = 0.3;

constexpr std::size_t fewest_samples = 4;
constexpr std::size_t most_samples = 256;

constexpr std::size_t most_looks = DirectLight::most_looks;

/// Variance of one draw by the tree, as a share of the square of what it stands for; measured
/// (METHODS "Vertex tree").
constexpr double variance_of_tree = 0.0015;

/// Fewer points than this are never worth a tree, and fewer paths neither.
constexpr std::size_t fewest_points_of_a_tree = 4096;
constexpr std::size_t fewest_paths_of_a_tree = 4096;

/// Gather rays for all light that meets mirrors, and so many are enough.
constexpr double rays_of_all_mirrors = 256.0;
constexpr double most_rays_by_mirrors = 32.0;

/// A tree is taken where it should save at least this share: costs are not known better.
constexpr double least_gain = 0.15;

/// The power of two in [least, most] for which a/n^power + price n is least.
std::size_t
best_count(double a, double price, std::size_t least, std::size_t most, double power = 1.0) {
    const auto total = [&](std::size_t n) {
        const auto x = static_cast<double>(n);
        return a / std::pow(x, power) + price * x;
    };
    std::size_t best = least;
    for (std::size_t n = 2 * least; n <= most; n *= 2)
        if (total(n) < total(best))
            best = n;
    return best;
}

/// What a choice comes to: variance and cost of a unit, means over the points.
struct Outcome {
    double variance = 0.0;
    double cost = 0.0;
};

Outcome outcome_of(const SharedTask& task, const Effort& effort) {
    Outcome sum;
    const std::size_t points = task.all();
    for (std::size_t c = 0; c < point_classes; ++c) {
        const double share = static_cast<double>(task.points[c]) / static_cast<double>(points);
        const VarianceModel& model = task.models[c];
        const PointEffort& e = effort.at[c];
        sum.variance +=
            share
            * (model.of(effort.paths, e, effort.weighing, task.share_of_rays(c, effort.paths))
               + model.of_direct(e));
        const double gathering = task.reach.share(c, effort.paths);
        sum.cost += share
                    * (task.costs.of(effort.paths, e, points, effort.weighing, gathering)
                       + task.costs.look * model.look_samples * static_cast<double>(e.looks));
    }
    return sum;
}

/// Many small units are worse than the model says: with more paths in each the weights leave
/// less to the gather rays, and fewer corners to walks.
constexpr double price_of_doubling = 0.15;

/// More doublings of the units than that are never needed.
constexpr std::size_t most_doublings = 60;

double price_of_units(std::size_t doublings) {
    const auto d = static_cast<double>(doublings);
    return std::exp2(d) * (1.0 + price_of_doubling * d);
}

/// The cheapest way to finish a point of a class in so many doublings of the units, or fewer.
struct ClassEffort {
    double cost = std::numeric_limits<double>::max(); ///< of the point alone, ns
    PointEffort effort;
    std::size_t doublings = 0;
};

using ByDoublings = std::array<ClassEffort, most_doublings + 1>;

/// Tries all counts. More units than the first look may take are no bound: what it cannot
/// reach, later ones will have to.
ByDoublings
finish_class(const SharedTask& task, std::size_t c, std::size_t paths, Weighing weighing) {
    const VarianceModel& model = task.models[c];
    const double rays = task.share_of_rays(c, paths);
    const double gathering = task.reach.share(c, paths);
    ByDoublings best;
    for (std::size_t draws = fewest_draws; draws <= most_draws; draws *= 2)
        for (std::size_t directions = task.costs.fewest_directions;
             directions <= most_directions;
             directions *= 2)
            for (std::size_t looks = 1; looks <= most_looks; looks *= 2) {
                const PointEffort e{draws, directions, looks};
                const double variance = model.of(paths, e, weighing, rays) + model.of_direct(e);
                const double cost =
                    task.costs.own(paths, e, weighing, gathering)
                    + task.costs.look * model.look_samples * static_cast<double>(looks);
                const double needed = std::ceil(std::log2(std::max(1.0, variance / class_aim)));
                const auto doublings = static_cast<std::size_t>(
                    std::min(needed, static_cast<double>(most_doublings)));
                const double finished = price_of_units(doublings) * cost;
                if (finished < best[doublings].cost)
                    best[doublings] = {finished, e, doublings};
            }
    for (std::size_t d = 1; d < best.size(); ++d)
        if (best[d - 1].cost <= best[d].cost)
            best[d] = best[d - 1];
    return best;
}

/// What it costs to bring every class within what is allowed, and how.
struct Finishing {
    double cost = std::numeric_limits<double>::max(); ///< of all points, ns
    Effort effort;
    std::size_t units = 1; ///< before the first look
};

/// A class that needs fewer units than another is closed by then; the light paths are walked
/// for the longest.
Finishing finish_all(const SharedTask& task, std::size_t paths, Weighing weighing) {
    ByClass<ByDoublings> classes;
    for (std::size_t c = 0; c < point_classes; ++c)
        classes[c] = finish_class(task, c, paths, weighing);
    Finishing best;
    for (std::size_t longest = 0; longest <= most_doublings; ++longest) {
        double cost =
            price_of_units(longest) * static_cast<double>(paths) * task.costs.path_by(weighing);
        for (std::size_t c = 0; c < point_classes; ++c)
            if (task.points[c] > 0)
                cost += static_cast<double>(task.points[c]) * classes[c][longest].cost;
        if (!(cost < best.cost))
            continue;
        best.cost = cost;
        best.effort.paths = paths;
        best.effort.weighing = weighing;
        // The first look comes when a quarter of the points should be done.
        std::size_t done = 0;
        for (std::size_t c = 0; c < point_classes; ++c)
            if (task.points[c] > 0)
                best.effort.at[c] = classes[c][longest].effort;
        for (std::size_t d = 0; d <= longest && 4 * done < task.all(); ++d) {
            best.units = std::min(std::size_t{1} << d, most_units);
            for (std::size_t c = 0; c < point_classes; ++c)
                done += classes[c][longest].doublings == d ? task.points[c] : 0;
        }
    }
    return best;
}

/// Numbers of paths to try with a tree; none where there is to be none.
std::vector<std::size_t> paths_of_trees(const SharedTask& task) {
    std::vector<std::size_t> paths;
    if (task.costs.cut > 0.0 && may_take_tree(task.all()))
        for (std::size_t m = fewest_paths_of_a_tree;
             m <= most_paths_of_a_tree
             && static_cast<double>(m) * task.costs.vertices <= most_vertices_of_a_tree;
             m *= 2)
            paths.push_back(m);
    return paths;
}

/// What a variance of 1 costs.
double price_of(const Outcome& o) { return o.variance * o.cost; }

} // namespace

std::size_t fewest_rays_by_mirrors(double share) noexcept {
    const double rays = std::clamp(rays_of_all_mirrors * share, 1.0, most_rays_by_mirrors);
    return std::bit_ceil(static_cast<std::size_t>(std::ceil(rays)));
}

double GatherReach::farthest() const noexcept {
    return std::sqrt(area_ / static_cast<double>(fewest_paths));
}

void GatherReach::add(PointClass c, double ahead) noexcept {
    // gathers beside 2^k paths while 2^k < area / ahead^2
    const double limit = area_ / std::max(ahead * ahead, 1e-12);
    const double k = std::clamp(std::ceil(std::log2(limit)), 0.0, double{doublings});
    ++counts_[static_cast<std::size_t>(c)][static_cast<std::size_t>(k)];
}

double GatherReach::share(std::size_t c, std::size_t paths) const noexcept {
    std::size_t all = 0;
    std::size_t gather = 0;
    for (std::size_t k = 0; k <= doublings; ++k) {
        all += counts_[c][k];
        if (k > static_cast<std::size_t>(std::countr_zero(paths)))
            gather += counts_[c][k];
    }
    return all == 0 ? 1.0 : static_cast<double>(gather) / static_cast<double>(all);
}

double VarianceModel::draws_by(Weighing weighing) const noexcept {
    return weighing == Weighing::tree ? draws + variance_of_tree * light : draws;
}

double VarianceModel::of(std::size_t m,
                         const PointEffort& e,
                         Weighing weighing,
                         double gathering) const noexcept {
    return paths / static_cast<double>(m) + draws_by(weighing) / static_cast<double>(e.draws)
           + gathering * directions / static_cast<double>(e.directions);
}

double VarianceModel::of_direct(const PointEffort& e) const noexcept {
    const auto looks = static_cast<double>(e.looks);
    return direct / (looks * looks);
}

double UnitCosts::own(std::size_t m,
                      const PointEffort& e,
                      Weighing weighing,
                      double gathering) const noexcept {
    const double weighed = weighing == Weighing::tree ? cut : static_cast<double>(m) * pair;
    return weighed + static_cast<double>(e.draws) * draw_by(weighing)
           + static_cast<double>(e.directions) * direction_of(gathering) + point;
}

double UnitCosts::of(std::size_t m,
                     const PointEffort& e,
                     std::size_t points,
                     Weighing weighing,
                     double gathering) const noexcept {
    const auto all = static_cast<double>(std::max<std::size_t>(1, points));
    return static_cast<double>(m) * path_by(weighing) / all + own(m, e, weighing, gathering);
}

std::size_t SharedTask::all() const noexcept {
    std::size_t sum = 0;
    for (const std::size_t n : points)
        sum += n;
    return sum;
}

UnitCosts make_unit_costs(const Scene& scene,
                          double vertices_per_path,
                          double chain_length,
                          double images,
                          bool mirrors) {
    // Fitted to what an engine's parts took in four to nine rooms on one core of a server of
    // 2023.
    const double triangles =
        static_cast<double>(std::max<std::size_t>(2, scene.triangles.size()));
    const double depth = 0.6 + 0.1 * std::log2(triangles); // of the search tree; 1 in a box
    const double luminaires =
        static_cast<double>(std::min<std::size_t>(64, scene.luminaires.size()));
    const double next_event = 360.0 + 3.0 * luminaires;
    UnitCosts c;
    c.path = (vertices_per_path + 1.0) * 220.0 * depth;
    c.pair = 0.35 * vertices_per_path;
    c.draw = 40.0 + 25.0 * depth;
    c.direction = 0.8 * (next_event + 250.0 + 260.0 * depth);
    c.glance = mirrors ? 100.0 + 260.0 * depth : 0.0;
    const double image = images * (next_event + 420.0 * depth);
    c.sample = 0.6 * (chain_length + 0.5) * (next_event + image + 260.0 * depth);
    c.look = 40.0 + 55.0 * depth;
    c.point = 500.0;
    c.vertices = vertices_per_path;
    c.tree_path = 1.4 * c.path; // they no longer fit into the processor's caches
    c.descent = 150.0;
    return c;
}

bool may_take_tree(std::size_t points) noexcept { return points >= fewest_points_of_a_tree; }

EffortChoice choose_effort(const SharedTask& task) {
    Finishing best;
    double least = std::numeric_limits<double>::max();
    const auto consider = [&](std::size_t m, Weighing weighing, double doubt) {
        const Finishing f = finish_all(task, m, weighing);
        if (doubt * f.cost < least) {
            least = doubt * f.cost;
            best = f;
        }
    };
    for (std::size_t m = fewest_paths; m <= most_paths; m *= 2)
        consider(m, Weighing::all, 1.0);
    for (const std::size_t m : paths_of_trees(task))
        consider(m, Weighing::tree, 1.0 / (1.0 - least_gain));
    // Who takes no paths, traced points say, looks at the luminaires as is worth it beside
    // them.
    const Effort balanced = balance_effort(task, best.effort.paths, best.effort.weighing);
    for (std::size_t c = 0; c < point_classes; ++c)
        if (task.points[c] == 0)
            best.effort.at[c] = balanced.at[c];
    return {best.effort, best.units};
}

// Where variance has a price, every class chooses for itself; all prices are tried.
Effort balance_effort(const SharedTask& task, std::size_t paths, Weighing weighing) {
    Effort best{paths, weighing, {}};
    double least = std::numeric_limits<double>::max();
    for (int exponent = -40; exponent <= 40; ++exponent) {
        const double price = std::exp2(0.5 * exponent); // of a nanosecond, in variance
        Effort effort;
        effort.paths = paths;
        effort.weighing = weighing;
        for (std::size_t c = 0; c < point_classes; ++c) {
            const double direction = task.costs.direction_of(task.reach.share(c, paths));
            effort.at[c] = {best_count(task.models[c].draws_by(weighing),
                                       price * task.costs.draw_by(weighing),
                                       fewest_draws,
                                       most_draws),
                            best_count(task.models[c].directions * task.share_of_rays(c, paths),
                                       price * direction,
                                       task.costs.fewest_directions,
                                       most_directions),
                            best_count(task.models[c].direct,
                                       price * task.costs.look * task.models[c].look_samples,
                                       1,
                                       most_looks,
                                       2.0)};
        }
        if (const double p = price_of(outcome_of(task, effort)); p < least) {
            least = p;
            best = effort;
        }
    }
    return best;
}

Effort balance_paths(const SharedTask& task, std::size_t paths) {
    Effort best = balance_effort(task, paths);
    double least = (1.0 - least_gain) * price_of(outcome_of(task, best));
    for (const std::size_t m : paths_of_trees(task)) {
        const Effort effort = balance_effort(task, m, Weighing::tree);
        if (const double price = price_of(outcome_of(task, effort)); price < least) {
            least = price;
            best = effort;
        }
    }
    return best;
}

std::size_t choose_samples(const VarianceModel& model, std::size_t units) {
    const double left = std::max(0.1, aim * static_cast<double>(units) - model.direct);
    const double wanted = std::clamp(model.samples / left,
                                     static_cast<double>(fewest_samples),
                                     static_cast<double>(most_samples));
    return std::bit_ceil(static_cast<std::size_t>(std::ceil(wanted)));
}

} // namespace isolux
