#include <algorithm>

#include <fmt/format.h>

#include "isolux/calc/engine.h"

/// What an engine says of itself in reports.
namespace isolux {

namespace {

std::string in_millimetres(double metres) {
    std::string text = std::to_string(1e3 * metres);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
    return text + " mm";
}

/// Light that is left out is told about if it may be more than this, of what meets mirrors.
constexpr double worth_a_notice = 1e-3;

} // namespace

std::string Engine::describe() const {
    const auto count = [&](PointEstimator e) {
        return std::to_string(std::count(estimators_.begin(), estimators_.end(), e));
    };
    // "64 (open), 128 (beside surfaces)", for the classes that there are
    const auto by_class = [&](std::size_t PointEffort::*what, const auto& is_asked) {
        constexpr ByClass<const char*> names{
            "open", "near surfaces", "close", "beside surfaces"};
        ByClass<bool> asked{};
        for (std::size_t i = 0; i < classes_.size(); ++i)
            asked[static_cast<std::size_t>(classes_[i])] |= is_asked(i);
        std::string text;
        for (std::size_t c = 0; c < point_classes; ++c)
            if (asked[c])
                text += fmt::format(
                    "{}{} ({})", text.empty() ? "" : ", ", effort_.at[c].*what, names[c]);
        return text.empty() ? "none" : text;
    };
    const std::string text =
        fmt::format("light paths per replicate and unit: {}{}, shadow rays a point: {}",
                    effort_.paths,
                    effort_.weighing == Weighing::tree ? " (in a tree)" : "",
                    by_class(&PointEffort::draws, [](std::size_t) { return true; }));
    switch (settings_.estimator) {
    case Estimator::local_estimation:
        return "local estimation; " + text;
    case Estimator::path_tracing:
        return fmt::format(
            "path tracing from the points; paths a point, replicate and unit: {}",
            effort_.samples);
    case Estimator::photometer_head:
        return "local estimation at a photometer head of radius "
               + in_millimetres(settings_.photometer_head_radius) + "; " + text;
    case Estimator::bounded:
        return "local estimation with a bounded kernel and its compensation; " + text;
    case Estimator::bidirectional:
        return "bidirectional path tracing from the points";
    default: {
        const std::string pilot = describe_advantage(plan_);
        std::size_t gatherers = 0;
        for (std::size_t i = 0; i < receivers_.size(); ++i)
            gatherers += gathers(i) ? 1 : 0;
        return fmt::format(
            "local estimation with one gather bounce ({} points{}), path tracing "
            "({} points); {}, gather rays: {}; points that gather: {}",
            count(PointEstimator::mis),
            pilot.empty() ? "" : "; " + pilot,
            count(PointEstimator::path_tracing),
            text,
            by_class(
                &PointEffort::directions,
                [this](std::size_t i) { return images_.scene_has_mirrors() || gathers(i); }),
            gatherers);
    }
    }
}

std::vector<Message> Engine::notices() const {
    std::vector<Message> all;
    if (settings_.estimator == Estimator::photometer_head)
        all.push_back(head_notice());
    const auto points = std::ranges::count_if(scene_->luminaires, shines_as_point);
    const double lost = images_.share_without_image();
    if (lost <= worth_a_notice || (points == 0 && !settings_.direct_only))
        return all;
    const std::string chains = fmt::format(
        "of light that reaches a place by mirrors alone, {} chains of mirrors are followed; "
        "the others would bring at most about {:.1f} % of what meets mirrors and are left out",
        images_.chains().size(),
        100.0 * lost);
    if (settings_.direct_only)
        all.push_back({"calculation",
                       "only direct light is calculated: " + chains,
                       "With reflected light, rays find them where openings have a size"});
    else
        all.push_back({"calculation",
                       fmt::format("{} luminaire{} as points, and no ray meets a point by "
                                   "chance: {}",
                                   points,
                                   points == 1 ? " shines" : "s shine",
                                   chains),
                       "Give the luminaire types an \"opening\" with a size, and all of it is "
                       "counted"});
    return all;
}

/// What the photometer head measures instead of points.
Message Engine::head_notice() const {
    std::string text = "reflected light is the mean over a photometer head of radius "
                       + in_millimetres(settings_.photometer_head_radius)
                       + ", not the value at the point (the difference is r^2/8 times the "
                         "Laplacian of E)";
    if (study_.cut_heads() > 0)
        text += "; points whose head an edge cuts, where it grows like r: "
                + std::to_string(study_.cut_heads());
    if (study_.without_head() > 0)
        text += "; points that are no planes and have no head: "
                + std::to_string(study_.without_head());
    return {"calculation", text, "For values at the points take another estimator"};
}

} // namespace isolux
