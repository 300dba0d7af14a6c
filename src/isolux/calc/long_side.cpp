#include "isolux/calc/long_side.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace isolux {

namespace {

/// A direction without a sense, to the degree.
std::string name_direction(const Vector3& v) {
    const double flat = std::hypot(v.x, v.y);
    if (std::abs(v.z) > 50.0 * flat)
        return "the vertical";
    double turn = std::atan2(v.y, v.x) * (180.0 / std::numbers::pi);
    turn = std::round(turn < 0.0 ? turn + 180.0 : turn);
    std::string name = turn == 0.0 || turn == 180.0 ? "world x"
                       : turn == 90.0               ? "world y"
                                      : fmt::format("{:.0f} degrees from x to y", turn);
    const double rise =
        std::round(std::atan(std::abs(v.z) / flat) * (180.0 / std::numbers::pi));
    if (rise > 0.0)
        name += fmt::format(" rising {:.0f} degrees", rise);
    return name;
}

} // namespace

std::string describe_long_side(const LuminaireType& type,
                               std::span<const Frame> world_from_luminaire) {
    return describe_long_side(find_long_side(type), world_from_luminaire);
}

std::string describe_long_side(const std::optional<LongSide>& long_side,
                               std::span<const Frame> world_from_luminaire) {
    if (!long_side)
        return "no long side";
    std::vector<std::pair<std::string, std::size_t>> directions;
    for (const Frame& frame : world_from_luminaire) {
        const std::string name =
            name_direction(long_side->is_along_y ? Vector3(frame.y) : Vector3(frame.x));
        const auto known = std::find_if(directions.begin(),
                                        directions.end(),
                                        [&](const auto& d) { return d.first == name; });
        if (known == directions.end())
            directions.emplace_back(name, 1);
        else
            ++known->second;
    }
    const std::string side = fmt::format("long side {:.3g} m", long_side->length);
    if (directions.size() == 1)
        return side + " along " + directions.front().first;
    if (directions.size() > 4)
        return fmt::format("{} in {} directions", side, directions.size());
    std::string all;
    for (const auto& [name, count] : directions)
        all += fmt::format("{}{} ({})", all.empty() ? "" : ", ", name, count);
    return side + " along " + all;
}

std::vector<std::string> describe_luminaires(std::span<const LuminaireType> types,
                                             std::span<const LuminairePlacement> placements) {
    std::vector<std::string> lines;
    for (std::size_t t = 0; t < types.size(); ++t) {
        std::vector<Frame> frames;
        double flux = 0.0;
        for (const LuminairePlacement& p : placements) {
            if (p.type != LuminaireTypeId(t))
                continue;
            frames.push_back(p.world_from_luminaire);
            flux += p.scale * in_lumen(luminous_flux(types[t]));
        }
        if (frames.empty())
            continue;
        const double each = in_lumen(luminous_flux(types[t]));
        const double all = each * static_cast<double>(frames.size());
        const double kept = all > 0.0 ? flux / all : 1.0;
        const std::string factor = std::abs(kept - 1.0) < 5e-4
                                       ? ""
                                       : fmt::format(" x {:.3g} (maintenance, dimming)", kept);
        lines.push_back(fmt::format("{} x {}{}: {:.0f} lm each{}, {:.0f} lm in all as hung; {}",
                                    frames.size(),
                                    types[t].name,
                                    types[t].file.empty() ? "" : " (" + types[t].file + ")",
                                    each,
                                    factor,
                                    flux,
                                    describe_long_side(types[t], frames)));
    }
    return lines;
}

} // namespace isolux
