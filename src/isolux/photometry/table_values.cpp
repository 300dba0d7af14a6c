#include "isolux/photometry/table_values.h"

#include <algorithm>
#include <cmath>

namespace isolux {

std::vector<double>
scale_values(std::span<const FileNumber> stored, double factor, Findings& findings) {
    std::vector<double> values;
    values.reserve(stored.size());
    std::size_t negative = 0;
    const FileNumber* first_negative = nullptr;
    double largest = 0.0;
    for (const FileNumber& n : stored) {
        if (n.value < 0.0 && ++negative == 1)
            first_negative = &n;
        const double value = std::max(0.0, n.value) * factor;
        if (!std::isfinite(value))
            findings.fail(n.line,
                          to_text(n.value)
                              + " times all factors is out of range (no luminaire "
                                "has such an intensity)");
        largest = std::max(largest, value);
        values.push_back(value);
    }
    if (first_negative != nullptr)
        findings.warn(first_negative->line,
                      std::to_string(negative) + " negative intensities, the first "
                          + to_text(first_negative->value) + " (measurement noise; read as 0)");
    if (largest == 0.0)
        findings.warn(stored.front().line,
                      "every intensity is 0 (this luminaire gives no light)");
    return values;
}

std::vector<Angle> to_gammas(const std::vector<double>& in_degrees) {
    std::vector<Angle> gammas;
    gammas.reserve(in_degrees.size());
    for (double g : in_degrees) {
        if (const double nearest = 90.0 * std::round(g / 90.0);
            std::abs(g - nearest) < 0.5 * same_file_angle)
            g = nearest;
        gammas.push_back(degrees(std::clamp(g, 0.0, 180.0)));
    }
    return gammas;
}

std::vector<double> take_planes(std::span<const double> values,
                                std::size_t gammas,
                                std::span<const ExpandedPlane> planes) {
    std::vector<double> taken;
    taken.reserve(planes.size() * gammas);
    for (const ExpandedPlane& p : planes) {
        const auto plane = values.subspan(p.stored * gammas, gammas);
        taken.insert(taken.end(), plane.begin(), plane.end());
    }
    return taken;
}

} // namespace isolux
