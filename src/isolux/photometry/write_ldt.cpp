#include "isolux/photometry/write_ldt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "isolux/photometry/file_number.h"
#include "isolux/photometry/quantities.h"
#include "isolux/photometry/stored_table.h"

namespace isolux {

namespace {

class LineWriter {
public:
    void text(std::string_view value) { out_ += one_line(value) + "\r\n"; }

    void number(double value) { out_ += to_text(value) + "\r\n"; }

    void number(double value, int decimals) { out_ += to_fixed(value, decimals) + "\r\n"; }

    void millimetres(Metre value) { number(1000.0 * value.value(), 3); }

    [[nodiscard]] std::string take() { return std::move(out_); }

private:
    std::string out_;
};

/// Length (along y), width (along x; 0 = round) and height.
struct LdtBody {
    Metre length;
    Metre width;
    Metre height;
    bool is_exact = true;
};

LdtBody to_ldt(const LuminousOpening& o) {
    const bool is_round = std::abs(o.extent_x.value() - o.extent_y.value()) < 1e-9;
    switch (o.shape) {
    case OpeningShape::point:
        return {};
    case OpeningShape::rectangle:
    case OpeningShape::box:
        return {o.extent_y,
                o.extent_x,
                o.extent_z,
                o.extent_x.value() > 0.0 && o.extent_y.value() > 0.0};
    case OpeningShape::ellipse:
    case OpeningShape::vertical_cylinder:
        if (is_round)
            return {o.extent_x, Metre(), o.extent_z};
        break;
    default:
        break;
    }
    return {o.extent_y, o.extent_x, o.extent_z, false};
}

int symmetry_indicator(PlaneSymmetry symmetry) {
    switch (symmetry) {
    case PlaneSymmetry::rotational:
        return 1;
    case PlaneSymmetry::bilateral_0_180:
        return 2;
    case PlaneSymmetry::bilateral_90_270:
        return 3;
    case PlaneSymmetry::quadrant:
        return 4;
    case PlaneSymmetry::none:
        break;
    }
    return 0;
}

int type_indicator(const LuminairePhotometry& l, PlaneSymmetry symmetry) {
    if (symmetry == PlaneSymmetry::rotational)
        return 1;
    const auto [shorter, longer] = std::minmax(l.opening.extent_x, l.opening.extent_y);
    return longer.value() > 2.0 * shorter.value() ? 2 : 3;
}

/// The common step of a list, or 0.
double even_step(const std::vector<double>& angles) {
    if (angles.size() < 2)
        return 0.0;
    const double step = angles[1] - angles[0];
    for (std::size_t i = 2; i < angles.size(); ++i)
        if (!is_same_angle(angles[i] - angles[i - 1], step))
            return 0.0;
    return step;
}

/// What line 26 and its sets say; the chosen set comes first.
std::vector<LampSet> sets_to_write(const LuminairePhotometry& l, double table_flux) {
    std::vector<LampSet> sets = l.lamp_sets;
    if (l.lamp_set < sets.size())
        std::rotate(sets.begin(),
                    sets.begin() + static_cast<std::ptrdiff_t>(l.lamp_set),
                    sets.begin() + static_cast<std::ptrdiff_t>(l.lamp_set) + 1);
    if (sets.empty())
        sets.push_back({-1, {}, {}, {}, {}, l.input_watts});
    LampSet& first = sets.front();
    if (l.is_absolute || !(first.flux.value() > 0.0)) {
        first.lamps = -std::max(1, std::abs(first.lamps));
        if (!(first.flux.value() > 0.0))
            first.flux = Lumen(table_flux > 0.0 ? table_flux : 1000.0);
    }
    return sets;
}

void write_lamps(LineWriter& lines, const std::vector<LampSet>& sets) {
    lines.number(static_cast<double>(sets.size()));
    for (const LampSet& s : sets) {
        lines.number(s.lamps);
        lines.text(s.type);
        lines.number(s.flux.value());
        lines.text(s.colour);
        lines.text(s.colour_rendering);
        lines.number(s.watts);
    }
}

/// EULUMDAT's order of stored planes: Isym 3 begins at C270.
std::vector<std::size_t> storing_order(const StoredTable& table) {
    std::vector<std::size_t> order;
    if (table.symmetry != PlaneSymmetry::bilateral_90_270) {
        for (std::size_t i = 0; i < table.planes.size(); ++i)
            order.push_back(i);
        return order;
    }
    // stored 90..270 ascending; C and 180 - C are the same, so 270, 275 .. 360 .. 90 are the
    // same planes backwards
    for (std::size_t i = table.planes.size(); i-- > 0;)
        order.push_back(i);
    return order;
}

void write_table(LineWriter& lines,
                 const StoredTable& table,
                 double lamp_flux,
                 double largest,
                 int significant) {
    const std::size_t ng = table.gammas.size();
    const double scale = 1000.0 / lamp_flux;
    const int decimals = decimals_for(largest * scale, significant);
    for (const std::size_t p : storing_order(table))
        for (std::size_t g = 0; g < ng; ++g)
            lines.number(scale * table.candela[p * ng + g], decimals);
}

std::vector<Message> losses(const LuminairePhotometry& l, bool is_resampled) {
    const std::string where = to_string(PhotometricFormat::eulumdat);
    std::vector<Message> notices;
    if (is_resampled)
        notices.push_back({where,
                           "type " + std::string(1, l.photometric_type)
                               + " table resampled to C planes every 2.5 and gamma every 1 "
                                 "degree (EULUMDAT has no other planes)",
                           {}});
    if (!to_ldt(l.opening).is_exact)
        notices.push_back({where,
                           to_string(l.opening.shape)
                               + " written as a box of its sizes (EULUMDAT has rectangles and "
                                 "round openings only)",
                           {}});
    if (!l.other_labels.empty()) {
        std::string keywords;
        for (const PhotometryLabel& other : l.other_labels)
            keywords += (keywords.empty() ? "[" : ", [") + other.keyword + "]";
        notices.push_back({where, "left out: " + keywords + " (EULUMDAT has no keywords)", {}});
    }
    return notices;
}

} // namespace

Parsed<std::string> write_ldt(const LuminairePhotometry& l, const LdtWriteOptions& options) {
    const bool is_type_c =
        l.distribution.pole() == TablePole::nadir && is_full_circle(l.distribution);
    const IntensityDistribution distribution =
        is_type_c ? l.distribution : resample(l.distribution, 2.5, 1.0);
    const StoredTable table = make_stored_table(distribution);
    const double flux = distribution.flux_trapezoid().value();
    const std::vector<LampSet> sets = sets_to_write(l, flux);
    const LdtBody housing = to_ldt(l.housing);
    const LdtBody opening = to_ldt(l.opening);

    LineWriter lines;
    lines.text(l.manufacturer);
    lines.number(type_indicator(l, table.symmetry));
    lines.number(symmetry_indicator(table.symmetry));
    lines.number(static_cast<double>(table.circle.size()));
    lines.number(even_step(table.circle));
    lines.number(static_cast<double>(table.gammas.size()));
    lines.number(even_step(table.gammas));
    for (const std::string& text :
         {options.report, l.name, l.catalogue_number, options.file_name, options.date_and_user})
        lines.text(text);
    for (const Metre size :
         {housing.length, housing.width, housing.height, opening.length, opening.width})
        lines.millimetres(size);
    for (std::size_t side = 0; side < 4; ++side)
        lines.millimetres(l.side_heights ? (*l.side_heights)[side] : opening.height);
    lines.number(100.0 * downward_fraction(distribution), 2);
    lines.number(100.0 * flux / sets.front().flux.value(), 2);
    lines.number(1.0);
    lines.number(0.0);
    write_lamps(lines, sets);
    constexpr int room_indices = 10;
    for (int k = 0; k < room_indices; ++k)
        lines.number(0.0);
    for (const double c : table.circle)
        lines.number(c);
    for (const double g : table.gammas)
        lines.number(g);
    write_table(lines,
                table,
                sets.front().flux.value(),
                distribution.max_intensity().value(),
                options.significant_digits);
    return {lines.take(), losses(l, !is_type_c)};
}

} // namespace isolux
