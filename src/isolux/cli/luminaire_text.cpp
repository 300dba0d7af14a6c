#include "isolux/cli/luminaire_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/photometry/bug_rating.h"
#include "isolux/photometry/quantities.h"

namespace isolux {

namespace {

/// A line of the report: what it is about, then what there is to say.
std::string row(std::string_view about, const std::string& text) {
    return fmt::format("  {:<18}{}\n", about, text);
}

std::string who(const LuminairePhotometry& l) {
    std::string text;
    for (const std::string& part : {l.manufacturer, l.name, l.catalogue_number})
        if (!part.empty())
            text += (text.empty() ? "" : ", ") + part;
    return text.empty() ? "(not named)" : text;
}

std::string measured(const LuminairePhotometry& l) {
    std::string text;
    for (const std::string& part : {l.report, l.laboratory, l.date})
        if (!part.empty())
            text += (text.empty() ? "" : ", ") + part;
    return text;
}

std::string flux(const LuminairePhotometry& l) {
    const double table = in_lumen(l.distribution.flux_trapezoid());
    std::string text = fmt::format("{:.6g} lm (trapezoid rule), {:.6g} lm (interpolant)",
                                   table,
                                   in_lumen(l.distribution.flux()));
    if (l.declared_flux)
        text += fmt::format("; declared {:.6g} lm, table {:.4g} % of it",
                            in_lumen(*l.declared_flux),
                            100.0 * table / in_lumen(*l.declared_flux));
    return text;
}

std::string percent(double share) { return fmt::format("{:.2f} %", 100.0 * share); }

std::string output_ratio(const LuminairePhotometry& l) {
    const std::string down = percent(downward_fraction(l.distribution)) + " downward";
    const auto ratio = light_output_ratio(l);
    if (!ratio)
        return "absolute photometry (no lamp flux to divide by), " + down;
    return fmt::format("{}, of which downward {} (fraction {})",
                       percent(*ratio),
                       percent(*downward_light_output_ratio(l)),
                       percent(downward_fraction(l.distribution)));
}

std::string lamps(const LuminairePhotometry& l) {
    if (l.lamp_set >= l.lamp_sets.size())
        return "none stated";
    const LampSet& set = l.lamp_sets[l.lamp_set];
    std::string text = std::to_string(std::abs(set.lamps));
    if (!set.type.empty())
        text += " x " + set.type;
    if (const auto rated = rated_lamp_flux(l))
        text += fmt::format(", {:.6g} lm in all", in_lumen(*rated));
    if (!set.colour.empty())
        text += ", " + set.colour;
    if (!set.colour_rendering.empty())
        text += ", colour rendering " + set.colour_rendering;
    if (l.lamp_sets.size() > 1)
        text += fmt::format(" (set {} of {})", l.lamp_set + 1, l.lamp_sets.size());
    return text;
}

std::string power(const LuminairePhotometry& l) {
    const auto efficacy = luminous_efficacy(l);
    return efficacy ? fmt::format("{:.6g} W, {:.4g} lm/W", l.input_watts, *efficacy)
                    : "not stated";
}

std::string body(const LuminousOpening& o) {
    if (o.shape == OpeningShape::point)
        return "point";
    std::string text = fmt::format("{}, x {:.4g} m, y {:.4g} m, z {:.4g} m",
                                   to_string(o.shape),
                                   in_metre(o.extent_x),
                                   in_metre(o.extent_y),
                                   in_metre(o.extent_z));
    const double x = in_metre(o.extent_x);
    const double y = in_metre(o.extent_y);
    if (std::max(x, y) > 1.05 * std::min(x, y))
        text += fmt::format("; long side along {}", x > y ? "x (C0-C180)" : "y (C90-C270)");
    return text;
}

std::string angles(const IntensityDistribution& d, double share) {
    std::string text;
    for (const int c : {0, 90}) {
        const auto beam = find_beam(d, degrees(c), share);
        text += fmt::format("{}C{}-C{} {}",
                            text.empty() ? "" : ", ",
                            c,
                            c + 180,
                            beam ? fmt::format("{:.4g} degrees", beam->full().in_degrees())
                                 : "dark");
    }
    return text;
}

std::string zones(const IntensityDistribution& d) {
    std::vector<std::string> parts;
    for (const Lumen zone : zonal_flux(d))
        parts.push_back(fmt::format("{:.4g}", in_lumen(zone)));
    return fmt::format("{} lm", fmt::join(parts, " "));
}

std::string luminances(const LuminairePhotometry& l) {
    std::string text = row("luminance, cd/m2", "gamma 45, 55, 65, 75, 85");
    for (const int c : {0, 90, 180, 270}) {
        std::string values;
        for (int gamma = 45; gamma <= 85; gamma += 10) {
            const auto luminance = mean_luminance(l, degrees(c), degrees(gamma));
            values += luminance ? fmt::format(" {:>8.0f}", luminance->value()) : "        -";
        }
        text += row("", fmt::format("C{:<4}{}", c, values));
    }
    return text;
}

std::string flux_code(const LuminairePhotometry& l) {
    const auto code = cie_flux_code(l);
    std::vector<std::string> parts;
    for (const double n : code)
        parts.push_back(fmt::format("{:.0f}", n));
    return fmt::format("{}", fmt::join(parts, " "));
}

std::string bug(const LuminairePhotometry& l) {
    const BugZones z = bug_zones(l.distribution, street_side_by_convention(l.format));
    return fmt::format("{} (types I to IV), {} (type V); street side at C{:.0f}",
                       to_string(rate(z, LateralType::asymmetric)),
                       to_string(rate(z, LateralType::symmetric)),
                       street_side_by_convention(l.format).in_degrees());
}

} // namespace

std::string to_info_text(const std::string& file, const LuminairePhotometry& l) {
    const IntensityDistribution& d = l.distribution;
    const MaximumIntensity peak = find_maximum(d);
    std::string text = fmt::format("{}: {}, type {}, symmetry {}, {} plane{} x {} angles\n",
                                   file,
                                   to_string(l.format),
                                   l.photometric_type,
                                   l.symmetry,
                                   l.planes_in_file,
                                   l.planes_in_file == 1 ? "" : "s",
                                   l.gammas_in_file);
    text += row("luminaire", who(l));
    if (const std::string report = measured(l); !report.empty())
        text += row("report", report);
    if (!l.contained_file.empty())
        text += row("light from", l.contained_file);
    text += row("flux", flux(l));
    text += row("output ratio", output_ratio(l));
    text += row("lamps", lamps(l));
    text += row("power", power(l));
    text += row("maximum",
                fmt::format("{:.6g} cd at C {:.4g}, gamma {:.4g}",
                            peak.value.value(),
                            peak.plane.in_degrees(),
                            peak.gamma.in_degrees()));
    text += row("beam (50 %)", angles(d, 0.5));
    text += row("field (10 %)", angles(d, 0.1));
    text += row("CIE flux code", flux_code(l));
    text += row("zones of 10 deg", zones(d));
    text += row("opening", body(l.opening));
    if (l.housing.extent_x != l.opening.extent_x || l.housing.extent_y != l.opening.extent_y
        || l.housing.extent_z != l.opening.extent_z)
        text += row("housing", body(l.housing));
    text += luminances(l);
    text += row("BUG", bug(l));
    return text;
}

} // namespace isolux
