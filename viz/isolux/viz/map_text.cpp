#include "isolux/viz/map_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "isolux/viz/colour_scale.h"

namespace isolux {

namespace {

double half_width(const Estimate& e, double confidence) {
    const Interval i = confidence_interval(e, confidence);
    return 0.5 * (i.upper - i.lower);
}

/// A share in per cent with two digits that count: "0.35 %", "1.0 %", "12 %".
std::string per_cent(double share) {
    const double p = 100.0 * share;
    const int decimals = p >= 9.95 ? 0 : (p >= 0.995 ? 1 : 2);
    return fmt::format("{:.{}f} %", p, decimals);
}

/// A tolerance as its owner wrote it: "1 %", "0.5 %".
std::string plain_per_cent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

std::string lux(const char* name, const Estimate& e, double confidence) {
    std::string text = fmt::format("{} {} lx", name, format_lux(e.mean));
    const double half = half_width(e, confidence);
    if (half > 0.0)
        text += e.mean > 0.0 ? " ± " + per_cent(half / e.mean)
                             : fmt::format(" ± {} lx", format_lux(half));
    return text;
}

std::string ratio(const char* name, const Estimate& e, double confidence) {
    if (e.mean < 0.0005)
        return fmt::format("{} < 0.001", name);
    std::string text = fmt::format("{} {:.{}f}", name, e.mean, e.mean < 0.0995 ? 3 : 2);
    if (const double half = half_width(e, confidence); half > 0.0 && e.mean > 0.0)
        text += " ± " + per_cent(half / e.mean);
    return text;
}

std::string quantity(IlluminanceKind kind) {
    switch (kind) {
    case IlluminanceKind::planar:
        return "Illuminance";
    case IlluminanceKind::cylindrical:
        return "Cylindrical illuminance";
    case IlluminanceKind::semi_cylindrical:
        return "Semi-cylindrical illuminance";
    case IlluminanceKind::hemispherical:
        return "Hemispherical illuminance";
    case IlluminanceKind::mean_spherical:
        return "Mean spherical illuminance";
    }
    return {};
}

std::string points_text(const SurfaceResult& result) {
    const std::size_t n = result.points.size();
    if (!result.surface.grid)
        return n == 1 ? "1 point" : fmt::format("{} points", n);
    const GridCounts counts = result.surface.grid->counts;
    std::string text = fmt::format("grid {} × {}", counts.columns, counts.rows);
    if (n != counts.columns * counts.rows)
        text += fmt::format(", {} points inside", n);
    return text;
}

std::string trust_text(const SurfaceResult& result, const MapNotes& notes) {
    const double worst = worst_relative_error(result, notes);
    if (worst <= 0.0)
        return "without statistical error";
    const std::string intervals = fmt::format("{} intervals", plain_per_cent(notes.confidence));
    if (result.converged)
        return fmt::format("{}, every point within ± {} (asked for {})",
                           intervals,
                           per_cent(worst),
                           plain_per_cent(notes.tolerance));
    return fmt::format("{}; NOT CONVERGED: points known to ± {} only (asked for {})",
                       intervals,
                       per_cent(worst),
                       plain_per_cent(notes.tolerance));
}

} // namespace

double worst_relative_error(const SurfaceResult& result, const MapNotes& notes) {
    const double floor =
        notes.tolerance > 0.0 ? notes.absolute_tolerance / notes.tolerance : 0.0;
    double worst = 0.0;
    for (const PointResult& p : result.points) {
        const double scale = std::max(std::abs(p.total.mean), floor);
        if (scale > 0.0)
            worst = std::max(worst, half_width(p.total, notes.confidence) / scale);
    }
    return worst;
}

double typical_half_width(const SurfaceResult& result, double confidence) {
    std::vector<double> widths;
    for (const PointResult& p : result.points)
        widths.push_back(half_width(p.total, confidence));
    if (widths.empty())
        return 0.0;
    const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
    std::nth_element(widths.begin(), middle, widths.end());
    return *middle;
}

PageText describe_result(const SurfaceResult& result, const MapNotes& notes) {
    PageText text;
    text.title = result.surface.name;
    text.project = notes.project;
    text.largest_width = notes.largest_width;
    const SurfaceSummary& s = result.summary;
    if (result.points.size() == 1)
        text.figures = lux("E", result.points.front().total, notes.confidence);
    else
        text.figures = fmt::format("{}\u2003 {}\u2003 {}\u2003 {}",
                                   lux("Em", s.mean, notes.confidence),
                                   ratio("U0", s.uniformity, notes.confidence),
                                   lux("Emin", s.minimum, notes.confidence),
                                   lux("Emax", s.maximum, notes.confidence));
    text.remarks = {fmt::format("{}, {}; {}",
                                quantity(result.surface.kind),
                                points_text(result),
                                trust_text(result, notes))};
    return text;
}

} // namespace isolux
