#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "isolux/photometry/findings.h"
#include "isolux/photometry/ies.h"
#include "isolux/photometry/ies_opening.h"
#include "isolux/photometry/ies_table.h"
#include "isolux/photometry/source_text.h"

namespace isolux {

namespace {

using enum PhotometricFormat;

void expect_positive(const FileNumber& n, std::string_view what, const Findings& findings) {
    if (!(n.value > 0.0))
        findings.fail(n.line,
                      std::string(what) + " " + to_text(n.value)
                          + " (it multiplies every candela and must be above 0)");
}

/// Everything that multiplies the stored values, except the tilt.
double header_factor(const IesDocument& d, Findings& findings) {
    expect_positive(d.multiplier, "candela multiplier", findings);
    expect_positive(d.ballast_factor, "ballast factor", findings);
    double factor = d.multiplier.value * d.ballast_factor.value;
    const FileNumber& second = d.second_factor;
    switch (d.format) {
    case lm63_1986:
    case lm63_1991:
        expect_positive(second, "ballast-lamp factor", findings);
        factor *= second.value;
        break;
    case lm63_2019:
        if (second.value < 1.0 || second.value > 1.111)
            findings.warn(second.line,
                          "file generation type " + to_text(second.value)
                              + " (LM-63-2019 knows 1 to 1.111; it never multiplies)");
        break;
    default:
        if (second.value != 1.0)
            findings.warn(second.line,
                          to_text(second.value) + " in the field kept for future use ("
                              + to_string(d.format) + " asks for 1; ignored, not multiplied)");
    }
    return factor;
}

bool is_plain_file_name(std::string_view name) {
    return !name.empty() && name.size() <= 255 && !name.starts_with('.')
           && name.find_first_of("/\\:") == std::string_view::npos
           && name.find("..") == std::string_view::npos
           && std::ranges::all_of(name,
                                  [](char c) { return static_cast<unsigned char>(c) >= 32; });
}

std::optional<IesTilt>
find_tilt_file(const IesDocument& d, const PhotometryOptions& options, Findings& findings) {
    const std::string assumed = " (tilt factor 1 assumed)";
    if (d.format == lm63_2019)
        findings.warn(d.tilt_line, "TILT names a file (LM-63-2019 has no tilt files)");
    if (!is_plain_file_name(d.tilt)) {
        findings.warn(d.tilt_line,
                      "tilt file " + quoted(d.tilt)
                          + " is not a plain file name beside this one, not opened" + assumed);
        return std::nullopt;
    }
    const auto bytes = options.sibling ? options.sibling(d.tilt) : std::nullopt;
    if (!bytes) {
        findings.warn(d.tilt_line, "tilt file " + quoted(d.tilt) + " not found" + assumed);
        return std::nullopt;
    }
    try {
        return parse_tilt_file(*bytes, d.tilt);
    } catch (const InputError& error) {
        findings.warn(d.tilt_line,
                      "tilt file unreadable: " + to_string(error.messages().front()) + assumed);
        return std::nullopt;
    }
}

double
find_tilt_factor(const IesDocument& d, const PhotometryOptions& options, Findings& findings) {
    if (d.tilt == "NONE")
        return 1.0;
    const auto tilt = d.tilt_data ? d.tilt_data : find_tilt_file(d, options, findings);
    return tilt ? tilt_factor(*tilt, options.luminaire_tilt) : 1.0;
}

void check_header(const IesDocument& d, Findings& findings) {
    if (const double t = d.photometric_type.value; t != 1.0 && t != 2.0 && t != 3.0)
        findings.fail(d.photometric_type.line,
                      "photometric type " + to_text(t)
                          + " (must be 1 for C, 2 for B, 3 for A)");
    if (const double u = d.units.value; u != 1.0 && u != 2.0)
        findings.fail(d.units.line,
                      "units type " + to_text(u) + " (must be 1 for feet or 2 for metres)");
    if (!is_whole(d.lamps.value) || d.lamps.value < 1.0)
        findings.warn(d.lamps.line,
                      to_text(d.lamps.value)
                          + " lamps (must be a whole number from 1 up; read as 1)");
    const double lumens = d.lumens_per_lamp.value;
    if (lumens <= 0.0 && lumens != -1.0)
        findings.warn(d.lumens_per_lamp.line,
                      to_text(lumens)
                          + " lumens per lamp (neither rated lamps nor -1; read as absolute "
                            "photometry, -1)");
    if (d.input_watts.value < 0.0)
        findings.warn(d.input_watts.line,
                      to_text(d.input_watts.value) + " input watts (read as unknown, 0)");
}

/// Ultraviolet files put mW/sr where candelas belong and say so in keywords of their own.
void check_units_of_intensity(const IesDocument& d, Findings& findings) {
    for (const IesLabel& label : d.labels) {
        const std::string text = to_upper(label.text);
        const bool is_odd_unit = label.keyword == "_INTENSITYUNITS" && text != "CD"
                                 && text != "CANDELA" && text != "LM/SR";
        const bool is_odd_radiation =
            label.keyword == "_RADIATIONTYPE" && text.find("VIS") == std::string::npos;
        if (is_odd_unit || is_odd_radiation)
            findings.warn(label.line,
                          "[" + label.keyword + "] " + quoted(label.text)
                              + " (the values are not candelas; everything in lm, cd or lx "
                                "that follows from them is in that unit instead)");
    }
}

std::string first_label(const IesDocument& d) {
    const auto found =
        std::ranges::find_if(d.labels, [](const IesLabel& l) { return !l.text.empty(); });
    return found == d.labels.end() ? std::string{} : found->text;
}

std::string find_date(const IesDocument& d) {
    const std::string issued = find_text(d, "ISSUEDATE");
    return issued.empty() ? find_text(d, "DATE") : issued;
}

std::vector<LampSet> make_lamp_sets(const IesDocument& d, bool is_absolute) {
    LampSet set;
    set.lamps =
        is_whole(d.lamps.value) && d.lamps.value >= 1.0 ? static_cast<int>(d.lamps.value) : 1;
    set.type = find_text(d, "LAMP");
    if (set.type.empty())
        set.type = find_text(d, "LAMPCAT");
    set.watts = std::max(0.0, d.input_watts.value);
    if (is_absolute)
        set.lamps = -set.lamps;
    else
        set.flux = Lumen(std::abs(set.lamps) * d.lumens_per_lamp.value);
    return {std::move(set)};
}

/// More light than the rated lamps give: the lumens field holds something else (lm/W, say).
void check_efficiency(const IesDocument& d,
                      const IntensityDistribution& distribution,
                      Findings& findings) {
    constexpr double allowed_ratio = 1.5; // real lamps exceed their rating, but not by so much
    const double lamps = std::max(1.0, d.lamps.value) * d.lumens_per_lamp.value;
    const double flux = distribution.flux_trapezoid().value();
    if (lamps > 0.0 && flux > allowed_ratio * lamps)
        findings.warn(d.lumens_per_lamp.line,
                      "the table gives " + to_text(std::round(flux)) + " lm from lamps of "
                          + to_text(std::round(lamps))
                          + " lm (more than all of it; the table is used as it is)",
                      "Is the lumens field something else?");
}

/// Makers of absolute files state the luminaire's flux in keywords of their own.
std::optional<Lumen> find_declared_flux(const IesDocument& d) {
    for (const std::string_view keyword : {"_ABSOLUTELUMENS", "_TOTALLUMINAIRELUMENS"})
        if (const auto flux = parse_number(trim(find_text(d, keyword))); flux && *flux > 0.0)
            return Lumen(*flux);
    return std::nullopt;
}

/// Labels that no field of the model holds, each with the [MORE] lines that go on with it; the
/// free lines of a 1986 file become [OTHER].
std::vector<PhotometryLabel> find_other_labels(const IesDocument& d, std::string_view name) {
    constexpr std::array<std::string_view, 9> held{"TEST",
                                                   "TESTLAB",
                                                   "ISSUEDATE",
                                                   "MANUFAC",
                                                   "LUMCAT",
                                                   "LUMINAIRE",
                                                   "LAMP",
                                                   "FILEGENINFO",
                                                   "DATE"};
    std::vector<PhotometryLabel> others;
    bool is_held = true;
    for (const IesLabel& label : d.labels) {
        if (label.keyword == "MORE") {
            if (!is_held && !label.text.empty())
                others.back().text += " " + label.text;
            continue;
        }
        is_held = std::ranges::find(held, label.keyword) != held.end()
                  || (label.keyword.empty() && (label.text.empty() || label.text == name));
        if (!is_held)
            others.push_back({label.keyword.empty() ? "OTHER" : label.keyword, label.text});
    }
    return others;
}

} // namespace

LuminairePhotometry
to_photometry(const IesDocument& d, const PhotometryOptions& options, Findings& findings) {
    check_header(d, findings);
    check_units_of_intensity(d, findings);
    const double factor = header_factor(d, findings) * find_tilt_factor(d, options, findings);
    IesTable table = make_table(d, factor, findings);
    check_efficiency(d, table.distribution, findings);
    const bool is_absolute = d.lumens_per_lamp.value <= 0.0;
    const LuminousOpening opening = make_opening(d, findings);
    const std::string label = find_text(d, "LUMINAIRE");
    const std::string name = label.empty() && d.format == lm63_1986 ? first_label(d) : label;
    return {.format = d.format,
            .photometric_type = "CBA"[static_cast<int>(d.photometric_type.value) - 1],
            .symmetry = std::move(table.symmetry),
            .planes_in_file = d.horizontal.size(),
            .gammas_in_file = d.vertical.size(),
            .manufacturer = find_text(d, "MANUFAC"),
            .name = name,
            .catalogue_number = find_text(d, "LUMCAT"),
            .report = find_text(d, "TEST"),
            .laboratory = find_text(d, "TESTLAB"),
            .date = find_date(d),
            .distribution = std::move(table.distribution),
            .opening = opening,
            .housing = opening,
            .is_absolute = is_absolute,
            .declared_flux = find_declared_flux(d),
            .lamp_sets = make_lamp_sets(d, is_absolute),
            .input_watts = std::max(0.0, d.input_watts.value),
            .other_labels = find_other_labels(d, name)};
}

Parsed<LuminairePhotometry> to_photometry(const IesDocument& document,
                                          const PhotometryOptions& options) {
    Findings findings(document.source);
    LuminairePhotometry model = to_photometry(document, options, findings);
    return {std::move(model), findings.notices()};
}

} // namespace isolux
