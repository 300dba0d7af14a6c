#include "isolux/transport/light_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "isolux/sampling/warp.h"
#include "isolux/transport/surface_event.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Density of the first vertex, METHODS eq. (11) for k = 2: that of emitting towards it, over
/// that of finding the same emission point from it; times the cosine over d2 it is an area
/// density. Endless where that never finds it: then the path has no rival.
double first_density(const Emission& emission,
                     const EmissionSample& start,
                     const Point3& vertex,
                     double cos_vertex,
                     double distance) noexcept {
    const double towards = emission.pdf_towards(vertex, start.from);
    if (!(towards > 0.0))
        return std::numeric_limits<double>::infinity();
    return start.strength * cos_vertex
           / (emission.total_flux() * towards * distance * distance);
}

/// A path goes on as so many at a vertex, at most.
constexpr double most_branches = 16.0;

/// ... and not as several while so many wait.
constexpr std::size_t most_waiting = 256;

/// Random numbers of branch k of path i: those of path i + 2^40 k.
constexpr std::uint32_t branch_bits = 40;

/// A path on its way, or one of its branches.
struct Flight {
    Point3 origin;
    UnitVector3 w;
    Rgb alpha;
    std::uint64_t number = 0;   ///< of its random numbers
    double continuation = 1.0;  ///< diffuse ones that left the last vertex, in the mean
    double cos_departure = 1.0; ///< p_w of that vertex times pi, 1 at emission
    double edge = 0.0;          ///< length since the last vertex, straight through panes
    double passed = 1.0;        ///< transmittance of the panes in between
    double fade = 1.0;    ///< below 1 where surfaces reflect all: branches die out as well
    bool is_first = true; ///< no vertex yet
    bool behind_mirror = false; ///< a Dirac reflection since the last vertex
    MirrorsMet mirrors;         ///< before the first vertex
    bool is_hidden = false;     ///< as the vertices will say
    std::uint32_t bounce = 0;
    std::uint32_t order = 1;
    std::uint32_t reflections = 0; ///< diffuse ones
    std::size_t last = 0;          ///< vertex of the last of them
};

/// Where a flight met a surface and what that does.
struct Meeting {
    const SurfaceHit& hit;
    Point3 clear; ///< moved off the surface, to the side the flight came from
    SurfaceEvent event;
    double diffuse = 0.0;      ///< share of what the flight carries
    double albedo = 0.0;       ///< of all events
    double continuation = 0.0; ///< what a vertex here keeps
    double going_on = 0.0;     ///< flights that leave, in the mean
};

class PathWalk {
public:
    PathWalk(const Scene& scene,
             const Emission& emission,
             const PathRandomness& random,
             std::vector<PathVertex>& vertices,
             const PathImportance& importance,
             const Roulette& roulette,
             const MirrorImages* images,
             std::vector<Flight>& waiting)
        : scene_(scene), emission_(emission), random_(random), vertices_(vertices),
          importance_(importance), roulette_(roulette), images_(images), waiting_(waiting) {}

    FluxTally run(std::uint64_t path) {
        Flight flight = start(path);
        for (;;) {
            while (fly(flight))
                continue;
            if (waiting_.empty())
                return tally_;
            flight = waiting_.back();
            waiting_.pop_back();
        }
    }

private:
    using D = PathDimension;

    /// Luminaire, place and direction. The flux is that of all luminaires.
    Flight start(std::uint64_t path) {
        draws_ = random_.draws(path);
        start_ = emission_.sample_emission(draws_(D::luminaire),
                                           draws_(D::place),
                                           draws_(D::place + 1),
                                           draws_(D::direction),
                                           draws_(D::direction + 1));
        Flight f;
        path_ = path;
        f.number = path;
        f.alpha = emission_.total_flux() * emission_.colour(start_.from.luminaire);
        f.w = start_.direction;
        f.origin = emission_.departure(start_.from, f.w);
        alpha_1_ = luminance_sum(f.alpha);
        return f;
    }

    [[nodiscard]] double random(const Flight& f, std::uint32_t dimension) const noexcept {
        return f.number == path_ ? draws_(dimension) : random_(f.number, dimension);
    }

    /// To the next surface and off it. @return whether the flight goes on
    bool fly(Flight& f) {
        const auto hit = scene_.caster.find_first_hit(f.origin, f.w);
        ++tally_.rays;
        const double carried = luminance_sum(f.alpha);
        if (!hit) {
            tally_.escaped += carried;
            return false;
        }
        f.edge += hit->distance;
        const SceneTriangle& triangle = scene_.triangle(hit->triangle);
        const double cos_in = std::max(0.0, -dot(hit->normal, f.w));
        const SurfaceEvent event =
            evaluate_surface(scene_.material(triangle.material), hit->is_front, cos_in);
        const double diffuse = luminance_sum(f.alpha * event.diffuse) / carried;
        const double albedo = diffuse + event.mirror + event.straight;
        tally_.absorbed += carried * (1.0 - albedo);
        if (!(albedo > 0.0))
            return false;
        const Point3 clear = scene_.caster.offset_point(hit->position, hit->normal);
        Meeting m{*hit, clear, event, diffuse, albedo};
        m.going_on = mean_flights(f, m, carried);
        m.continuation = m.going_on * m.diffuse / m.albedo * rarity(carried);
        if (m.diffuse > 0.0)
            keep_vertex(f, m, cos_in, triangle.material);
        return go_on(f, m);
    }

    /// Roulette and branching: panes decide by their own shares, surfaces by what the path
    /// would still carry and by how much it matters there.
    [[nodiscard]] double
    mean_flights(Flight& f, const Meeting& m, double carried) const noexcept {
        if (m.event.is_pane)
            return m.albedo;
        double wanted = m.albedo * carried / alpha_1_;
        if (importance_.is_even())
            return std::clamp(wanted, roulette_.least, roulette_.most);
        f.fade *= std::min(1.0, roulette_.most / m.albedo);
        wanted *= f.fade * importance_.at(m.hit.position, m.hit.normal);
        const double most = waiting_.size() < most_waiting ? most_branches : roulette_.most;
        return std::clamp(wanted, roulette_.least, most);
    }

    /// How many flights like this one there are for each that gather rays would meet.
    [[nodiscard]] double rarity(double carried) const noexcept {
        return importance_.is_even() ? 1.0 : alpha_1_ / carried;
    }

    /// Only the diffuse part connects.
    void keep_vertex(Flight& f, const Meeting& m, double cos_in, MaterialId material) {
        const std::size_t vertex = vertices_.size();
        PathVertex& v = vertices_.emplace_back();
        v.position = m.clear;
        v.normal = m.hit.normal;
        v.radiant = (1.0 / pi) * (f.alpha * m.event.diffuse);
        v.continuation = m.continuation;
        v.carried = luminance_sum(f.alpha);
        v.order = f.order;
        v.luminaire = static_cast<std::uint32_t>(start_.from.luminaire);
        v.material = material;
        v.back = f.reflections == 0 ? 0 : static_cast<std::uint32_t>(vertex - f.last);
        v.is_first = f.is_first && !f.behind_mirror;
        if (f.is_first)
            f.is_hidden = starts_hidden(f);
        v.is_hidden = f.is_hidden;
        if (f.behind_mirror)
            v.density = after_mirror;
        else if (f.is_first)
            v.density = f.passed * first_density(emission_, start_, m.clear, cos_in, f.edge);
        else
            v.density =
                f.passed * f.continuation * (f.cos_departure / pi) * cos_in / (f.edge * f.edge);
    }

    /// Light of a point source over mirrors without an image is found by light paths alone.
    [[nodiscard]] bool starts_hidden(const Flight& f) const noexcept {
        return f.behind_mirror && images_ != nullptr && !images_->covers(f.mirrors)
               && shines_as_point(emission_.luminaire(start_.from.luminaire));
    }

    /// As how many flights, if any: what is killed is absorbed in the mean. The others wait
    /// with numbers of their own.
    bool go_on(Flight& f, const Meeting& m) {
        const std::size_t vertex = vertices_.size() - 1;
        const double whole = std::floor(m.going_on);
        const double rest = m.going_on - whole;
        double pick = random(f, D::first_bounce + 3 * f.bounce + D::event);
        const bool one_more = pick < rest;
        const auto flights = static_cast<std::uint32_t>(whole) + (one_more ? 1U : 0U);
        if (flights == 0)
            return false;
        pick = one_more ? pick * (m.albedo / rest) : (pick - rest) * (m.albedo / (1.0 - rest));
        for (std::uint32_t k = 1; k < flights; ++k) {
            Flight branch = f;
            branch.number = (f.number & ((1ULL << branch_bits) - 1U))
                            | std::uint64_t{++branches_} << branch_bits;
            const std::uint32_t d = D::first_bounce + 3 * f.bounce + D::event;
            leave(branch, m, m.albedo * random(branch, d), vertex);
            waiting_.push_back(branch);
        }
        leave(f, m, pick, vertex);
        return true;
    }

    /// Which event. @param pick  in [0, albedo)
    void leave(Flight& f, const Meeting& m, double pick, std::size_t vertex) const {
        const double boost = m.albedo / m.going_on;
        const std::uint32_t d = D::first_bounce + 3 * f.bounce + D::scatter;
        ++f.bounce;
        if (pick < m.diffuse) {
            const Vector3 local = sample_cosine_hemisphere(random(f, d), random(f, d + 1));
            f.w = UnitVector3::from_unit(make_basis(m.hit.normal).to_world(local));
            f.origin = m.clear;
            f.alpha = (boost / m.diffuse) * (f.alpha * m.event.diffuse);
            f.continuation = m.continuation;
            f.cos_departure = local.z;
            f.edge = 0.0;
            f.passed = 1.0;
            f.is_first = false;
            f.behind_mirror = false;
            ++f.order;
            ++f.reflections;
            f.last = vertex;
        } else if (pick < m.diffuse + m.event.mirror) {
            f.w = reflect(f.w, m.hit.normal);
            f.origin = m.clear;
            f.alpha = boost * f.alpha;
            f.behind_mirror = true;
            if (f.is_first && images_ != nullptr)
                f.mirrors.add(images_->mirror_of(m.hit.triangle));
            ++f.order;
        } else {
            // Across the pane, not along the ray: that could cross a wall the pane ends at.
            f.origin = scene_.caster.offset_point(m.hit.position, -m.hit.normal);
            f.alpha = boost * f.alpha;
            f.passed *= m.event.straight;
        }
    }

    const Scene& scene_;
    const Emission& emission_;
    const PathRandomness& random_;
    std::vector<PathVertex>& vertices_;
    const PathImportance& importance_;
    const Roulette& roulette_;
    const MirrorImages* images_;
    PathRandomness::Draws draws_; ///< of the path itself; branches draw from random_
    std::uint64_t path_ = 0;
    EmissionSample start_;
    double alpha_1_ = 0.0;
    std::vector<Flight>& waiting_;
    std::uint32_t branches_ = 0;
    FluxTally tally_;
};

} // namespace

FluxTally walk_light_path(const Scene& scene,
                          const Emission& emission,
                          const PathRandomness& random,
                          std::uint64_t path,
                          std::vector<PathVertex>& vertices,
                          const PathImportance& importance,
                          const Roulette& roulette,
                          const MirrorImages* images) {
    thread_local std::vector<Flight> waiting;
    waiting.clear();
    return PathWalk(scene, emission, random, vertices, importance, roulette, images, waiting)
        .run(path);
}

} // namespace isolux
