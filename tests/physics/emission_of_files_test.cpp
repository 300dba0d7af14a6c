// Every luminaire file at hand as a source of light: the flux of its table in closed form, and
// the directions drawn from it cell by cell (METHODS 7.2 row 8).

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "isolux/transport/table_sampler.h"

#include "support/photometric_files.h"
#include "support/source_dir.h"
#include "support/statistics.h"

namespace isolux {
namespace {

namespace fs = std::filesystem;
constexpr double pi = std::numbers::pi;

/// lm of one cell of the bilinear interpolant: the mean over azimuth is linear in gamma,
/// a + b (gamma - g0), and the integral of that times sin(gamma) is elementary.
long double cell_flux(const IntensityDistribution& d, std::size_t plane, std::size_t gamma) {
    const long double g0 = d.gammas()[gamma].in_radians();
    const long double g1 = d.gammas()[gamma + 1].in_radians();
    const long double dc = d.planes()[plane + 1].in_radians()
                           - static_cast<long double>(d.planes()[plane].in_radians());
    const auto mean = [&](std::size_t g) {
        return 0.5L
               * (static_cast<long double>(d.at(plane, g).value())
                  + d.at(plane + 1, g).value());
    };
    const long double slope = (mean(gamma + 1) - mean(gamma)) / (g1 - g0);
    return dc
           * (mean(gamma) * std::cos(g0) - mean(gamma + 1) * std::cos(g1)
              + slope * (std::sin(g1) - std::sin(g0)));
}

/// The table's own angles of a direction in the luminaire's frame.
std::pair<double, double> angles_of(TablePole pole, const Vector3& w) {
    return pole == TablePole::nadir
               ? std::pair(std::atan2(w.y, w.x), std::acos(std::clamp(-w.z, -1.0, 1.0)))
               : std::pair(std::atan2(w.x, -w.z), std::acos(std::clamp(w.y, -1.0, 1.0)));
}

std::size_t interval(std::span<const Angle> nodes, double at) {
    std::size_t i = 0;
    while (i + 2 < nodes.size() && nodes[i + 1].in_radians() <= at)
        ++i;
    return i;
}

void expect_drawn_as_tabulated(const IntensityDistribution& d, const std::string& name) {
    constexpr int draws = 40000;
    const std::size_t rows = d.gammas().size() - 1;
    const std::size_t cells = (d.planes().size() - 1) * rows;
    std::vector<double> share(cells);
    long double flux = 0.0L;
    for (std::size_t c = 0; c < cells; ++c) {
        const long double lumens = cell_flux(d, c / rows, c % rows);
        share[c] = static_cast<double>(lumens);
        flux += lumens;
    }
    const double whole = static_cast<double>(flux);
    EXPECT_NEAR(d.flux().value(), whole, 1e-9 * whole) << name;
    if (!(whole > 0.0))
        return; // a dark luminaire: nothing is drawn from it
    const TableSampler sampler(d);
    EXPECT_NEAR(sampler.flux(), whole, 1e-9 * whole) << name;
    std::vector<double> count(cells, 0.0);
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (int i = 0; i < draws; ++i) {
        const double a = u(engine);
        const auto [azimuth, polar] = angles_of(d.pole(), sampler.sample(a, u(engine)));
        const double first = d.planes().front().in_radians();
        const double c = azimuth - 2 * pi * std::floor((azimuth - first) / (2 * pi));
        count[interval(d.planes(), c) * rows + interval(d.gammas(), polar)] += 1.0;
    }
    std::vector<double> seen{0.0};
    std::vector<double> expected{0.0};
    for (std::size_t c = 0; c < cells; ++c) { // neighbours share a bin until it holds enough
        if (expected.back() >= 10.0) {
            seen.push_back(0.0);
            expected.push_back(0.0);
        }
        seen.back() += count[c];
        expected.back() += draws * share[c] / whole;
    }
    if (expected.size() > 1 && expected.back() < 10.0) {
        expected[expected.size() - 2] += expected.back();
        seen[seen.size() - 2] += seen.back();
        expected.pop_back();
        seen.pop_back();
    }
    if (expected.size() > 1) {
        EXPECT_GT(test::chi_square_tail(seen, expected), test::chi_square_false_alarm) << name;
    }
}

int expect_of_folder(const fs::path& folder) {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        std::string extension = entry.path().extension().string();
        std::ranges::transform(
            extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
        if (extension != ".ies" && extension != ".ldt" && extension != ".xml"
            && extension != ".gldf")
            continue;
        ++files;
        const std::string name = entry.path().filename().string();
        const auto parsed = parse_photometry(
            corpus::read_bytes(entry.path()), name, corpus::options_beside(entry.path()));
        expect_drawn_as_tabulated(parsed.value.distribution, name);
    }
    return files;
}

TEST(EmissionOfFiles, OfThisProject) {
    EXPECT_GE(expect_of_folder(isolux::test::source_dir() / "luminaires"), 12);
}

TEST(EmissionOfFiles, OfTheCorpusBesideTheCheckout) {
    if (!corpus::is_present())
        GTEST_SKIP() << "no extra photometric files beside the checkout";
    EXPECT_GT(expect_of_folder(corpus::root() / "valid"), 20);
    EXPECT_GT(expect_of_folder(corpus::root() / "synthetic"), 10);
}

} // namespace
} // namespace isolux
