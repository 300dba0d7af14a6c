#include "isolux/measure/glare.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "isolux/photometry/position_index.h"

namespace isolux {

namespace {

/// Highest place of the table of position indices of CIE 117: height over distance ahead.
constexpr double highest_in_table = 1.9;

/// The observer's axes: upwards and sideways, at right angles to the line of sight.
struct Head {
    UnitVector3 up;
    UnitVector3 side;
};

Head head_of(const UnitVector3& sight) {
    const UnitVector3 vertical = UnitVector3::from_unit({0, 0, 1});
    constexpr double straight = 1e-9;
    const Vector3 reference = std::hypot(sight.x(), sight.y()) < straight
                                  ? Vector3{0.0, 1.0, 0.0}
                                  : Vector3(vertical);
    const UnitVector3 side(cross(sight, reference));
    return {UnitVector3(cross(side, sight)), side};
}

/// Value and error of T(mean of the replicates), METHODS eq. (41).
Estimate jackknife_of_mean(std::span<const double> replicates,
                           const std::function<double(double)>& functional) {
    const double n = static_cast<double>(replicates.size());
    double sum = 0.0;
    for (const double y : replicates)
        sum += y;
    const double all = functional(sum / n);
    if (replicates.size() < 2)
        return {all, 0.0, replicates.size()};
    double centre = 0.0;
    std::vector<double> without;
    for (const double y : replicates) {
        without.push_back(functional((sum - y) / (n - 1.0)));
        centre += without.back() / n;
    }
    double squares = 0.0;
    for (const double t : without)
        squares += (t - centre) * (t - centre);
    return {
        n * all - (n - 1.0) * centre, std::sqrt((n - 1.0) / n * squares), replicates.size()};
}

/// Replicates of which the mean of all and of all but one are above 0.
bool is_lit(std::span<const double> replicates) {
    double sum = 0.0;
    for (const double y : replicates)
        sum += y;
    return !replicates.empty() && std::ranges::all_of(replicates, [&](double y) {
        return replicates.size() == 1 ? y > 0.0 : sum - y > 0.0;
    });
}

} // namespace

double position_index(const UnitVector3& sight, const UnitVector3& towards) noexcept {
    const Head head = head_of(sight);
    const double ahead = dot(sight, towards);
    const double upwards = dot(head.up, towards);
    const double sideways = std::abs(dot(head.side, towards));
    return guth_position_index(radians(std::atan2(std::hypot(upwards, sideways), ahead)),
                               radians(std::atan2(sideways, upwards)));
}

bool is_in_position_table(const UnitVector3& sight, const UnitVector3& towards) noexcept {
    const double ahead = dot(sight, towards);
    return ahead > 0.0 && dot(head_of(sight).up, towards) <= highest_in_table * ahead;
}

double glare_sum(const UnitVector3& sight,
                 std::span<const GlareSourcePart> parts,
                 GlareSources which) noexcept {
    double sum = 0.0;
    for (const GlareSourcePart& part : parts) {
        if (dot(sight, part.towards) <= 0.0
            || (which == GlareSources::in_table && !is_in_position_table(sight, part.towards)))
            continue;
        const double seen = part.luminance / position_index(sight, part.towards);
        sum += seen * seen * part.solid_angle;
    }
    return sum;
}

Estimate unified_glare_rating(double source_sum, std::span<const double> indirect) {
    if (!(source_sum > 0.0) || !is_lit(indirect))
        return {};
    return jackknife_of_mean(indirect, [source_sum](double e) {
        const double background = e / std::numbers::pi; // METHODS eq. (109)
        return 8.0 * std::log10(0.25 * source_sum / background);
    });
}

Estimate outdoor_glare_rating(double veil, std::span<const double> background) {
    if (!(veil > 0.0) || !is_lit(background))
        return {};
    return jackknife_of_mean(background, [veil](double l) { // METHODS eq. (111)
        return 27.0 + 24.0 * std::log10(veil / std::pow(l, 0.9));
    });
}

} // namespace isolux
