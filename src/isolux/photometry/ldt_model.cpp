#include <algorithm>
#include <cmath>
#include <utility>

#include "isolux/photometry/findings.h"
#include "isolux/photometry/ldt.h"
#include "isolux/photometry/plane_symmetry.h"
#include "isolux/photometry/quantities.h"
#include "isolux/photometry/table_values.h"

namespace isolux {

namespace {

constexpr double intensities_are_per = 1000.0; // lm

/// Which lamp set lights the table, and what its flux makes of the stored cd/klm.
struct Lamp {
    std::size_t index = 0;
    Lumen flux;
    bool is_absolute = false;
    double watts = 0.0;
    bool has_scale = false; ///< the file tells the flux
};

Lamp choose_lamp(const LdtDocument& d, std::size_t wanted, Findings& findings) {
    if (d.lamp_sets.empty()) {
        if (wanted != 0)
            findings.fail(d.set_count.line,
                          "lamp set " + std::to_string(wanted + 1)
                              + " asked for (the file has none)");
        findings.warn(d.set_count.line,
                      "no lamp set (the absolute scale is unknown; 1000 lm assumed)",
                      "Override the flux?");
        return {0, Lumen(intensities_are_per), false, 0.0, false};
    }
    if (wanted >= d.lamp_sets.size())
        findings.fail(d.set_count.line,
                      "lamp set " + std::to_string(wanted + 1) + " asked for (the file has "
                          + std::to_string(d.lamp_sets.size()) + ")");
    const LdtLampSet& set = d.lamp_sets[wanted];
    Lamp lamp{wanted, Lumen(set.flux.value), set.lamps.value < 0, set.watts.value, true};
    if (!(set.flux.value > 0.0)) {
        findings.warn(set.flux.line,
                      "lamp flux " + to_text(set.flux.value)
                          + " lm (the absolute scale is unknown; 1000 lm assumed)",
                      "Override the flux?");
        lamp.flux = Lumen(intensities_are_per);
        lamp.has_scale = false;
    }
    return lamp;
}

double table_factor(const LdtDocument& d, const Lamp& lamp, Findings& findings) {
    double conversion = d.conversion_factor.value;
    if (conversion < 0.0)
        findings.fail(d.conversion_factor.line,
                      "conversion factor " + to_text(conversion)
                          + " (it multiplies every intensity and must not be negative)");
    if (conversion == 0.0) {
        findings.warn(d.conversion_factor.line,
                      "conversion factor 0 (it would put out the light; read as 1)");
        conversion = 1.0;
    }
    return conversion * lamp.flux.value() / intensities_are_per;
}

PlaneSymmetry symmetry_of(const LdtDocument& d) {
    constexpr std::array by_indicator{PlaneSymmetry::none,
                                      PlaneSymmetry::rotational,
                                      PlaneSymmetry::bilateral_0_180,
                                      PlaneSymmetry::bilateral_90_270,
                                      PlaneSymmetry::quadrant};
    return d.stores_all_planes ? PlaneSymmetry::none
                               : by_indicator[static_cast<std::size_t>(d.symmetry.value)];
}

void check_gammas(const LdtDocument& d, Findings& findings) {
    const FileNumber first = d.gamma_angles.front();
    const FileNumber last = d.gamma_angles.back();
    if (!is_same_angle(first.value, 0.0) && !is_same_angle(first.value, 90.0))
        findings.warn(first.line,
                      "gamma angles start at " + to_text(first.value)
                          + " (0 or 90 is usual; below the first angle 0 cd is assumed)");
    if (!is_same_angle(last.value, 90.0) && !is_same_angle(last.value, 180.0))
        findings.warn(last.line,
                      "gamma angles end at " + to_text(last.value)
                          + " (90 or 180 is usual; above the last angle 0 cd is assumed)");
}

void check_planes(const LdtDocument& d,
                  const std::vector<ExpandedPlane>& planes,
                  Findings& findings) {
    for (std::size_t i = 1; i < planes.size() && symmetry_of(d) == PlaneSymmetry::none; ++i)
        if (planes[i].degrees - planes[i - 1].degrees > 90.0 + same_file_angle) {
            findings.warn(d.c_angles.back().line,
                          "no C plane between " + to_text(planes[i - 1].degrees) + " and "
                              + to_text(planes[i].degrees) + " (interpolated across the gap)",
                          "Symmetry indicator wrong?");
            return;
        }
}

IntensityDistribution
make_distribution(const LdtDocument& d, double factor, Findings& findings) {
    check_gammas(d, findings);
    std::vector<double> stored;
    const bool is_rotational = symmetry_of(d) == PlaneSymmetry::rotational;
    for (const std::size_t i : d.stored) // which plane a rotational table stores tells nothing
        stored.push_back(is_rotational ? 0.0 : d.c_angles[i].value);
    std::vector<double> gammas;
    for (const FileNumber& g : d.gamma_angles)
        gammas.push_back(g.value);
    const auto planes = expand_planes(stored, symmetry_of(d));
    check_planes(d, planes, findings);
    const std::vector<double> values = scale_values(d.intensities, factor, findings);
    return {to_angles(planes), to_gammas(gammas), take_planes(values, gammas.size(), planes)};
}

/// Millimetres to metres; a negative size keeps its amount.
Metre to_size(const FileNumber& n, std::string_view what, Findings& findings) {
    constexpr double suspicious_size = 50.0; // m
    const double metres = std::abs(n.value) / 1000.0;
    if (n.value < 0.0)
        findings.warn(n.line,
                      std::string(what) + " " + to_text(n.value)
                          + " mm (sizes are not negative; the amount is used)");
    if (metres > suspicious_size)
        findings.warn(n.line,
                      std::string(what) + " " + to_text(n.value) + " mm (larger than a house)");
    return Metre(metres);
}

/// The body whose length lies along C90-C270, our y. Width 0 means round.
LuminousOpening make_body(Metre length, Metre width, Metre height) {
    const Metre none;
    if (length == none && width == none)
        return height == none ? LuminousOpening{}
                              : LuminousOpening{OpeningShape::box, none, none, height};
    if (width == none || length == none) {
        const Metre diameter = std::max(length, width);
        return {height == none ? OpeningShape::ellipse : OpeningShape::vertical_cylinder,
                diameter,
                diameter,
                height};
    }
    return {
        height == none ? OpeningShape::rectangle : OpeningShape::box, width, length, height};
}

struct Bodies {
    LuminousOpening opening;
    LuminousOpening housing;
    std::array<Metre, 4> side_heights;
};

Bodies make_bodies(const LdtDocument& d, Findings& findings) {
    Bodies b;
    b.housing = make_body(to_size(d.length, "luminaire length", findings),
                          to_size(d.width, "luminaire width", findings),
                          to_size(d.height, "luminaire height", findings));
    for (std::size_t i = 0; i < 4; ++i)
        b.side_heights[i] = to_size(d.luminous_heights[i], "luminous height", findings);
    const Metre length = to_size(d.luminous_length, "luminous length", findings);
    const Metre width = to_size(d.luminous_width, "luminous width", findings);
    b.opening = make_body(length, width, std::ranges::max(b.side_heights));
    if (length == Metre() && width > Metre())
        findings.warn(
            d.luminous_width.line,
            "luminous width without a length (read as the diameter of a round opening)");
    return b;
}

/// Lines 22 and 23 never scale anything, but they tell when the table and its lamp disagree.
void check_against_declaration(const LdtDocument& d,
                               const IntensityDistribution& distribution,
                               const std::optional<Lumen>& declared,
                               Findings& findings) {
    constexpr double allowed_ratio = 0.10; // 999 of 1000 real files are nearer
    constexpr double allowed_points = 1.0; // of 6592 real files the farthest missed by 0.18
    const double dff = d.downward_flux.value;
    const double flux = distribution.flux_trapezoid().value();
    if (dff < 0.0 || dff > 100.0)
        findings.warn(d.downward_flux.line,
                      "downward flux fraction " + to_text(dff)
                          + " % (must lie between 0 and 100; only the table counts)");
    else if (flux > 0.0) {
        const double percent = 100.0 * downward_fraction(distribution);
        if (std::abs(percent - dff) > allowed_points)
            findings.warn(d.downward_flux.line,
                          "downward flux fraction " + to_text(dff) + " % (the table gives "
                              + to_text(std::round(10.0 * percent) / 10.0)
                              + " %; only the table counts)");
    }
    if (!declared || !(flux > 0.0))
        return;
    const double ratio = flux / declared->value();
    if (std::abs(ratio - 1.0) > allowed_ratio)
        findings.warn(d.light_output_ratio.line,
                      "the table gives " + to_text(std::round(flux))
                          + " lm, lamp flux and light "
                            "output ratio "
                          + to_text(std::round(declared->value()))
                          + " lm (they should agree; the table is used as it is)");
}

std::vector<LampSet> make_lamp_sets(const LdtDocument& d) {
    std::vector<LampSet> sets;
    for (const LdtLampSet& s : d.lamp_sets)
        sets.push_back({static_cast<int>(s.lamps.value),
                        s.type,
                        Lumen(std::max(0.0, s.flux.value)),
                        s.colour,
                        s.colour_rendering,
                        s.watts.value});
    return sets;
}

} // namespace

LuminairePhotometry
to_photometry(const LdtDocument& d, const PhotometryOptions& options, Findings& findings) {
    const Lamp lamp = choose_lamp(d, options.lamp_set, findings);
    IntensityDistribution distribution =
        make_distribution(d, table_factor(d, lamp, findings), findings);
    const Bodies bodies = make_bodies(d, findings);
    std::optional<Lumen> declared;
    if (lamp.has_scale && d.light_output_ratio.value > 0.0)
        declared = (d.light_output_ratio.value / 100.0) * lamp.flux;
    check_against_declaration(d, distribution, declared, findings);
    return {.format = PhotometricFormat::eulumdat,
            .photometric_type = 'C',
            .symmetry = to_string(symmetry_of(d)),
            .planes_in_file = d.stored.size(),
            .gammas_in_file = d.gamma_angles.size(),
            .manufacturer = d.company,
            .name = d.name,
            .catalogue_number = d.number,
            .report = d.report,
            .date = d.date_and_user,
            .distribution = std::move(distribution),
            .opening = bodies.opening,
            .housing = bodies.housing,
            .is_absolute = lamp.is_absolute,
            .declared_flux = declared,
            .lamp_sets = make_lamp_sets(d),
            .lamp_set = lamp.index,
            .input_watts = std::max(0.0, lamp.watts),
            .side_heights = bodies.side_heights};
}

Parsed<LuminairePhotometry> to_photometry(const LdtDocument& document,
                                          const PhotometryOptions& options) {
    Findings findings(document.source);
    LuminairePhotometry model = to_photometry(document, options, findings);
    return {std::move(model), findings.notices()};
}

} // namespace isolux
