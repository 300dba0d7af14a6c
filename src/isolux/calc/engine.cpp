#include "isolux/calc/engine.h"

#include <algorithm>
#include <cmath>

#include "isolux/base/parallel.h"
#include "isolux/transport/local_estimator.h"

namespace isolux {

namespace {

/// METHODS eq. (33): nearer to the second surface than this times sqrt(A / M) a point leaves
/// corners to walks of its own.
constexpr double edge_factor = 0.8;

/// ... but no farther than this, m: beyond it LE-MIS is the better estimator whatever A is.
constexpr double widest_edge = 0.5;

/// Caustics are left to such walks within this share of the distance, METHODS eq. (145).
constexpr double caustic_share = 0.3;

/// Points nearer than these to what could send them light are classes of their own, m; the
/// third border is widest_edge.
constexpr double beside_class = 0.1;
constexpr double close_to_class = 0.25;

/// What could send a point light is sought no farther than this, m.
constexpr double farthest_ahead = 4.0;

/// ... and where there is nothing so near, it is as far as this, m: no light paths are so few
/// that it would gather by METHODS eq. (140).
constexpr float nowhere_near = 1e9F;

/// Runs to a tolerance wait for the points that vary most, so there more points gather: twice
/// as far from surfaces, METHODS eq. (140).
constexpr double area_factor_to_tolerance = 4.0;

/// A receiver this near to a foreign surface is flagged, m.
constexpr double too_near = 1e-3;

/// Paths from which the estimators for study learn what the scene is like; no replicate walks
/// them.
constexpr std::size_t study_paths = 512;
constexpr std::uint32_t study_replicate = 0xfffffeU;

/// Receivers that lie on a surface are moved off it when the estimators' own offset along a
/// plane's normal would not do: bodies without a normal, and planes at right angles to the
/// surface.
Point3 moved_off(const Receiver& receiver, const SurfaceDistances& d) noexcept {
    constexpr double on_surface = 1e-5;
    constexpr double clear = 4e-5;
    if (d.nearest > on_surface)
        return receiver.point;
    const double along = dot(receiver.axis, d.nearest_normal);
    if (receiver.kind == IlluminanceKind::planar && std::abs(along) > 0.5)
        return receiver.point;
    const bool looks_back = receiver.kind != IlluminanceKind::mean_spherical && along < -1e-6;
    return receiver.point + (looks_back ? -clear : clear) * Vector3(d.nearest_normal);
}

} // namespace

Engine::Engine(const Scene& scene, const Settings& settings)
    : scene_(&scene), settings_(settings), emission_(scene), images_(scene),
      direct_(scene, emission_, images_) {}

void Engine::fix_counts() {
    const double paths = static_cast<double>(effort_.paths);
    counts_ = {paths,
               paths * pilot_.chain_length,
               1.0,
               1.0,
               corner_of(paths),
               scene_->total_area,
               caustic_of(paths),
               &images_};
}

/// Radius of METHODS eq. (33) for a number of paths, m; pure LE-MIS knows none.
double Engine::corner_of(double paths) const noexcept {
    if (settings_.estimator != Estimator::automatic)
        return 0.0;
    return std::min(widest_edge, edge_factor * std::sqrt(scene_->total_area / paths));
}

/// Radius of METHODS eq. (145), m.
double Engine::caustic_of(double paths) const noexcept {
    return images_.scene_has_mirrors() ? caustic_share * corner_of(paths) : 0.0;
}

/// Distances to the surfaces around; receivers that lie on one are moved off it.
void Engine::find_surroundings() {
    near_surface_.assign(receivers_.size(), 0);
    second_.resize(receivers_.size());
    ahead_.resize(receivers_.size());
    clear_.resize(receivers_.size());
    classes_.assign(receivers_.size(), PointClass::open);
    plans_.assign(receivers_.size(), {});
    const double farthest = settings_.estimator == Estimator::automatic
                                ? std::clamp(reach_.farthest(), widest_edge, farthest_ahead)
                                : widest_edge;
    for_each_index(receivers_.size(), 64, [&](std::size_t i) {
        Receiver& receiver = receivers_[i];
        const SurfaceDistances d =
            scene_->caster.find_nearest_surfaces(receiver.point, widest_edge);
        near_surface_[i] = d.second < too_near ? 1 : 0;
        second_[i] = static_cast<float>(d.second);
        const bool has_horizon = receiver.kind == IlluminanceKind::planar;
        const double ahead = scene_->caster.find_nearest_ahead(
            receiver.point, has_horizon ? &receiver.axis : nullptr, farthest);
        ahead_[i] = ahead < farthest ? static_cast<float>(ahead) : nowhere_near;
        classes_[i] = ahead < beside_class     ? PointClass::beside
                      : ahead < close_to_class ? PointClass::close
                      : ahead < widest_edge    ? PointClass::near
                                               : PointClass::open;
        receiver.point = moved_off(receiver, d);
        clear_[i] = clear_point(*scene_, receiver);
    });
}

std::size_t Engine::prepare(std::vector<Receiver> receivers, const PilotTarget& target) {
    receivers_ = std::move(receivers);
    if (settings_.estimator == Estimator::automatic)
        reach_ = GatherReach((settings_.fixed_units ? 1.0 : area_factor_to_tolerance)
                             * scene_->total_area);
    find_surroundings();
    if (receivers_.empty()) { // the flux balance alone
        effort_.paths = fewest_paths;
        fix_counts();
        return 1;
    }
    const double corner = corner_of(static_cast<double>(pilot_paths));
    std::vector<std::uint8_t> leaves_corners(receivers_.size());
    std::vector<std::uint8_t> gathers_at_first(receivers_.size());
    ByClass<std::size_t> points{};
    for (std::size_t i = 0; i < receivers_.size(); ++i) {
        leaves_corners[i] = is_within(i, corner) ? 1 : 0;
        gathers_at_first[i] =
            images_.scene_has_mirrors() || reach_.includes(ahead_[i], pilot_paths) ? 1 : 0;
        ++points[static_cast<std::size_t>(classes_[i])];
        reach_.add(classes_[i], ahead_[i]);
    }
    PilotScene scene = pilot_scene();
    scene.leaves_corners = leaves_corners;
    scene.gathers = gathers_at_first;
    scene.corner = corner;
    scene.caustic = caustic_of(static_cast<double>(pilot_paths));
    scene.direct = [&](std::size_t i, std::uint32_t first, std::span<double> values) {
        RayCounts once; // plans are made once, whatever comes after
        RayCounts counted;
        plan_direct(i, once);
        estimate_direct(i, 0, first, values, counted);
        // Images are counted only, unshadowed samples and rare looks are not counted.
        return std::max(direct_.samples_of(plans_[i], ambient_of(i)),
                        static_cast<double>(counted.shadow)
                            / static_cast<double>(values.size()));
    };
    pilot_ = run_pilot(scene, target);
    foresee_looks();
    if (!pilot_.importance.is_even())
        reach_ = {}; // in the dark vertices stand farther apart than (140) thinks
    costs_ = make_unit_costs(*scene_,
                             pilot_.vertices_per_path,
                             pilot_.chain_length,
                             images_.draws(),
                             images_.scene_has_mirrors());
    if (!std::ranges::all_of(scene_->luminaires, shines_as_point))
        costs_.fewest_directions = fewest_rays_by_mirrors(images_.expected_without_image());
    const bool connects_to_paths = !settings_.direct_only
                                   && settings_.estimator != Estimator::path_tracing
                                   && !StudyEstimators::serves(settings_.estimator);
    if (connects_to_paths && may_take_tree(receivers_.size()))
        costs_.cut = find_cost_of_cut(scene, pilot_.importance);
    plan_ = make_work_plan(settings_, pilot_, costs_, points, reach_);
    effort_ = plan_.effort;
    fix_counts();
    choose_estimators();
    return plan_.units;
}

double Engine::ambient_of(std::size_t receiver) const noexcept {
    constexpr double darkest_share = 0.02; // darker than that nobody has to know it exactly
    const auto c = static_cast<std::size_t>(classes_[receiver]);
    const double least = darkest_share * direct_.ambient();
    if (settings_.direct_only)
        return least;
    return pilot_.points[c] == 0 ? direct_.ambient() : std::max(least, pilot_.reflected[c]);
}

/// The pilot looked at luminaires as often as the guess of ambient_of() has it; from now on its
/// own findings count.
void Engine::foresee_looks() {
    if (settings_.direct_only)
        return; // nothing was found
    ByClass<double> before{};
    ByClass<double> after{};
    for (std::size_t i = 0; i < receivers_.size(); ++i)
        if (plans_[i].is_made) { // the pilot was there
            const auto c = static_cast<std::size_t>(classes_[i]);
            before[c] += direct_.samples_of(plans_[i], direct_.ambient());
            after[c] += direct_.samples_of(plans_[i], ambient_of(i));
        }
    for (std::size_t c = 0; c < point_classes; ++c) {
        if (!(before[c] > 0.0 && after[c] > 0.0))
            continue;
        const double more = after[c] / before[c];
        pilot_.of_class[c].look_samples *= more;
        pilot_.of_class[c].direct /= more * std::sqrt(more);
    }
}

PilotScene Engine::pilot_scene() const {
    PilotScene scene;
    scene.scene = scene_;
    scene.emission = &emission_;
    scene.images = &images_;
    scene.receivers = receivers_;
    scene.clear = clear_;
    scene.classes = classes_;
    scene.seed = settings_.seed;
    scene.reflected = !settings_.direct_only;
    return scene;
}

/// Which points are traced from the beginning: a matter of geometry and of the pilot only, so
/// it biases nothing.
void Engine::choose_estimators() {
    estimators_.assign(receivers_.size(), PointEstimator::mis);
    samples_.assign(receivers_.size(), static_cast<std::uint32_t>(effort_.samples));
    began_.assign(receivers_.size(), unchanged);
    trials_.assign(receivers_.size(), -1.0F);
    first_unit_cost_ =
        replicates * static_cast<double>(effort_.paths) * costs_.path_by(effort_.weighing);
    for (std::size_t i = 0; i < receivers_.size(); ++i)
        first_unit_cost_ += replicates * own_cost(i);
    for (std::size_t i = 0; i < receivers_.size(); ++i)
        switch (settings_.estimator) {
        case Estimator::local_estimation:
            estimators_[i] = PointEstimator::local;
            break;
        case Estimator::path_tracing:
            estimators_[i] = PointEstimator::path_tracing;
            break;
        case Estimator::photometer_head:
        case Estimator::bounded:
        case Estimator::bidirectional:
            estimators_[i] = PointEstimator::study;
            break;
        case Estimator::local_estimation_mis:
            break;
        case Estimator::automatic:
            estimators_[i] = plan_.of_class[static_cast<std::size_t>(classes_[i])];
            break;
        }
    needs_paths_ = !settings_.direct_only
                   && std::any_of(estimators_.begin(),
                                  estimators_.end(),
                                  [this](PointEstimator e) { return takes_paths(e); });
    if (!StudyEstimators::serves(settings_.estimator))
        return;
    VertexCache trial;
    if (emission_.total_flux() > 0.0)
        trial = build_vertex_cache(*scene_,
                                   emission_,
                                   PathRandomness(settings_.seed, study_replicate),
                                   0,
                                   study_paths,
                                   EffectiveCounts{});
    study_.prepare(*scene_, settings_, receivers_, trial);
}

bool Engine::takes_paths(PointEstimator e) const noexcept {
    return e != PointEstimator::path_tracing && settings_.estimator != Estimator::bidirectional;
}

} // namespace isolux
