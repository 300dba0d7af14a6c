#include "isolux/transport/walk_front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "isolux/sampling/warp.h"
#include "isolux/transport/image_light.h"
#include "isolux/transport/next_event.h"
#include "isolux/transport/response.h"
#include "isolux/transport/vertex_choice.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// So many connections are settled at a time, to keep memory small.
constexpr std::size_t most_waiting = 4096;

/// A gathering walk that is traced on adds to numbers far quieter than its own: its roulette
/// begins when it carries less than the inverse of this of what it began with.
constexpr double patience = 4.0;

/// Whether a surface was met straight from nearby.
bool is_near(const Point3& from, const Meeting& y, double radius) noexcept {
    return y.reflections == 0 && length_squared(y.at - from) < radius * radius;
}

} // namespace

void WalkFront::start(const Scene& scene,
                      const Emission& emission,
                      const MirrorImages& images,
                      std::span<const RayPoint> points) {
    scene_ = &scene;
    emission_ = &emission;
    images_ = &images;
    points_ = points;
    cache_ = nullptr;
    walks_.clear();
    current_.clear();
    following_.clear();
    collecting_.clear();
    connections_.clear();
    trails_.clear();
}

void WalkFront::share_with(const VertexCache& cache, const EffectiveCounts& counts) {
    cache_ = &cache;
    counts_ = counts;
}

void WalkFront::add_gathering() { add(true); }

void WalkFront::add_tracing() { add(false); }

/// Sample by sample over all points: neighbours' rays stand together.
void WalkFront::add(bool gathers) {
    if (emission_->total_flux() <= 0.0)
        return;
    std::size_t most = 0;
    for (const RayPoint& p : points_)
        most = std::max(most, p.samples);
    for (std::uint32_t s = 0; s < most; ++s)
        for (std::uint32_t p = 0; p < points_.size(); ++p) {
            const RayPoint& point = points_[p];
            if (s >= point.samples)
                continue;
            Walk walk;
            walk.numbers = NumberSequence(point.random, point.first + s);
            const double u = walk.numbers.next();
            const UnitVector3 w = sample_response(*point.receiver, u, walk.numbers.next());
            walk.pdf = pdf_response(*point.receiver, w);
            if (!(walk.pdf > 0.0))
                continue;
            walk.point = p;
            walk.gathers = gathers;
            walk.carried = Rgb::grey(gathers ? patience : 1.0);
            walk.throughput = Rgb::grey(evaluate_response(*point.receiver, w)
                                        / (walk.pdf * static_cast<double>(point.samples)));
            current_.push_back(
                {{point.at, w, 1.0, 0.0, 0}, static_cast<std::uint32_t>(walks_.size())});
            walks_.push_back(walk);
        }
}

std::uint64_t WalkFront::run(const LightLedger& ledger) {
    ledger_ = &ledger;
    rays_ = 0;
    while (!current_.empty()) {
        // One flight through panes and mirrors to the diffuse surfaces behind them.
        while (!current_.empty()) {
            following_.clear();
            trace(current_, ledger);
            std::swap(current_, following_);
            if (connections_.size() >= most_waiting)
                rays_ += connections_.settle(*scene_, ledger, trails_);
        }
        for (const std::uint32_t walk : collecting_)
            send_on(walk);
        collecting_.clear();
    }
    rays_ += connections_.settle(*scene_, ledger, trails_);
    ledger_ = nullptr;
    return rays_;
}

void WalkFront::trace(std::span<const Ray> rays, const LightLedger& ledger) {
    rays_ += rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Branch& branch = rays[i].branch;
        const auto hit = scene_->caster.find_first_hit(branch.origin, branch.w);
        if (branch.reflections > 0 && !images_->covers(branch.chain)) {
            const Walk& walk = walks_[rays[i].walk];
            visit_seen_openings(*emission_,
                                branch,
                                hit ? hit->distance + 1e-4 : 1e30,
                                [&](std::size_t luminaire, const Rgb& l) {
                                    ledger.add(walk.point,
                                               luminaire,
                                               branch.throughput * (walk.throughput * l),
                                               trails_,
                                               walk.trail);
                                });
        }
        if (hit)
            arrive(rays[i], *hit);
    }
}

void WalkFront::arrive(const Ray& ray, const SurfaceHit& hit) {
    Walk& walk = walks_[ray.walk];
    const SurfaceEvent event = surface_event(*scene_, ray.branch, hit);
    const double offered = walk.passed_on;
    if (const auto y = meet_surface(*scene_, ray.branch, hit, event)) {
        if (!walk.gathers || y->reflections > 0) {
            if (wants(walk, *y))
                collect_at(walk, *y);
        } else if (points_[walk.point].connects) {
            gather_at(walk, *y);
        }
    }
    if (offered == 0.0 && walk.passed_on > 0.0)
        collecting_.push_back(ray.walk);
    const Onward onward = go_on(*scene_, *images_, ray.branch, hit, event, walk.numbers);
    for (std::size_t b = 0; b < onward.count; ++b)
        if (!walk.left.any() || walk.left.mirrors || onward.branches[b].reflections == 0)
            following_.push_back({onward.branches[b], ray.walk});
}

/// A luminaire sample and one cached vertex light y; the light path could have done the same.
void WalkFront::gather_at(Walk& walk, const Meeting& y) {
    const double u_vertex = walk.numbers.next();
    fetch_hand(*cache_, u_vertex);
    const double u_luminaire = walk.numbers.next();
    const double u = walk.numbers.next();
    const double v = walk.numbers.next();
    const NextEvent event = sample_next_event(*emission_, y.at, y.normal, u_luminaire, u, v);
    const double p2 = walk.pdf * y.cosine / (y.travelled * y.travelled);
    connections_.add({event.sight,
                      (y.throughput / pi) * (walk.throughput * event.illuminance * y.diffuse),
                      counts_.paths * event.path_density,
                      gathered(walk) * counts_.gather_first * p2,
                      0.0,
                      walk.point,
                      event.luminaire,
                      reflected_by(y.material, walk.trail)});
    const RayPoint& point = points_[walk.point];
    const Left left{point.leaves_corners && is_near(point.at, y, counts_.corner),
                    point.leaves_mirrored && is_near(point.at, y, counts_.caustic)};
    connect_vertex(walk, y, u_vertex, left.corners ? counts_.corner : 0.0);
    if (left.mirrors)
        collect_images(walk, y);
    if (left.any())
        take_on(walk, y, left);
}

/// Weak mirrors alone are worth a walk now and then, METHODS eq. (145).
void WalkFront::take_on(Walk& walk, Meeting y, Left left) {
    if (!left.corners) {
        const double often = std::min(1.0, images_->strongest());
        if (walk.numbers.next() >= often)
            return;
        y.throughput /= often;
    }
    offer(walk, y, left);
}

/// METHODS "LE-MIS", T2 for k >= 3. Vertices nearer than `nearest` are left to the walk itself,
/// if it finds their light.
void WalkFront::connect_vertex(Walk& walk, const Meeting& y, double u, double nearest) {
    const double p2 = walk.pdf * y.cosine / (y.travelled * y.travelled);
    const double n2p2 = gathered(walk) * counts_.gather_later * p2;
    const double surely_left = cache_->has_hidden ? 0.0 : nearest;
    const auto chosen =
        choose_vertex(*cache_,
                      {y.at, y.normal, counts_.vertices / n2p2, surely_left, counts_.area},
                      u,
                      walk.numbers.next());
    if (!chosen)
        return;
    const auto [drawn, share] = *chosen;
    const PathVertex& v = cache_->vertices[drawn];
    const Vector3 d = y.at - v.position;
    const double d2 = length_squared(d);
    if (!(d2 > 0.0) || (d2 < nearest * nearest && !v.is_hidden))
        return;
    const double inverse = 1.0 / std::sqrt(d2);
    const double cos_v = inverse * dot(v.normal, d);
    const double cos_y = -inverse * dot(y.normal, d);
    if (cos_v <= 0.0 || cos_y <= 0.0)
        return;
    const double departure = (cos_v / pi) * cos_y / d2;
    std::uint32_t trail = reflected_by(y.material, walk.trail);
    if (ledger_->wants_trails())
        visit_chain(*cache_, drawn, [&](MaterialId m) { trail = trails_.add(m, trail); });
    connections_.add({{v.position, y.at},
                      (y.throughput * share * cos_v * cos_y / (d2 * pi))
                          * (walk.throughput * v.radiant * y.diffuse),
                      counts_.vertices * v.continuation * departure,
                      n2p2,
                      counts_.area * departure,
                      walk.point,
                      v.luminaire,
                      trail});
}

/// The luminaires light y, and the walk may go on from there: one of the surfaces that a flight
/// meets is drawn in proportion to what each would pass on.
void WalkFront::collect_at(Walk& walk, const Meeting& y) {
    const double u_luminaire = walk.numbers.next();
    const double u = walk.numbers.next();
    const double v = walk.numbers.next();
    const NextEvent event = sample_next_event(*emission_, y.at, y.normal, u_luminaire, u, v);
    connections_.add({event.sight,
                      (y.throughput / pi) * (walk.throughput * event.illuminance * y.diffuse),
                      0.0,
                      1.0,
                      0.0,
                      walk.point,
                      event.luminaire,
                      reflected_by(y.material, walk.trail)});
    collect_images(walk, y);
    offer(walk, y, {});
}

/// The walk may go on from y.
void WalkFront::offer(Walk& walk, const Meeting& y, Left left) {
    const double share = y.throughput * luminance_sum(y.diffuse);
    walk.passed_on += share;
    if (walk.numbers.next() * walk.passed_on < share) {
        walk.next = y;
        walk.goes_on = true;
        walk.next_left = left;
    }
}

/// Whether the light of a surface is this walk's business.
bool WalkFront::wants(const Walk& walk, const Meeting& y) const noexcept {
    if (!walk.left.any())
        return true;
    return y.reflections > 0 ? walk.left.mirrors
                             : walk.left.corners && is_near(walk.start, y, counts_.corner);
}

/// Light of the luminaires over imaged mirrors.
void WalkFront::collect_images(Walk& walk, const Meeting& y) {
    if (images_->chains().empty())
        return;
    const ImageEvent event =
        sample_image_event(*scene_, *emission_, *images_, y.at, y.normal, walk.numbers, rays_);
    if (max_channel(event.illuminance) > 0.0)
        ledger_->add(walk.point,
                     event.luminaire,
                     (y.throughput / pi) * (walk.throughput * event.illuminance * y.diffuse),
                     trails_,
                     reflected_by(y.material, walk.trail));
}

std::uint32_t WalkFront::reflected_by(MaterialId material, std::uint32_t before) {
    return ledger_->wants_trails() ? trails_.add(material, before) : Trails::none;
}

/// Roulette by what the walk still carries, and a new direction.
void WalkFront::send_on(std::uint32_t number) {
    Walk& walk = walks_[number];
    const Meeting from = walk.next;
    const double share = from.throughput * luminance_sum(from.diffuse) / walk.passed_on;
    const bool goes_on = walk.goes_on;
    walk.left = walk.next_left;
    walk.passed_on = 0.0;
    walk.goes_on = false;
    if (!goes_on)
        return;
    const Rgb passed = (from.throughput / share) * from.diffuse;
    const double survival = std::clamp(luminance_sum(walk.carried * passed), 0.05, 0.999);
    if (walk.numbers.next() >= survival)
        return;
    walk.carried = (1.0 / survival) * (walk.carried * passed);
    walk.throughput = (1.0 / survival) * (walk.throughput * passed);
    walk.gathers = false;
    walk.start = from.at;
    walk.trail = reflected_by(from.material, walk.trail);
    const double u = walk.numbers.next();
    const Vector3 local = sample_cosine_hemisphere(u, walk.numbers.next());
    const UnitVector3 w = UnitVector3::from_unit(make_basis(from.normal).to_world(local));
    current_.push_back({{from.at, w, 1.0, 0.0, 0}, number});
}

} // namespace isolux
