#include "isolux/photometry/ldt.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "isolux/photometry/findings.h"
#include "isolux/photometry/ldt_lines.h"
#include "isolux/photometry/plane_symmetry.h"
#include "isolux/photometry/source_text.h"

namespace isolux {

namespace {

/// Far above any real file (361 planes at one degree), far below what could hurt.
constexpr int most_planes = 3601;
constexpr int most_gammas = 18001;
constexpr int most_lamp_sets = 100;

void read_head(LdtDocument& d, LdtLines& lines) {
    d.company = lines.take_text("company");
    d.type_indicator = lines.take_informative("type indicator");
    d.symmetry = lines.take_count("symmetry indicator", 0, 4);
    d.planes = lines.take_count("number of C planes", 1, most_planes);
    d.plane_step = lines.take_number("step of the C planes");
    d.gammas = lines.take_count("number of gamma angles", 2, most_gammas);
    d.gamma_step = lines.take_number("step of the gamma angles");
    d.report = lines.take_text("report number");
    d.name = lines.take_text("luminaire name");
    d.number = lines.take_text("luminaire number");
    d.file_name = lines.take_text("file name");
    d.date_and_user = lines.take_text("date and user");
    d.length = lines.take_number("luminaire length");
    d.width = lines.take_number("luminaire width");
    d.height = lines.take_number("luminaire height");
    d.luminous_length = lines.take_number("luminous length");
    d.luminous_width = lines.take_number("luminous width");
    for (FileNumber& h : d.luminous_heights)
        h = lines.take_number("luminous height");
    d.downward_flux = lines.take_number("downward flux fraction");
    d.light_output_ratio = lines.take_number("light output ratio");
    d.conversion_factor = lines.take_number("conversion factor of the intensities");
    d.tilt = lines.take_informative("tilt during measurement");
}

LdtLampSet read_lamp_set(LdtLines& lines, Findings& findings) {
    LdtLampSet set;
    set.lamps = lines.take_number("number of lamps");
    if (!is_whole(set.lamps.value))
        findings.fail(set.lamps.line,
                      to_text(set.lamps.value) + " as the number of lamps (must be whole)",
                      "Does line 26 count the lamp sets rightly?");
    set.type = lines.take_text("lamp type");
    set.flux = lines.take_number("flux of the lamp set");
    set.colour = lines.take_text("lamp colour");
    set.colour_rendering = lines.take_text("colour rendering");
    set.watts = lines.take_informative("watts of the lamp set");
    return set;
}

void read_lamp_sets(LdtDocument& d, LdtLines& lines, Findings& findings) {
    d.set_count = lines.take_number("number of lamp sets");
    if (!is_whole(d.set_count.value) || d.set_count.value < 0
        || d.set_count.value > most_lamp_sets)
        findings.fail(d.set_count.line,
                      to_text(d.set_count.value)
                          + " lamp sets (must be a whole number from 0 to "
                          + std::to_string(most_lamp_sets) + ")");
    for (int i = 0; i < static_cast<int>(d.set_count.value); ++i)
        d.lamp_sets.push_back(read_lamp_set(lines, findings));
    for (FileNumber& ratio : d.direct_ratios)
        ratio = lines.take_number("direct ratio");
}

void expect_ascending(const std::vector<FileNumber>& angles,
                      std::string_view what,
                      const Findings& findings) {
    for (std::size_t i = 1; i < angles.size(); ++i)
        if (!(angles[i].value - angles[i - 1].value > same_file_angle))
            findings.fail(angles[i].line,
                          std::string(what) + " " + to_text(angles[i].value) + " after "
                              + to_text(angles[i - 1].value) + " (they must ascend)",
                          "Does line 26 count the lamp sets rightly?");
}

/// The list wins over the step that was announced for it.
void check_step(const std::vector<FileNumber>& angles,
                const FileNumber& step,
                std::string_view what,
                Findings& findings) {
    constexpr double rounding = 0.02; // degrees; steps such as 360/7 are written shortened
    if (step.value <= 0.0)
        return;
    for (std::size_t i = 1; i < angles.size(); ++i)
        if (std::abs(angles[i].value - angles[i - 1].value - step.value) > rounding) {
            findings.warn(angles[i].line,
                          std::string(what) + " " + to_text(angles[i].value) + " after "
                              + to_text(angles[i - 1].value) + " (line "
                              + std::to_string(step.line) + " announces steps of "
                              + to_text(step.value) + "; the list is used)");
            return;
        }
}

void read_angles(LdtDocument& d, LdtLines& lines, Findings& findings) {
    const auto mc = static_cast<std::size_t>(d.planes.value);
    const auto ng = static_cast<std::size_t>(d.gammas.value);
    d.c_angles = lines.take_numbers(mc, "C angle");
    const bool is_rotational = d.symmetry.value == 1.0;
    if (!is_rotational) {
        expect_ascending(d.c_angles, "C angle", findings);
        if (d.c_angles.front().value < -same_file_angle
            || d.c_angles.back().value > 360.0 + same_file_angle)
            findings.fail(d.c_angles.front().line,
                          "C angles from " + to_text(d.c_angles.front().value) + " to "
                              + to_text(d.c_angles.back().value) + " (they run from 0 to 360)");
    }
    const bool are_all_zero =
        std::ranges::all_of(d.c_angles, [](const FileNumber& c) { return c.value == 0.0; });
    if (!are_all_zero)
        check_step(d.c_angles, d.plane_step, "C angle", findings);
    d.gamma_angles = lines.take_numbers(ng, "gamma angle");
    expect_ascending(d.gamma_angles, "gamma angle", findings);
    if (d.gamma_angles.front().value < -same_file_angle
        || d.gamma_angles.back().value > 180.0 + same_file_angle)
        findings.fail(
            (d.gamma_angles.front().value < 0 ? d.gamma_angles.front() : d.gamma_angles.back())
                .line,
            "gamma angles from " + to_text(d.gamma_angles.front().value) + " to "
                + to_text(d.gamma_angles.back().value)
                + " (0 is straight down, 180 straight up)");
    check_step(d.gamma_angles, d.gamma_step, "gamma angle", findings);
}

/// Where the list holds C = `angle`; the symmetry cannot do without it.
std::size_t find_plane(const LdtDocument& d, double angle, const Findings& findings) {
    for (std::size_t i = 0; i < d.c_angles.size(); ++i)
        if (is_same_angle(d.c_angles[i].value, angle))
            return i;
    findings.fail(d.planes.line,
                  to_text(d.planes.value) + " C planes without C" + to_text(angle)
                      + " (symmetry indicator " + to_text(d.symmetry.value)
                      + " needs that plane)");
}

/// Which planes of the list the file stores, in its order. Isym 3 begins at C270.
std::vector<std::size_t> planes_to_store(const LdtDocument& d, const Findings& findings) {
    const auto range = [](std::size_t first, std::size_t last) {
        std::vector<std::size_t> indices(last + 1 - first);
        std::iota(indices.begin(), indices.end(), first);
        return indices;
    };
    const std::size_t last = d.c_angles.size() - 1;
    switch (static_cast<int>(d.symmetry.value)) {
    case 1:
        return {0};
    case 2:
        return range(0, find_plane(d, 180.0, findings));
    case 3: {
        std::vector<std::size_t> indices = range(find_plane(d, 270.0, findings), last);
        if (is_same_angle(d.c_angles[last].value, 360.0))
            indices.pop_back();
        const auto front = range(0, find_plane(d, 90.0, findings));
        indices.insert(indices.end(), front.begin(), front.end());
        return indices;
    }
    case 4:
        return range(0, find_plane(d, 90.0, findings));
    default:
        return range(0, last);
    }
}

/// Whether the list could be that of a table without symmetry. Nobody asks this of the list of
/// a rotational one until the file turns out to store all of its planes.
bool are_planes_of_a_turn(const std::vector<FileNumber>& c_angles) {
    const auto too_close = [](const FileNumber& a, const FileNumber& b) {
        return !(b.value - a.value > same_file_angle);
    };
    return std::ranges::adjacent_find(c_angles, too_close) == c_angles.end()
           && c_angles.front().value >= -same_file_angle
           && c_angles.back().value <= 360.0 + same_file_angle;
}

void read_intensities(LdtDocument& d, LdtLines& lines, Findings& findings) {
    d.stored = planes_to_store(d, findings);
    const std::size_t ng = d.gamma_angles.size();
    const std::size_t mc = d.c_angles.size();
    if (d.stored.size() < mc && lines.remaining() == mc * ng
        && are_planes_of_a_turn(d.c_angles)) {
        findings.warn(d.symmetry.line,
                      "symmetry indicator " + to_text(d.symmetry.value) + ", but all "
                          + std::to_string(mc)
                          + " planes are stored (all are used, no symmetry assumed)");
        d.stores_all_planes = true;
        d.stored.resize(mc);
        std::iota(d.stored.begin(), d.stored.end(), std::size_t{0});
    }
    d.intensities = lines.take_numbers(d.stored.size() * ng, "intensity");
    if (lines.remaining() > 0)
        findings.warn(
            lines.line(),
            std::to_string(lines.remaining()) + " more line(s) after the table"
                + (lines.peek().empty() ? "" : ", from " + quoted(lines.peek()) + " on")
                + " (ignored)");
}

} // namespace

LdtDocument parse_ldt(const SourceText& text, Findings& findings) {
    LdtLines lines(text, findings);
    if (lines.remaining() <= 1 && (lines.remaining() == 0 || lines.peek().empty()))
        findings.fail(1, "the file is empty (no photometry)");
    LdtDocument document;
    document.source = findings.source();
    read_head(document, lines);
    read_lamp_sets(document, lines, findings);
    read_angles(document, lines, findings);
    read_intensities(document, lines, findings);
    return document;
}

Parsed<LdtDocument> parse_ldt(std::string_view bytes, std::string_view source) {
    Findings findings(source);
    const SourceText text(bytes, findings);
    LdtDocument document = parse_ldt(text, findings);
    return {std::move(document), findings.notices()};
}

} // namespace isolux
