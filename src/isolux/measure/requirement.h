#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "isolux/base/estimate.h"

namespace isolux {

/// What a requirement limits.
enum class RequiredQuantity {
    illuminance,
    cylindrical_illuminance,
    modelling, ///< Ez / Eh at the same points
    unified_glare_rating,
    glare_rating, ///< GR of outdoor and sports lighting
    colour_rendering,
    power_density ///< W/m2
};

/// Where it is limited, in the words of EN 12464-1.
enum class RequiredArea {
    task,
    surrounding, ///< band of 0.5 m around the task area
    background,
    walls,
    ceiling,
    space, ///< at the height of heads
    observers,
    luminaires,
    room
};

enum class Statistic {
    mean,
    minimum,
    maximum,
    uniformity, ///< minimum / mean, U0
    diversity,  ///< minimum / maximum, Ud
    contrast    ///< maximum / minimum
};

enum class LightShare { all, direct };

enum class Sense { at_least, at_most };

/// One number of a standard, with its place in it.
struct Requirement {
    std::string standard; ///< "EN 12464-1:2021"
    std::string row;      ///< "34.2"
    std::string clause;
    std::string task;   ///< the row in words
    std::string symbol; ///< "Em", "U0", "UGR"
    std::string name;   ///< the symbol in words
    RequiredQuantity quantity = RequiredQuantity::illuminance;
    LightShare light = LightShare::all;
    RequiredArea area = RequiredArea::task;
    Statistic statistic = Statistic::mean;
    Sense sense = Sense::at_least;
    double limit = 0.0;
    std::string unit;
    bool is_recommendation = false; ///< has no say in the overall verdict
    std::string source;             ///< of the number, in words
    bool is_recalled = false;       ///< nobody has compared it with the printed standard
};

enum class Decision {
    pass,      ///< the whole interval is on the right side of the limit
    fail,      ///< the whole interval is on the wrong side
    undecided, ///< the interval straddles the limit
    not_judged ///< there is no value; the verdict says why
};

/// What was found about one requirement in one place.
struct Verdict {
    Requirement requirement;
    std::string subject; ///< name of the surface or of the observers
    Decision decision = Decision::not_judged;
    Estimate value;
    Interval interval; ///< each bound fails with at most half of 1 - confidence
    /// value - limit, positive on the right side; in the requirement's unit
    double margin = 0.0;
    double least_margin = 0.0; ///< the same at the unfavourable end of the interval
    std::string reason;        ///< why it is not judged, or what to know about the value
};

/// Interval whose bounds fail with a one-sided probability of (1 - confidence)/2 * 6/(pi^2 k^2)
/// each, k = `looks`: METHODS eq. (105).
/// @param looks  how often the calculation looked at its intervals before it stopped, 1 or more
[[nodiscard]] Interval
decision_interval(const Estimate& e, double confidence, std::size_t looks);

/// Fills in decision and margins from value and interval, METHODS eq. (106). Values that differ
/// from the limit by rounding only (1e-9 of it) keep it.
void decide(Verdict& verdict) noexcept;

[[nodiscard]] std::string_view to_word(RequiredQuantity q) noexcept;
[[nodiscard]] std::string_view to_word(RequiredArea a) noexcept;
[[nodiscard]] std::string_view to_word(Statistic s) noexcept;
[[nodiscard]] std::string_view to_word(LightShare l) noexcept;
[[nodiscard]] std::string_view to_word(Sense s) noexcept;
[[nodiscard]] std::string_view to_word(Decision d) noexcept;

/// The value whose word this is. Word: one of the enumerations above.
template <class Word>
[[nodiscard]] std::optional<Word> find_word(std::string_view text) noexcept {
    constexpr int most_words = 16;
    for (int i = 0; i < most_words; ++i) {
        const std::string_view word = to_word(static_cast<Word>(i));
        if (word.empty())
            return std::nullopt;
        if (word == text)
            return static_cast<Word>(i);
    }
    return std::nullopt;
}

} // namespace isolux
