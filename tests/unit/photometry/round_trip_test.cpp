#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isolux/photometry/plane_symmetry.h"
#include "isolux/photometry/read_photometry.h"
#include "isolux/photometry/write_ies.h"
#include "isolux/photometry/write_ldt.h"

/// Random luminaires, written and read again.
namespace isolux {
namespace {

/// RapidCheck draws a new seed every day; ours is fixed, and RC_PARAMS still overrides it.
[[maybe_unused]] const int seed_is_fixed = setenv("RC_PARAMS", "seed=20261122", 0);

/// Ascending tenths of a degree from `first` to `last`, both included.
std::vector<double> random_angles(double first, double last, int most_between) {
    const int tenths = static_cast<int>(std::lround(10 * (last - first)));
    const int count = *rc::gen::inRange(0, most_between + 1);
    std::vector<int> inner = *rc::gen::container<std::vector<int>>(
        static_cast<std::size_t>(count), rc::gen::inRange(1, tenths));
    std::ranges::sort(inner);
    inner.erase(std::ranges::unique(inner).begin(), inner.end());
    std::vector<double> angles{first};
    for (const int i : inner)
        angles.push_back(first + 0.1 * i);
    angles.push_back(last);
    return angles;
}

std::vector<Angle> in_angles(const std::vector<double>& in_degrees) {
    std::vector<Angle> angles;
    for (const double a : in_degrees)
        angles.push_back(degrees(a));
    return angles;
}

/// Whole and half candelas; the first is never dark, so that there is light.
std::vector<double> random_candelas(std::size_t count) {
    const auto halves =
        *rc::gen::container<std::vector<int>>(count, rc::gen::inRange(0, 20000));
    std::vector<double> candela;
    for (const int h : halves)
        candela.push_back(0.5 * h);
    candela.front() += 1.0;
    return candela;
}

std::vector<double> random_gammas() {
    const double first = *rc::gen::element(0.0, 90.0);
    return random_angles(first, first == 0.0 ? *rc::gen::element(90.0, 180.0) : 180.0, 8);
}

IntensityDistribution random_type_c() {
    using enum PlaneSymmetry;
    const PlaneSymmetry symmetry =
        *rc::gen::element(none, rotational, quadrant, bilateral_0_180, bilateral_90_270);
    std::vector<double> stored{0.0};
    if (symmetry == quadrant)
        stored = random_angles(0, 90, 4);
    else if (symmetry == bilateral_0_180)
        stored = random_angles(0, 180, 6);
    else if (symmetry == bilateral_90_270)
        stored = random_angles(90, 270, 6);
    else if (symmetry == none) {
        stored = random_angles(0, 360, 8);
        stored.pop_back();
    }
    const auto planes = expand_planes(stored, symmetry);
    const auto gammas = random_gammas();
    const auto values = random_candelas(stored.size() * gammas.size());
    std::vector<double> candela;
    for (const ExpandedPlane& p : planes)
        for (std::size_t g = 0; g < gammas.size(); ++g)
            candela.push_back(values[p.stored * gammas.size() + g]);
    return {to_angles(planes), in_angles(gammas), std::move(candela)};
}

/// Types A and B: half a circle of planes, poles all the way.
IntensityDistribution random_type_ab(TablePole pole) {
    const auto planes = random_angles(-90, 90, 6);
    const auto gammas = random_angles(0, 180, 6);
    return {in_angles(planes),
            in_angles(gammas),
            random_candelas(planes.size() * gammas.size()),
            pole};
}

Metre random_size() { return Metre(0.001 * *rc::gen::inRange(1, 3000)); }

LuminousOpening random_opening(bool for_eulumdat) {
    using enum OpeningShape;
    const OpeningShape shape =
        for_eulumdat ? *rc::gen::element(point, rectangle, box, ellipse, vertical_cylinder)
                     : *rc::gen::element(point,
                                         rectangle,
                                         box,
                                         ellipse,
                                         vertical_cylinder,
                                         cylinder_along_x,
                                         cylinder_along_y,
                                         ellipsoid,
                                         vertical_ellipse);
    LuminousOpening o{shape, random_size(), random_size(), random_size()};
    if (shape == point)
        return {};
    if (shape == rectangle || shape == ellipse)
        o.extent_z = Metre();
    if (shape == vertical_ellipse)
        o.extent_x = Metre();
    if (for_eulumdat && (shape == ellipse || shape == vertical_cylinder))
        o.extent_y = o.extent_x;
    return o;
}

std::string random_text() {
    return *rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab c1[]=,;x")));
}

LuminairePhotometry random_luminaire(IntensityDistribution distribution, bool for_eulumdat) {
    const bool is_absolute = *rc::gen::arbitrary<bool>();
    const int lamps = *rc::gen::inRange(1, 5);
    const double watts = 0.1 * *rc::gen::inRange(0, 5000);
    const auto opening = random_opening(for_eulumdat);
    const char type = distribution.pole() == TablePole::lateral ? 'B' : 'C';
    return {
        .format = PhotometricFormat::eulumdat,
        .photometric_type = type,
        .symmetry = {},
        .planes_in_file = 0,
        .gammas_in_file = 0,
        .manufacturer = random_text(),
        .name = random_text(),
        .catalogue_number = random_text(),
        .distribution = std::move(distribution),
        .opening = opening,
        .housing = opening,
        .is_absolute = is_absolute,
        .declared_flux = std::nullopt,
        .lamp_sets = {{is_absolute ? -lamps : lamps,
                       random_text(),
                       Lumen(is_absolute && !for_eulumdat ? 0.0
                                                          : 1.0 * *rc::gen::inRange(1, 99999)),
                       "",
                       "",
                       watts}},
        .input_watts = watts};
}

void expect_same_table(const IntensityDistribution& a,
                       const IntensityDistribution& b,
                       double allowed) {
    for (double x = -0.97; x < 1; x += 0.31)
        for (double y = -0.95; y < 1; y += 0.37)
            for (double z = -0.99; z < 1; z += 0.33) {
                const UnitVector3 d(Vector3{x, y, z});
                RC_ASSERT(std::abs(a.evaluate(d).value() - b.evaluate(d).value()) <= allowed);
            }
    for (std::size_t p = 0; p < a.planes().size(); ++p)
        for (std::size_t g = 0; g < a.gammas().size(); ++g) {
            const double there = b.evaluate(a.planes()[p], a.gammas()[g]).value();
            RC_ASSERT(std::abs(there - a.at(p, g).value()) <= allowed);
        }
}

void expect_same_facts(const LuminairePhotometry& a, const LuminairePhotometry& b) {
    const auto trimmed = [](std::string text) {
        text.erase(0, text.find_first_not_of(' '));
        text.erase(text.find_last_not_of(' ') + 1);
        return text;
    };
    RC_ASSERT(trimmed(a.name) == b.name);
    RC_ASSERT(trimmed(a.manufacturer) == b.manufacturer);
    RC_ASSERT(trimmed(a.catalogue_number) == b.catalogue_number);
    RC_ASSERT(a.opening.shape == b.opening.shape);
    for (const auto member :
         {&LuminousOpening::extent_x, &LuminousOpening::extent_y, &LuminousOpening::extent_z})
        RC_ASSERT(std::abs((a.opening.*member - b.opening.*member).value()) < 5e-7);
    RC_ASSERT(a.is_absolute == b.is_absolute);
    RC_ASSERT(a.lamp_sets[0].lamps == b.lamp_sets[0].lamps);
    RC_ASSERT(std::abs((a.lamp_sets[0].flux - b.lamp_sets[0].flux).value()) < 1e-6);
    RC_ASSERT(a.input_watts == b.input_watts);
}

/// The way through radians moves a node by 1e-15, and within a tenth of a degree a table may
/// fall by its whole range.
constexpr double node_rounding = 1e-7;

/// Half a unit of the last of seven digits. Half candelas themselves print exactly, but planes
/// that a symmetry needs and the table lacks are interpolated before they are printed.
double half_a_digit(const LuminairePhotometry& l) {
    return 5e-7 * l.distribution.max_intensity().value();
}

RC_GTEST_PROP(RoundTrip, GivesBackAnyTypeCLuminaireThroughLm63, ()) {
    const auto l = random_luminaire(random_type_c(), false);
    IesWriteOptions options;
    options.edition =
        *rc::gen::element(PhotometricFormat::lm63_2002, PhotometricFormat::lm63_2019);
    const auto back = parse_photometry(write_ies(l, options).value, "back.ies").value;
    RC_ASSERT(back.format == options.edition);
    expect_same_table(l.distribution, back.distribution, half_a_digit(l) + node_rounding);
    expect_same_facts(l, back);
}

RC_GTEST_PROP(RoundTrip, GivesBackAnyTypeAOrBLuminaireThroughLm63, ()) {
    const TablePole pole = *rc::gen::element(TablePole::nadir, TablePole::lateral);
    const auto l = random_luminaire(random_type_ab(pole), false);
    const auto back = parse_photometry(write_ies(l).value, "back.ies").value;
    RC_ASSERT(back.photometric_type == (pole == TablePole::lateral ? 'B' : 'A'));
    expect_same_table(l.distribution, back.distribution, node_rounding);
    expect_same_facts(l, back);
}

RC_GTEST_PROP(RoundTrip, GivesBackAnyTypeCLuminaireThroughEulumdat, ()) {
    const auto l = random_luminaire(random_type_c(), true);
    const auto back = parse_photometry(write_ldt(l).value, "back.ldt").value;
    expect_same_table(l.distribution, back.distribution, half_a_digit(l) + node_rounding);
    expect_same_facts(l, back);
}

} // namespace
} // namespace isolux
