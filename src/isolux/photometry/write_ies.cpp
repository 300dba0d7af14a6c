#include "isolux/photometry/write_ies.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>

#include "isolux/base/check.h"
#include "isolux/photometry/file_number.h"
#include "isolux/photometry/stored_table.h"

namespace isolux {

namespace {

constexpr std::string_view line_end = "\r\n";

/// What stands between header and end of file, whatever the photometric type.
struct IesGrid {
    std::vector<double> vertical;
    std::vector<double> horizontal;
    std::vector<double> candela; ///< vertical fastest
};

IesGrid type_c_grid(const IntensityDistribution& d) {
    StoredTable table = make_stored_table(d);
    IesGrid grid{std::move(table.gammas), std::move(table.planes), std::move(table.candela)};
    if (table.symmetry == PlaneSymmetry::none) {
        grid.horizontal.push_back(360.0);
        grid.candela.insert(grid.candela.end(),
                            grid.candela.begin(),
                            grid.candela.begin()
                                + static_cast<std::ptrdiff_t>(grid.vertical.size()));
    }
    return grid;
}

/// C = -H, gamma = V + 90: the planes in reverse order.
IesGrid type_a_grid(const IntensityDistribution& d) {
    IesGrid grid;
    for (const Angle g : d.gammas())
        grid.vertical.push_back(rounded_degrees(g) - 90.0);
    for (std::size_t p = d.planes().size(); p-- > 0;) {
        grid.horizontal.push_back(0.0 - rounded_degrees(d.planes()[p]));
        for (std::size_t g = 0; g < d.gammas().size(); ++g)
            grid.candela.push_back(d.at(p, g).value());
    }
    return grid;
}

/// C = V, gamma = H + 90: the table transposed.
IesGrid type_b_grid(const IntensityDistribution& d) {
    IesGrid grid;
    for (const Angle p : d.planes())
        grid.vertical.push_back(rounded_degrees(p));
    for (std::size_t g = 0; g < d.gammas().size(); ++g) {
        grid.horizontal.push_back(rounded_degrees(d.gammas()[g]) - 90.0);
        for (std::size_t p = 0; p < d.planes().size(); ++p)
            grid.candela.push_back(d.at(p, g).value());
    }
    return grid;
}

char type_to_write(const IntensityDistribution& d) {
    if (d.pole() == TablePole::lateral)
        return 'B';
    return is_full_circle(d) ? 'C' : 'A';
}

IesGrid make_grid(const IntensityDistribution& d, char type) {
    if (type == 'B')
        return type_b_grid(d);
    return type == 'A' ? type_a_grid(d) : type_c_grid(d);
}

/// Width, length and height with the signs of LM-63-2002 and 2019.
std::string opening_code(const LuminousOpening& o) {
    const double x = o.extent_x.value();
    const double y = o.extent_y.value();
    const double z = o.extent_z.value();
    const auto code = [](double w, double l, double h) {
        return to_fixed(w, 6) + " " + to_fixed(l, 6) + " " + to_fixed(h, 6);
    };
    switch (o.shape) {
    case OpeningShape::point:
        break;
    case OpeningShape::rectangle:
        return code(y, x, 0);
    case OpeningShape::box:
        return code(y, x, z);
    case OpeningShape::ellipse:
        return code(-y, -x, 0);
    case OpeningShape::vertical_cylinder:
        return code(-y, -x, z);
    case OpeningShape::cylinder_along_x:
        return code(-y, x, -z);
    case OpeningShape::cylinder_along_y:
        return code(y, -x, -z);
    case OpeningShape::ellipsoid:
        return code(-y, -x, -z);
    case OpeningShape::vertical_ellipse:
        return code(-y, 0, -z);
    }
    return "0 0 0";
}

/// Numbers in rows no longer than LM-63-2002 allows.
void append_rows(std::string& text, std::span<const double> values, int decimals) {
    constexpr std::size_t longest = 120;
    std::size_t row = 0;
    for (const double v : values) {
        const std::string number = to_fixed(v, decimals);
        if (row > 0 && row + 1 + number.size() > longest) {
            text += line_end;
            row = 0;
        }
        text += (row > 0 ? " " : "") + number;
        row += number.size() + (row > 0 ? 1 : 0);
    }
    text += line_end;
}

void append_label(std::string& text, std::string_view keyword, std::string_view value) {
    text += "[" + std::string(keyword) + "] " + one_line(value) + std::string(line_end);
}

std::string head(const LuminairePhotometry& l, const IesWriteOptions& options) {
    const bool is_2019 = options.edition == PhotometricFormat::lm63_2019;
    std::string text = is_2019 ? "IES:LM-63-2019" : "IESNA:LM-63-2002";
    text += line_end;
    append_label(text, "TEST", options.test);
    append_label(text, "TESTLAB", options.laboratory);
    append_label(text, "ISSUEDATE", options.issue_date);
    append_label(text, "MANUFAC", l.manufacturer);
    append_label(text, "LUMCAT", l.catalogue_number);
    append_label(text, "LUMINAIRE", l.name);
    if (l.lamp_set < l.lamp_sets.size())
        append_label(text, "LAMP", l.lamp_sets[l.lamp_set].type);
    if (is_2019)
        append_label(text, "FILEGENINFO", "written by isolux");
    for (const PhotometryLabel& other : l.other_labels)
        append_label(text, other.keyword, other.text);
    return text + "TILT=NONE" + std::string(line_end);
}

/// "lamps lumens": relative photometry where the lamp flux is known, else absolute.
std::string lamp_fields(const LuminairePhotometry& l) {
    if (l.lamp_set >= l.lamp_sets.size())
        return "1 -1";
    const LampSet& set = l.lamp_sets[l.lamp_set];
    const int lamps = std::max(1, std::abs(set.lamps));
    if (l.is_absolute || !(set.flux.value() > 0.0))
        return std::to_string(lamps) + " -1";
    return std::to_string(lamps) + " " + to_text(set.flux.value() / lamps);
}

std::vector<Message> losses(const LuminairePhotometry& l, const IesWriteOptions& options) {
    const std::string where = to_string(options.edition);
    std::vector<Message> notices;
    if (l.lamp_sets.size() > 1)
        notices.push_back({where,
                           std::to_string(l.lamp_sets.size())
                               + " lamp sets, only the chosen one is written (LM-63 has no "
                                 "alternatives)",
                           {}});
    if (l.side_heights) {
        const auto [least, most] = std::ranges::minmax(*l.side_heights);
        if (least != most)
            notices.push_back({where,
                               "luminous heights differ from side to side, the largest is "
                               "written (LM-63 has one height)",
                               {}});
    }
    return notices;
}

} // namespace

Parsed<std::string> write_ies(const LuminairePhotometry& l, const IesWriteOptions& options) {
    ISOLUX_EXPECT(options.edition == PhotometricFormat::lm63_2002
                  || options.edition == PhotometricFormat::lm63_2019);
    const char type = type_to_write(l.distribution);
    const IesGrid grid = make_grid(l.distribution, type);
    const bool is_2019 = options.edition == PhotometricFormat::lm63_2019;
    std::string text = head(l, options);
    text += lamp_fields(l) + " 1 " + std::to_string(grid.vertical.size()) + " "
            + std::to_string(grid.horizontal.size()) + " "
            + (type == 'C'   ? "1"
               : type == 'B' ? "2"
                             : "3")
            + " 2 " + opening_code(l.opening) + std::string(line_end);
    text += "1 " + (is_2019 ? to_fixed(options.generation_type, 5) : "1") + " "
            + to_text(l.input_watts) + std::string(line_end);
    append_rows(text, grid.vertical, 6);
    append_rows(text, grid.horizontal, 6);
    const int decimals =
        decimals_for(l.distribution.max_intensity().value(), options.significant_digits);
    for (std::size_t p = 0; p < grid.horizontal.size(); ++p)
        append_rows(
            text,
            std::span(grid.candela).subspan(p * grid.vertical.size(), grid.vertical.size()),
            decimals);
    return {std::move(text), losses(l, options)};
}

} // namespace isolux
