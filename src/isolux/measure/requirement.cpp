#include "isolux/measure/requirement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace isolux {

namespace {

/// The word at the enumerator's place; empty past the last one.
std::string_view pick(std::span<const std::string_view> words, int at) noexcept {
    return at >= 0 && static_cast<std::size_t>(at) < words.size()
               ? words[static_cast<std::size_t>(at)]
               : std::string_view();
}

} // namespace

Interval decision_interval(const Estimate& e, double confidence, std::size_t looks) {
    if (e.samples < 2 || e.standard_error == 0.0)
        return {e.mean, e.mean};
    constexpr double pi = std::numbers::pi;
    const double k = static_cast<double>(std::max<std::size_t>(1, looks));
    const double spent = (1.0 - confidence) * 6.0 / (pi * pi * k * k); // both sides together
    return confidence_interval(e, 1.0 - spent);
}

void decide(Verdict& v) noexcept {
    const Requirement& r = v.requirement;
    const bool wants_more = r.sense == Sense::at_least;
    const double sign = wants_more ? 1.0 : -1.0;
    const double worst = wants_more ? v.interval.lower : v.interval.upper;
    const double best = wants_more ? v.interval.upper : v.interval.lower;
    v.margin = sign * (v.value.mean - r.limit);
    v.least_margin = sign * (worst - r.limit);
    const double rounding = 1e-9 * std::abs(r.limit);
    if (v.least_margin >= -rounding)
        v.decision = Decision::pass;
    else if (sign * (best - r.limit) < -rounding)
        v.decision = Decision::fail;
    else
        v.decision = Decision::undecided;
}

std::string_view to_word(RequiredQuantity q) noexcept {
    constexpr std::array<std::string_view, 7> words{"illuminance",
                                                    "cylindrical illuminance",
                                                    "modelling",
                                                    "unified glare rating",
                                                    "glare rating",
                                                    "colour rendering",
                                                    "power density"};
    return pick(words, static_cast<int>(q));
}

std::string_view to_word(RequiredArea a) noexcept {
    constexpr std::array<std::string_view, 9> words{"task",
                                                    "surrounding",
                                                    "background",
                                                    "walls",
                                                    "ceiling",
                                                    "space",
                                                    "observers",
                                                    "luminaires",
                                                    "room"};
    return pick(words, static_cast<int>(a));
}

std::string_view to_word(Statistic s) noexcept {
    constexpr std::array<std::string_view, 6> words{
        "mean", "minimum", "maximum", "uniformity", "diversity", "contrast"};
    return pick(words, static_cast<int>(s));
}

std::string_view to_word(LightShare l) noexcept {
    constexpr std::array<std::string_view, 2> words{"all", "direct"};
    return pick(words, static_cast<int>(l));
}

std::string_view to_word(Sense s) noexcept {
    constexpr std::array<std::string_view, 2> words{"at least", "at most"};
    return pick(words, static_cast<int>(s));
}

std::string_view to_word(Decision d) noexcept {
    constexpr std::array<std::string_view, 4> words{"pass", "fail", "undecided", "not judged"};
    return pick(words, static_cast<int>(d));
}

} // namespace isolux
