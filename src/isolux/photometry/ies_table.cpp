#include "isolux/photometry/ies_table.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "isolux/photometry/findings.h"
#include "isolux/photometry/plane_symmetry.h"
#include "isolux/photometry/table_values.h"

namespace isolux {

namespace {

std::vector<double> values_of(std::span<const FileNumber> numbers) {
    std::vector<double> values;
    values.reserve(numbers.size());
    for (const FileNumber& n : numbers)
        values.push_back(n.value);
    return values;
}

std::string range_text(std::span<const FileNumber> angles) {
    return to_text(angles.front().value) + " to " + to_text(angles.back().value);
}

// ---- type C ------------------------------------------------------------------------------

void check_verticals_c(const IesDocument& d, Findings& findings) {
    const FileNumber first = d.vertical.front();
    const FileNumber last = d.vertical.back();
    if (first.value < -same_file_angle)
        findings.fail(first.line,
                      "vertical angle " + to_text(first.value)
                          + " in type C photometry (its vertical angles run from 0 to 180)",
                      "Photometric type A or B?");
    if (last.value > 180.0 + same_file_angle)
        findings.fail(last.line,
                      "vertical angle " + to_text(last.value)
                          + " in type C photometry (180 is straight up)");
    if (!is_same_angle(first.value, 0.0) && !is_same_angle(first.value, 90.0))
        findings.warn(
            first.line,
            "vertical angles start at " + to_text(first.value)
                + " (LM-63 starts at 0 or 90; below the first angle 0 cd is assumed)");
    if (!is_same_angle(last.value, 90.0) && !is_same_angle(last.value, 180.0))
        findings.warn(last.line,
                      "vertical angles end at " + to_text(last.value)
                          + " (LM-63 ends at 90 or 180; above the last angle 0 cd is assumed)");
}

/// Planes all round: where the file states 0 and 360, they should agree.
void check_closing_plane(const IesDocument& d, Findings& findings) {
    const std::size_t nv = d.vertical.size();
    const auto first = std::span(d.candela).first(nv);
    const auto last = std::span(d.candela).last(nv);
    const auto differ = std::ranges::mismatch(
        first, last, [](FileNumber a, FileNumber b) { return a.value == b.value; });
    if (differ.in2 != last.end())
        findings.warn(differ.in2->line,
                      "the last plane repeats the first but differs from it (the values of the "
                      "first are used)");
}

PlaneSymmetry symmetry_all_round(const IesDocument& d, Findings& findings) {
    const double first = d.horizontal.front().value;
    const double last = d.horizontal.back().value;
    const std::size_t line = d.horizontal.front().line;
    if (is_same_angle(last - first, 360.0)) {
        if (!is_same_angle(first, 0.0))
            findings.warn(line,
                          "horizontal angles " + range_text(d.horizontal)
                              + " (LM-63 counts from 0 to 360; reduced to that)");
        check_closing_plane(d, findings);
        return PlaneSymmetry::none;
    }
    if (is_same_angle(first, 0.0) && last > 180.0 && last < 360.0) {
        findings.warn(line,
                      "horizontal angles end at " + to_text(last)
                          + " (the plane 360 is left out; plane 0 closes the circle)");
        return PlaneSymmetry::none;
    }
    findings.fail(line,
                  "horizontal angles " + range_text(d.horizontal)
                      + " (LM-63 type C knows 0, 0 to 90, 0 to 180, 90 to 270 and 0 to 360)");
}

PlaneSymmetry symmetry_c(const IesDocument& d, Findings& findings) {
    const double first = d.horizontal.front().value;
    const double last = d.horizontal.back().value;
    const auto runs = [&](double a, double b) {
        return is_same_angle(first, a) && is_same_angle(last, b);
    };
    if (d.horizontal.size() == 1)
        return PlaneSymmetry::rotational;
    if (runs(0, 90)) {
        if (d.horizontal.size() == 2)
            findings.note(d.horizontal.front().line,
                          "only the planes 0 and 90 are stored (linear between them)");
        return PlaneSymmetry::quadrant;
    }
    if (runs(0, 180))
        return PlaneSymmetry::bilateral_0_180;
    if (runs(90, 270))
        return PlaneSymmetry::bilateral_90_270;
    return symmetry_all_round(d, findings);
}

IesTable
make_table_c(const IesDocument& d, std::span<const double> values, Findings& findings) {
    check_verticals_c(d, findings);
    const PlaneSymmetry symmetry = symmetry_c(d, findings);
    const auto planes = expand_planes(values_of(d.horizontal), symmetry);
    return {IntensityDistribution(to_angles(planes),
                                  to_gammas(values_of(d.vertical)),
                                  take_planes(values, d.vertical.size(), planes)),
            to_string(symmetry)};
}

// ---- types A and B -----------------------------------------------------------------------

/// The stored horizontal angles with their mirror images, ascending.
struct Horizontals {
    std::vector<ExpandedPlane> planes;
    bool is_mirrored = false;
};

Horizontals expand_horizontals(const IesDocument& d, Findings& findings) {
    const FileNumber first = d.horizontal.front();
    const FileNumber last = d.horizontal.back();
    if (d.horizontal.size() < 2)
        findings.fail(first.line,
                      "one horizontal angle in type A or B photometry (0 to 90 or -90 to 90 "
                      "expected)");
    if (first.value < -90.0 - same_file_angle || last.value > 90.0 + same_file_angle)
        findings.fail(first.line,
                      "horizontal angles " + range_text(d.horizontal)
                          + " in type A or B photometry (they run from -90 to 90)",
                      "Photometric type C?");
    Horizontals h;
    h.is_mirrored = is_same_angle(first.value, 0.0);
    if (!is_same_angle(last.value, 90.0)
        || (!h.is_mirrored && !is_same_angle(first.value, -90.0)))
        findings.warn(
            first.line,
            "horizontal angles " + range_text(d.horizontal)
                + " (types A and B know 0 to 90 and -90 to 90; 0 cd is assumed beyond)");
    if (h.is_mirrored)
        for (std::size_t i = d.horizontal.size(); i-- > 1;)
            h.planes.push_back({-d.horizontal[i].value, i});
    for (std::size_t i = 0; i < d.horizontal.size(); ++i)
        h.planes.push_back({d.horizontal[i].value, i});
    return h;
}

void check_verticals_ab(const IesDocument& d, Findings& findings) {
    const FileNumber first = d.vertical.front();
    const FileNumber last = d.vertical.back();
    if (first.value < -90.0 - same_file_angle || last.value > 90.0 + same_file_angle)
        findings.fail(first.line,
                      "vertical angles " + range_text(d.vertical)
                          + " in type A or B photometry (they run from -90 to 90)",
                      "Photometric type C?");
    const bool starts_well =
        is_same_angle(first.value, -90.0) || is_same_angle(first.value, 0.0);
    if (!starts_well || !is_same_angle(last.value, 90.0))
        findings.warn(
            first.line,
            "vertical angles " + range_text(d.vertical)
                + " (types A and B know 0 to 90 and -90 to 90; 0 cd is assumed beyond)");
}

std::vector<double> shifted(std::vector<double> degrees_in_file, double by) {
    for (double& a : degrees_in_file)
        a += by;
    return degrees_in_file;
}

/// C = -H: the order of the planes turns round.
IntensityDistribution
lay_out_type_a(const IesDocument& d, std::span<const double> values, const Horizontals& h) {
    std::vector<ExpandedPlane> planes;
    for (auto p = h.planes.rbegin(); p != h.planes.rend(); ++p)
        planes.push_back({-p->degrees, p->stored});
    return {to_angles(planes),
            to_gammas(shifted(values_of(d.vertical), 90.0)),
            take_planes(values, d.vertical.size(), planes)};
}

/// C = V, gamma = H + 90 about the y axis: the table transposed.
IntensityDistribution
lay_out_type_b(const IesDocument& d, std::span<const double> values, const Horizontals& h) {
    const std::size_t nv = d.vertical.size();
    std::vector<Angle> planes;
    std::vector<double> candela;
    candela.reserve(nv * h.planes.size());
    for (std::size_t v = 0; v < nv; ++v) {
        planes.push_back(degrees(d.vertical[v].value));
        for (const ExpandedPlane& p : h.planes)
            candela.push_back(values[p.stored * nv + v]);
    }
    std::vector<double> gammas;
    for (const ExpandedPlane& p : h.planes)
        gammas.push_back(p.degrees + 90.0);
    return {std::move(planes), to_gammas(gammas), std::move(candela), TablePole::lateral};
}

} // namespace

IesTable make_table(const IesDocument& d, double factor, Findings& findings) {
    const std::vector<double> values = scale_values(d.candela, factor, findings);
    if (d.photometric_type.value == 1.0)
        return make_table_c(d, values, findings);
    check_verticals_ab(d, findings);
    const Horizontals h = expand_horizontals(d, findings);
    return {d.photometric_type.value == 3.0 ? lay_out_type_a(d, values, h)
                                            : lay_out_type_b(d, values, h),
            h.is_mirrored ? "mirrored in H" : "none"};
}

} // namespace isolux
