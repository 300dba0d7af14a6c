// Where a luminaire's light goes in a room: an asymmetric and a linear luminaire, each as
// LM-63 and as EULUMDAT, turned and tipped, against a formula that shares nothing with the
// program but the two formats' frames: LM-63 lays the length along C0, EULUMDAT along C90.

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "isolux/calc/calculate.h"
#include "isolux/io/project_json.h"

#include "support/temporary_folder.h"

namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double turn = pi / 180.0;
constexpr int plane_step = 15; // degrees
constexpr int gamma_step = 5;

/// Candela by azimuth from the body's long side, counter-clockwise from above, and gamma.
using Light = std::function<double(double azimuth, double gamma)>;

double asymmetric(double azimuth, double gamma) {
    if (gamma >= 90.0)
        return 0.0;
    const double g = gamma * turn;
    return 800.0 * std::cos(g) * (1.0 + 0.6 * std::sin(azimuth * turn) * std::sin(g))
           + 350.0 * std::sin(2.0 * g) * (1.0 + std::cos((azimuth - 40.0) * turn));
}

double linear(double azimuth, double gamma) {
    const double g = gamma * turn;
    const double across = std::sin(azimuth * turn);
    const double along = std::cos(azimuth * turn);
    return 600.0 * (0.15 + std::max(0.0, std::cos(g)))
           * (0.25 + std::abs(across) * std::sin(g) + 0.1 * along * along);
}

struct Body {
    double length;
    double width;
};

/// Rows of whole planes as both formats write them, `first` degrees from the long side.
std::string table(const Light& light, double first, int last_plane) {
    std::string text;
    for (int c = 0; c <= last_plane; c += plane_step)
        for (int g = 0; g <= 180; g += gamma_step)
            text += std::to_string(light(c + first, g)) + "\n";
    return text;
}

std::string angles(int last, int step) {
    std::string text;
    for (int a = 0; a <= last; a += step)
        text += std::to_string(a) + "\n";
    return text;
}

std::string as_ies(const Light& light, const Body& body) {
    return "IES:LM-63-2019\n[TEST] orientation\n[TESTLAB] none\n[ISSUEDATE] none\n"
           "[MANUFAC] none\n[GENERATION] none\nTILT=NONE\n"
           "1 -1 1 "
           + std::to_string(180 / gamma_step + 1) + " " + std::to_string(360 / plane_step + 1)
           + " 1 2 " + std::to_string(body.width) + " " + std::to_string(body.length)
           + " 0\n1 1 10\n" + angles(180, gamma_step) + angles(360, plane_step)
           + table(light, 0.0, 360);
}

/// One lamp of 1000 lm, so that candelas per kilolumen are candelas.
std::string as_ldt(const Light& light, const Body& body) {
    const auto millimetres = [](double metres) {
        return std::to_string(std::lround(1000.0 * metres)) + "\n";
    };
    const std::string sides = millimetres(body.length) + millimetres(body.width);
    return "none\n3\n0\n" + std::to_string(360 / plane_step) + "\n" + std::to_string(plane_step)
           + "\n" + std::to_string(180 / gamma_step + 1) + "\n" + std::to_string(gamma_step)
           + "\nnone\norientation\nnone\nnone.ldt\nnone\n" + sides + "50\n" + sides
           + "0\n0\n0\n0\n100\n100\n1\n0\n1\n1\nlamp\n1000\nwarm\n80\n10\n"
           + "0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n" + angles(345, plane_step)
           + angles(180, gamma_step) + table(light, -90.0, 345);
}

/// Bilinear in the two angles, which is all a table says.
double interpolated(const Light& light, double azimuth, double gamma) {
    const double c = azimuth - 360.0 * std::floor(azimuth / 360.0);
    const double c0 = plane_step * std::floor(c / plane_step);
    const double g0 = std::min(180.0 - gamma_step, gamma_step * std::floor(gamma / gamma_step));
    const double s = (c - c0) / plane_step;
    const double t = (gamma - g0) / gamma_step;
    return (1 - t) * ((1 - s) * light(c0, g0) + s * light(c0 + plane_step, g0))
           + t
                 * ((1 - s) * light(c0, g0 + gamma_step)
                    + s * light(c0 + plane_step, g0 + gamma_step));
}

/// How the luminaire is turned: about its own axis, then its nadir axis tipped towards +x.
struct Pose {
    double spin; // degrees
    double tilt;
};

/// The luminaire's axes in the room, column by column.
struct Frame {
    Vector3 x;
    Vector3 y;
    Vector3 z;
};

Frame frame_of(const Pose& pose) {
    const double s = std::sin(pose.tilt * turn);
    const double c = std::cos(pose.tilt * turn);
    const auto tip = [&](const Vector3& v) { // (0, 0, -1) goes to (s, 0, -c)
        return Vector3{c * v.x - s * v.z, v.y, s * v.x + c * v.z};
    };
    const double u = std::cos(pose.spin * turn);
    const double v = std::sin(pose.spin * turn);
    return {tip({u, v, 0}), tip({-v, u, 0}), tip({0, 0, 1})};
}

constexpr Vector3 hung_at{0.3, -0.2, 3.0};

struct Sensor {
    Vector3 at;
    Vector3 normal;
};

/// Around the luminaire at several heights, none of them in a plane of symmetry.
std::array<Sensor, 8> sensors() {
    return {{{{1.5, 0.4, 0.0}, {0, 0, 1}},
             {{-1.1, 0.9, 0.5}, {0, 0, 1}},
             {{0.5, -1.7, 0.8}, {0, 0, 1}},
             {{-0.8, -1.2, 0.0}, {0.6, 0, 0.8}},
             {{2.4, 1.3, 1.9}, {-1, 0, 0}},
             {{2.1, -0.9, 4.2}, {-0.8, 0.6, 0}},
             {{-1.9, 1.6, 2.2}, {1, 0, 0}},
             {{0.7, 2.2, 3.6}, {0, -1, 0}}}};
}

/// Inverse-square law over the opening, midpoint rule: lx.
double expected_illuminance(const Light& light,
                            double long_side, // azimuth of the body's length from C0, degrees
                            const Body& body,
                            const Pose& pose,
                            const Sensor& sensor) {
    constexpr int along = 480;
    constexpr int across = 96;
    const Frame frame = frame_of(pose);
    const double lu = std::cos(long_side * turn);
    const double lv = std::sin(long_side * turn);
    const Vector3 length = body.length * (lu * frame.x + lv * frame.y);
    const Vector3 width = body.width * (-lv * frame.x + lu * frame.y);
    double sum = 0.0;
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < across; ++j) {
            const Vector3 from = hung_at + ((i + 0.5) / along - 0.5) * length
                                 + ((j + 0.5) / across - 0.5) * width;
            const Vector3 d = sensor.at - from;
            const double squared = dot(d, d);
            const double distance = std::sqrt(squared);
            const double gamma = std::acos(-dot(d, frame.z) / distance) / turn;
            const double azimuth = std::atan2(dot(d, frame.y), dot(d, frame.x)) / turn;
            const double cosine = -dot(d, sensor.normal) / distance;
            if (cosine > 0.0)
                sum += interpolated(light, azimuth - long_side, gamma) * cosine / squared;
        }
    return sum / (along * across);
}

struct Case {
    const char* name;
    Light light;
    Body body;
};

class Orientation : public testing::TestWithParam<bool> {};

TEST_P(Orientation, OfBothFormatsIsAsTheirFramesSay) {
    const bool is_ies = GetParam();
    // LM-63 counts azimuths from the long side; EULUMDAT's C90 points along it.
    const double long_side = is_ies ? 0.0 : 90.0;
    const std::array<Case, 2> cases{
        {{"asymmetric", asymmetric, {0.35, 0.3}}, {"linear", linear, {1.45, 0.08}}}};
    const test::TemporaryFolder folder;
    CalculationSurface surface;
    for (const Sensor& s : sensors())
        surface.receivers.push_back({Point3{} + s.at, UnitVector3(s.normal)});
    Settings settings;
    settings.direct_only = true;
    settings.fixed_units = 64;
    double least = 1e9;
    double most = 0.0;
    for (const Case& c : cases) {
        const auto file = folder.path() / (std::string(c.name) + (is_ies ? ".ies" : ".ldt"));
        std::ofstream(file) << (is_ies ? as_ies(c.light, c.body) : as_ldt(c.light, c.body));
        for (const double spin : {0.0, 90.0, 180.0, 270.0})
            for (const double tilt : {0.0, 30.0, 90.0}) {
                Project project = parse_project(
                    R"({"isolux": 1, "luminaire_types": {"l": {"file": ")"
                        + file.generic_string()
                        + R"("}}, "luminaires": [{"type": "l", "position": [0.3, -0.2, 3],
                            "rotation": )"
                        + std::to_string(spin) + R"(, "tilt": )" + std::to_string(tilt) + "}]}",
                    "p.json");
                const Scene scene = build_scene(std::move(project.scene));
                const std::vector<CalculationSurface> surfaces{surface};
                const Results r = calculate(scene, surfaces, settings);
                for (std::size_t p = 0; p < surface.receivers.size(); ++p) {
                    const double exact = expected_illuminance(
                        c.light, long_side, c.body, {spin, tilt}, sensors()[p]);
                    least = std::min(least, exact);
                    most = std::max(most, exact);
                    const Estimate e = r.surfaces.front().points[p].total;
                    // 16 replicates: t beyond 12 with 15 degrees of freedom has a false alarm
                    // of 4e-9; the midpoint rule is right to 1e-4 of the largest value.
                    EXPECT_NEAR(e.mean, exact, 12.0 * e.standard_error + 0.01)
                        << c.name << ", spin " << spin << ", tilt " << tilt << ", point " << p;
                    EXPECT_LT(e.standard_error, 1e-3 * exact + 0.01) << c.name << p;
                }
            }
    }
    EXPECT_LT(least, 1.0); // some points lie behind, some in the beam
    EXPECT_GT(most, 100.0);
}

INSTANTIATE_TEST_SUITE_P(Formats, Orientation, testing::Values(true, false), [](const auto& i) {
    return std::string(i.param ? "Lm63" : "Eulumdat");
});

} // namespace
} // namespace isolux
