#include "isolux/transport/mirror_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <ranges>
#include <span>
#include <utility>

#include "isolux/scene/material.h"

namespace isolux {

namespace {

/// More chains than this are left to the gather rays, the weakest.
constexpr std::size_t most_chains = 256;
constexpr std::size_t most_reflections = MirrorsMet::most;

/// ... and longer chains than one whose weight is below this.
constexpr double least_weight = 2e-4;

/// Mirrors that could mirror less than this of evenly spread light have no images: facets of
/// round things.
constexpr double least_share = 1e-5;

/// More planes than this are not told apart.
constexpr std::size_t most_mirrors = 512;

bool is_mirror(const Material& m) noexcept {
    if (const auto* opaque = std::get_if<Opaque>(&m.scattering))
        return opaque->mirror > 0.0;
    return true;
}

/// A pane of glass reflects 0.08 where light falls straight on it, more at an angle.
constexpr double least_pane_strength = 0.1;

double strength_of(const Material& m) noexcept {
    if (const auto* opaque = std::get_if<Opaque>(&m.scattering))
        return opaque->mirror;
    const double n = std::get<ClearPane>(m.scattering).refractive_index;
    const double face = std::pow((n - 1.0) / (n + 1.0), 2);
    return std::max(least_pane_strength, 2.0 * face / (1.0 + face));
}

bool same_plane(const MirrorImages::Mirror& m,
                const SceneTriangle& t,
                double tolerance) noexcept {
    return std::abs(dot(m.normal, t.normal)) > 1.0 - 1e-9
           && std::abs(dot(m.normal, t.corner[0] - m.point)) < tolerance;
}

void grow(MirrorImages::Mirror& m, const SceneTriangle& t) noexcept {
    m.area += t.area;
    for (const Point3& p : t.corner) {
        m.lower = {
            std::min(m.lower.x, p.x), std::min(m.lower.y, p.y), std::min(m.lower.z, p.z)};
        m.upper = {
            std::max(m.upper.x, p.x), std::max(m.upper.y, p.y), std::max(m.upper.z, p.z)};
    }
}

/// What mirrors reflect more than n times, METHODS eq. (143): at the best by the two strongest
/// in turn.
double bound_beyond(double strongest, double second, std::size_t n) noexcept {
    const double both = strongest * second;
    const auto product = [&](std::size_t k) {
        return std::pow(both, static_cast<double>(k / 2)) * (k % 2 == 1 ? strongest : 1.0);
    };
    return both < 1.0 ? std::min(1.0, (product(n + 1) + product(n + 2)) / (1.0 - both)) : 1.0;
}

struct Candidate {
    double weight = 1.0; ///< t of METHODS eq. (125)
    std::vector<std::uint32_t> mirrors;

    bool operator<(const Candidate& other) const {
        return weight != other.weight ? weight < other.weight : mirrors > other.mirrors;
    }
};

/// The chains of the largest weight, short ones first; a chain is always better than a longer
/// one that begins like it. @param which  of the mirrors
std::vector<Candidate> choose_best(std::span<const MirrorImages::Mirror> mirrors,
                                   std::span<const std::uint32_t> which) {
    double largest = 0.0;
    for (const MirrorImages::Mirror& m : mirrors)
        largest = std::max(largest, m.area);
    std::priority_queue<Candidate> waiting;
    const auto lengthen = [&](const Candidate& c) {
        for (const std::uint32_t m : which) {
            if (!c.mirrors.empty() && c.mirrors.back() == m)
                continue; // a mirror never follows itself
            Candidate longer = c;
            longer.mirrors.push_back(m);
            longer.weight *= mirrors[m].strength * std::sqrt(mirrors[m].area / largest);
            if (c.mirrors.empty() || longer.weight >= least_weight)
                waiting.push(std::move(longer));
        }
    };
    lengthen({});
    std::vector<Candidate> chosen;
    for (; !waiting.empty() && chosen.size() < most_chains; waiting.pop()) {
        chosen.push_back(waiting.top());
        if (chosen.back().mirrors.size() < most_reflections)
            lengthen(chosen.back());
    }
    std::ranges::sort(chosen, [](const Candidate& a, const Candidate& b) {
        return a.mirrors.size() != b.mirrors.size() ? a.mirrors.size() < b.mirrors.size()
                                                    : a.mirrors < b.mirrors;
    });
    return chosen;
}

/// The longest length of which all chains of so many mirrors are there.
std::size_t complete_length(std::span<const Candidate> chains, std::size_t mirrors) {
    std::size_t length = 0;
    auto all = static_cast<double>(mirrors);
    while (length < most_reflections
           && static_cast<double>(std::ranges::count_if(
                  chains, [&](const auto& c) { return c.mirrors.size() == length + 1; }))
                  == all) {
        ++length;
        all *= static_cast<double>(mirrors) - 1.0;
    }
    return length;
}

} // namespace

bool MirrorImages::Mirror::box_holds(const Point3& p, double slack) const noexcept {
    const auto inside = [slack](double v, double least, double most) {
        return v >= least - slack && v <= most + slack;
    };
    return inside(p.x, lower.x, upper.x) && inside(p.y, lower.y, upper.y)
           && inside(p.z, lower.z, upper.z);
}

MirrorImages::MirrorImages(const Scene& scene) {
    const Rest untold = find_mirrors(scene);
    choose_chains(scene, untold);
    number_chains();
}

/// @return  those that are too many to tell apart
MirrorImages::Rest MirrorImages::find_mirrors(const Scene& scene) {
    const double size = distance(scene.bounds.lower, scene.bounds.upper);
    const double tolerance = 1e-7 * (1.0 + size);
    mirror_of_triangle_.reserve(scene.triangles.size());
    constexpr std::size_t none = ~std::size_t{0};
    Rest untold;
    for (const SceneTriangle& t : scene.triangles) {
        const Material& material = scene.material(t.material);
        if (!is_mirror(material)) {
            mirror_of_triangle_.push_back(none);
            continue;
        }
        std::size_t m = 0;
        while (m < mirrors_.size() && !same_plane(mirrors_[m], t, tolerance))
            ++m;
        if (m == mirrors_.size() && m < most_mirrors)
            mirrors_.push_back({t.corner[0], t.normal, t.corner[0], t.corner[0]});
        if (m < mirrors_.size()) {
            grow(mirrors_[m], t);
            mirrors_[m].strength = std::max(mirrors_[m].strength, strength_of(material));
        } else {
            untold.add(strength_of(material), t.area);
        }
        mirror_of_triangle_.push_back(m);
    }
    for (std::size_t& m : mirror_of_triangle_)
        m = std::min(m, mirrors_.size());
    return untold;
}

void MirrorImages::choose_chains(const Scene& scene, const Rest& untold) {
    // Of a point source nobody else finds even small ones.
    const bool all_count = mirrors_.size() <= most_chains / 2
                           && std::ranges::any_of(scene.luminaires, shines_as_point);
    Rest rest = untold;
    strongest_ = untold.strength;
    double second = untold.strength; // there may be two of them
    std::vector<std::uint32_t> imaged;
    for (std::uint32_t m = 0; m < mirrors_.size(); ++m) {
        const double strength = mirrors_[m].strength;
        const double area = mirrors_[m].area;
        second = std::max(second, std::min(strongest_, strength));
        strongest_ = std::max(strongest_, strength);
        if (area > 0.0 && (all_count || strength * area >= least_share * scene.total_area))
            imaged.push_back(m);
        else
            rest.add(strength, area);
    }
    const std::vector<Candidate> chosen = choose_best(mirrors_, imaged);
    double sum = 0.0;
    for (const Candidate& c : chosen) {
        double strength = 1.0;
        for (const std::uint32_t m : c.mirrors)
            strength *= mirrors_[m].strength;
        strengths_.push_back(strength);
        cumulative_.push_back(sum += c.weight);
        chains_.push_back(c.mirrors);
    }
    for (double& c : cumulative_)
        c /= std::max(sum, 1.0);

    const std::size_t n = complete_length(chosen, imaged.size());
    const double longer = imaged.size() > 1 ? bound_beyond(strongest_, second, n) : 0.0;
    share_without_image_ = rest.light > 0.0 ? bound_beyond(strongest_, second, 0) : longer;
    expected_without_image_ = longer + (rest.light > 0.0 ? rest.light / scene.total_area : 0.0);
}

void MirrorImages::number_chains() {
    next_.assign((chains_.size() + 1) * mirrors_.size(), no_image);
    for (std::uint32_t c = 0; c < chains_.size(); ++c) {
        std::uint32_t at = no_mirror;
        for (std::size_t k = 0; k + 1 < chains_[c].size(); ++k)
            at = next_[at * mirrors_.size() + chains_[c][k]];
        next_[at * mirrors_.size() + chains_[c].back()] = c + 1;
    }
}

std::uint32_t MirrorImages::follow(std::uint32_t chain, TriangleId triangle) const noexcept {
    return lengthen(chain, mirror_of(triangle));
}

bool MirrorImages::covers(const MirrorsMet& mirrors) const noexcept {
    if (mirrors.are_too_many())
        return false;
    std::uint32_t chain = no_mirror;
    for (const std::uint32_t m : std::views::reverse(mirrors.list()))
        chain = lengthen(chain, m);
    return covers(chain);
}

MirrorImages::DrawnChain MirrorImages::draw_chain(double u) const noexcept {
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), u);
    if (found == cumulative_.end())
        return {};
    const double before = found == cumulative_.begin() ? 0.0 : *(found - 1);
    return {&chains_[static_cast<std::size_t>(found - cumulative_.begin())], *found - before};
}

} // namespace isolux
