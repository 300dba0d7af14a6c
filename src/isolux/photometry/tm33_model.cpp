#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "isolux/photometry/findings.h"
#include "isolux/photometry/ies.h"
#include "isolux/photometry/ies_table.h"
#include "isolux/photometry/plane_symmetry.h"
#include "isolux/photometry/sum_distributions.h"
#include "isolux/photometry/tm33.h"

namespace isolux {

namespace {

/// The distinct angles, ascending, each with the line it first stands on.
std::vector<FileNumber> distinct(std::vector<FileNumber> angles) {
    std::ranges::stable_sort(angles, {}, &FileNumber::value);
    std::vector<FileNumber> kept;
    for (const FileNumber& a : angles)
        if (kept.empty() || a.value - kept.back().value > same_file_angle)
            kept.push_back(a);
    return kept;
}

std::size_t index_of(const std::vector<FileNumber>& angles, double value) {
    const auto at =
        std::ranges::lower_bound(angles, value - same_file_angle, {}, &FileNumber::value);
    return static_cast<std::size_t>(at - angles.begin());
}

/// The values in the order of a LM-63 table, whose rules for type C are those of TM-33.
IesDocument lay_out(const Tm33Emitter& e, const Findings& findings) {
    std::vector<FileNumber> h, v;
    for (const Tm33Value& value : e.values) {
        h.push_back(value.horizontal);
        v.push_back(value.vertical);
    }
    IesDocument table;
    table.photometric_type = {1.0, e.table_line};
    table.horizontal = distinct(std::move(h));
    table.vertical = distinct(std::move(v));
    const auto nh = static_cast<std::uint64_t>(table.horizontal.size());
    const auto nv = static_cast<std::uint64_t>(table.vertical.size());
    if (nv < 2)
        findings.fail(e.table_line,
                      std::to_string(nv)
                          + " vertical angles (a distribution needs at least 2)");
    if (nh * nv != e.values.size())
        findings.fail(e.table_line,
                      std::to_string(e.values.size()) + " intensities for " + std::to_string(nh)
                          + " x " + std::to_string(nv)
                          + " directions (every combination of angles must be there once)",
                      "Truncated file?");
    table.candela.assign(e.values.size(), FileNumber{0.0, 0});
    for (const Tm33Value& value : e.values) {
        FileNumber& place = table.candela[index_of(table.horizontal, value.horizontal.value)
                                              * table.vertical.size()
                                          + index_of(table.vertical, value.vertical.value)];
        if (place.line != 0)
            findings.fail(value.intensity.line,
                          "the direction h " + to_text(value.horizontal.value) + ", v "
                              + to_text(value.vertical.value) + " is given twice (line "
                              + std::to_string(place.line) + " has it, too)");
        place = value.intensity;
    }
    return table;
}

double factor_of(const Tm33Emitter& e, Findings& findings) {
    for (const auto& [n, what] :
         {std::pair{e.multiplier, "multiplier"}, std::pair{e.ballast_factor, "ballast factor"}})
        if (!(n.value > 0.0))
            findings.fail(n.line,
                          std::string(what) + " " + to_text(n.value)
                              + " (it multiplies every candela and must be above 0)");
    double factor = e.multiplier.value * e.ballast_factor.value;
    if (e.is_per_kilolumen) {
        if (!e.rated_lumens || !(e.rated_lumens->value > 0.0))
            findings.fail(e.table_line,
                          "intensities per 1000 lm, but no rated lumens (the absolute scale is "
                          "unknown)");
        factor *= e.rated_lumens->value / 1000.0;
    }
    return factor;
}

/// The flux the emitter states for what leaves it.
void check_flux(const Tm33Emitter& e, const IntensityDistribution& d, Findings& findings) {
    constexpr double allowed_ratio = 0.10;
    const std::optional<FileNumber> stated =
        e.luminous_flux ? e.luminous_flux
                        : (e.is_absolute ? e.rated_lumens : std::optional<FileNumber>());
    const double flux = d.flux_trapezoid().value();
    const bool misses =
        stated && stated->value > 0.0 && std::abs(flux / stated->value - 1.0) > allowed_ratio;
    const bool exceeds =
        !stated && e.rated_lumens && e.rated_lumens->value > 0.0
        && flux > 1.5 * std::max(1.0, e.quantity.value) * e.rated_lumens->value;
    if (misses || exceeds) {
        const FileNumber& n = misses ? *stated : *e.rated_lumens;
        findings.warn(n.line,
                      "the table gives " + to_text(std::round(flux))
                          + " lm, the emitter states " + to_text(std::round(n.value))
                          + " lm (they should agree; the table is used as it is)");
    }
    // hardly any luminaire loses that much, but a table per 1000 lm looks like it
    constexpr double least_output_ratio = 0.3;
    const double undimmed = flux / (e.multiplier.value * e.ballast_factor.value);
    if (!stated && !e.is_per_kilolumen && e.rated_lumens
        && undimmed < least_output_ratio * e.rated_lumens->value)
        findings.warn(e.rated_lumens->line,
                      "the table gives " + to_text(std::round(flux)) + " lm of the rated "
                          + to_text(std::round(e.rated_lumens->value))
                          + " lm (read as candelas; are they per 1000 lm?)");
}

LuminousOpening horizontal_opening(double x, double y, double z, bool is_round) {
    if (x == 0.0 && y == 0.0 && z == 0.0)
        return {};
    const OpeningShape shape =
        is_round ? (z > 0.0 ? OpeningShape::vertical_cylinder : OpeningShape::ellipse)
                 : (z > 0.0 ? OpeningShape::box : OpeningShape::rectangle);
    return {shape, Metre(x), Metre(y), Metre(z)};
}

LuminousOpening opening_of(const Tm33Document& d, Findings& findings) {
    if (!d.states_faces) {
        if (d.length > 0.0 && d.width > 0.0)
            findings.note(d.emitters.front().line,
                          "no emission areas (the footprint of the body is taken as the "
                          "luminous opening)");
        return horizontal_opening(d.width, d.length, 0.0, false);
    }
    const double z = std::ranges::max(d.side_heights);
    if (!d.horizontal_face) // sides only: they stand on the body's outline
        return horizontal_opening(d.width, d.length, z, false);
    const Tm33Face& f = *d.horizontal_face;
    return horizontal_opening(f.across, f.along_y, z, f.is_circular);
}

/// All emitters as one lamp set; alternatives is not what emitters are.
LampSet lamps_of(const Tm33Document& d, bool is_absolute) {
    LampSet all;
    double count = 0.0;
    double flux = 0.0;
    for (const Tm33Emitter& e : d.emitters) {
        const bool is_count = is_whole(e.quantity.value) && e.quantity.value >= 1.0;
        const double lamps = is_count ? e.quantity.value : 1.0;
        count += lamps;
        flux += e.rated_lumens ? std::max(0.0, e.rated_lumens->value) : 0.0;
        all.watts += std::max(0.0, e.input_watts.value);
        all.type += (all.type.empty() || e.description.empty() ? "" : ", ") + e.description;
    }
    all.lamps = static_cast<int>(std::min(count, 1e6)) * (is_absolute ? -1 : 1);
    all.flux = Lumen(is_absolute ? 0.0 : flux);
    all.colour = d.emitters.front().colour;
    all.colour_rendering = d.emitters.front().colour_rendering;
    return all;
}

} // namespace

LuminairePhotometry
to_photometry(const Tm33Document& d, const PhotometryOptions&, Findings& findings) {
    std::vector<IntensityDistribution> tables;
    std::string symmetry;
    std::optional<Lumen> declared = Lumen();
    for (const Tm33Emitter& e : d.emitters) {
        const IesDocument laid_out = lay_out(e, findings);
        IesTable table = make_table(laid_out, factor_of(e, findings), findings);
        check_flux(e, table.distribution, findings);
        symmetry = symmetry.empty() || symmetry == table.symmetry ? table.symmetry : "mixed";
        tables.push_back(std::move(table.distribution));
        if (declared && e.luminous_flux && e.luminous_flux->value > 0.0)
            *declared += Lumen(e.luminous_flux->value);
        else
            declared.reset();
    }
    if (d.emitters.size() > 1)
        findings.note(
            d.emitters[1].line,
            std::to_string(d.emitters.size())
                + " emitters (all shine at full power, from one point; their light is "
                  "added up)");
    const bool is_absolute = std::ranges::all_of(d.emitters, [](const Tm33Emitter& e) {
        return e.is_absolute || !e.rated_lumens || !(e.rated_lumens->value > 0.0);
    });
    const LampSet lamps = lamps_of(d, is_absolute);
    const LuminousOpening opening = opening_of(d, findings);
    LuminousOpening housing = horizontal_opening(d.width, d.length, d.height, false);
    if (housing.shape == OpeningShape::point)
        housing = opening;
    LuminairePhotometry l{.format = PhotometricFormat::tm33,
                          .photometric_type = 'C',
                          .symmetry = symmetry,
                          .planes_in_file = 0,
                          .gammas_in_file = 0,
                          .manufacturer = d.manufacturer,
                          .name = d.description,
                          .catalogue_number = d.catalogue_number,
                          .report = d.report,
                          .laboratory = d.laboratory,
                          .date = d.date,
                          .distribution = sum_distributions(tables),
                          .opening = opening,
                          .housing = housing,
                          .is_absolute = is_absolute,
                          .declared_flux = declared,
                          .lamp_sets = {lamps},
                          .input_watts = lamps.watts};
    if (std::ranges::any_of(d.side_heights, [](double h) { return h > 0.0; }))
        l.side_heights = {Metre(d.side_heights[0]),
                          Metre(d.side_heights[1]),
                          Metre(d.side_heights[2]),
                          Metre(d.side_heights[3])};
    std::vector<FileNumber> h, v;
    for (const Tm33Value& value : d.emitters.front().values) {
        h.push_back(value.horizontal);
        v.push_back(value.vertical);
    }
    l.planes_in_file = distinct(std::move(h)).size();
    l.gammas_in_file = distinct(std::move(v)).size();
    return l;
}

} // namespace isolux
