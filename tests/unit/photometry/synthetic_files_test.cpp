#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include <gmock/gmock.h>

#include "isolux/photometry/ies.h"
#include "isolux/photometry/quantities.h"

#include "support/photometric_files.h"

/// Hand-made files whose light is known in closed form.
namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;
/// The files print four decimals.
constexpr double printed = 5e-5;

UnitVector3 towards(double c, double gamma) {
    const double p = degrees(c).in_radians();
    const double g = degrees(gamma).in_radians();
    return UnitVector3({std::sin(g) * std::cos(p), std::sin(g) * std::sin(p), -std::cos(g)});
}

double candela(const LuminairePhotometry& l, double c, double gamma) {
    return l.distribution.evaluate(towards(c, gamma)).value();
}

LuminairePhotometry read(const std::string& name) {
    return corpus::read("synthetic", name).value;
}

struct Expected {
    std::string file;
    double flux;
    double relative; ///< tolerance: the description's own, or the table's printed digits
    double down;
};

void PrintTo(const Expected& e, std::ostream* out) { *out << e.file; }

class SyntheticFile : public testing::TestWithParam<Expected> {};

TEST_P(SyntheticFile, HasTheFluxOfItsFormula) {
    ISOLUX_NEEDS_CORPUS();
    const Expected& e = GetParam();
    const LuminairePhotometry l = read(e.file);
    EXPECT_NEAR(l.distribution.flux_trapezoid().value(), e.flux, e.relative * e.flux);
    EXPECT_NEAR(downward_fraction(l.distribution), e.down, 1e-12);
}

constexpr double digits = 1e-6; ///< four decimals of hundreds of candelas
INSTANTIATE_TEST_SUITE_P(
    All,
    SyntheticFile,
    testing::Values(Expected{"u2019.ies", 400 * pi, digits, 0.5},
                    Expected{"typeA.ies", 200 * pi, digits, 0.5},
                    Expected{"typeB.ies", 200 * pi, digits, 1.0},
                    Expected{"typeB-lambert.ies", 1000 * pi, 1e-3, 1.0},
                    Expected{"typeB-signs.ies", 1000 * pi, digits, 1.0},
                    Expected{"f1986-factors.ies", 342 * pi, digits, 1.0},
                    Expected{"f2002-future-use.ies", 380 * pi, digits, 1.0},
                    Expected{"uplight-90-180.ies", 190 * pi, digits, 0.0},
                    Expected{"bilateral-0-180.ies", 390 * pi, 1e-5, 1.0},
                    Expected{"bilateral-90-270.ies", 390 * pi, 1e-5, 1.0},
                    Expected{"wrap-345.ies", 500 * pi, 1e-5, 1.0},
                    Expected{"tilt-include.ies", 200 * pi, digits, 1.0},
                    Expected{"tilt-file.ies", 200 * pi, digits, 1.0},
                    Expected{"tiny-lines.ies", 200 * pi, digits, 1.0},
                    Expected{"tilt-none-blanks.ies", 200 * pi, digits, 1.0},
                    Expected{"ldt-quad-isym4.ldt", 250 * pi, 2e-3, 1.0},
                    Expected{"ldt-quad-isym2.ldt", 250 * pi, 2e-3, 1.0},
                    Expected{"ldt-quad-isym3.ldt", 250 * pi, 2e-3, 1.0},
                    Expected{"ldt-quad-isym0.ldt", 250 * pi, 2e-3, 1.0},
                    Expected{"ldt-c0-isym2.ldt", 200 * pi, 2e-3, 1.0},
                    Expected{"ldt-c0-isym0.ldt", 200 * pi, 2e-3, 1.0},
                    Expected{"ldt-c90-isym3.ldt", 200 * pi, 2e-3, 1.0},
                    Expected{"ldt-c90-isym0.ldt", 200 * pi, 2e-3, 1.0},
                    Expected{"ldt-comma.ldt", 250 * pi, 2e-3, 1.0},
                    Expected{"ldt-factor.ldt", 300 * pi, 2e-3, 1.0},
                    Expected{"ldt-absolute.ldt", 3000, 2e-3, 1.0},
                    Expected{"ldt-two-sets.ldt", 3000, 2e-3, 1.0},
                    Expected{"ldt-uneven-isym4.ldt", 250 * pi, 1e-2, 1.0}));

TEST(SyntheticFiles, AreUniformSphereAndHalfSpaces) {
    ISOLUX_NEEDS_CORPUS();
    const auto sphere = read("u2019.ies");
    const auto front = read("typeA.ies");
    const auto below = read("typeB.ies");
    for (double c = 3; c < 360; c += 17)
        for (double g = 3; g < 180; g += 11) {
            EXPECT_NEAR(candela(sphere, c, g), 100, 1e-9);
            EXPECT_NEAR(candela(front, c, g), towards(c, g).x() > 0 ? 100 : 0, 1e-9);
            EXPECT_NEAR(candela(below, c, g), g < 90 ? 100 : 0, 1e-9);
        }
    EXPECT_EQ(sphere.opening.shape, OpeningShape::ellipsoid);
    EXPECT_DOUBLE_EQ(sphere.opening.extent_z.value(), 0.3);
}

TEST(SyntheticFiles, KeepTypeBLambertianInEveryPlane) {
    ISOLUX_NEEDS_CORPUS();
    const auto l = read("typeB-lambert.ies");
    for (double c = 0; c < 360; c += 15) {
        EXPECT_NEAR(candela(l, c, 30), 866.03, 0.866);
        EXPECT_NEAR(candela(l, c, 60), 500, 0.5);
    }
}

TEST(SyntheticFiles, KeepTheSignsOfTypeB) {
    ISOLUX_NEEDS_CORPUS();
    const auto l = read("typeB-signs.ies"); // 500 + 3 H + 2 V
    EXPECT_NEAR(candela(l, 0, 30), 500 + 2 * 30, 1e-9);
    EXPECT_NEAR(candela(l, 180, 30), 500 - 2 * 30, 1e-9);
    EXPECT_NEAR(candela(l, 270, 30), 500 + 3 * 30, 1e-9);
    EXPECT_NEAR(candela(l, 90, 30), 500 - 3 * 30, 1e-9);
    const auto mirrored = read("typeB-mirror.ies"); // 400 - 3 |H|
    EXPECT_NEAR(candela(mirrored, 90, 40), 400 - 3 * 40, 1e-9);
    EXPECT_NEAR(candela(mirrored, 270, 40), 400 - 3 * 40, 1e-9);
    EXPECT_NEAR(candela(mirrored, 0, 40), 400, 1e-9);
}

TEST(SyntheticFiles, MultiplyTheBallastLampFactorIn1986Only) {
    ISOLUX_NEEDS_CORPUS();
    const auto old = read("f1986-factors.ies");
    EXPECT_NEAR(candela(old, 40, 50), 171, 1e-9);
    EXPECT_DOUBLE_EQ(old.opening.extent_y.value(), 0.6096); // width along y
    EXPECT_DOUBLE_EQ(old.opening.extent_x.value(), 1.2192);
    EXPECT_DOUBLE_EQ(old.lamp_sets.at(0).flux.value(), 4000);
    const auto parsed = corpus::read("synthetic", "f2002-future-use.ies");
    EXPECT_NEAR(candela(parsed.value, 40, 50), 190, 1e-9);
    EXPECT_THAT(
        parsed.notices,
        testing::ElementsAre(testing::Field(&Message::where, "f2002-future-use.ies:8")));
}

TEST(SyntheticFiles, KeepUplightsUp) {
    ISOLUX_NEEDS_CORPUS();
    const auto l = read("uplight-90-180.ies");
    EXPECT_EQ(candela(l, 90, 60), 0);
    EXPECT_NEAR(candela(l, 90, 120), 140, 1e-9);
    EXPECT_NEAR(candela(l, 0, 120), 50, 1e-9);
    EXPECT_NEAR(candela(l, 45, 120), 95, 1e-9);
}

TEST(SyntheticFiles, MirrorBilateralTablesInPlace) {
    ISOLUX_NEEDS_CORPUS();
    const auto a = read("bilateral-0-180.ies");
    const auto b = read("bilateral-90-270.ies");
    const double cos30 = std::cos(pi / 6);
    EXPECT_NEAR(candela(a, 270, 30), candela(a, 90, 30), 1e-9);
    EXPECT_NEAR(candela(a, 90, 30), 390 * cos30, printed);
    EXPECT_NEAR(a.distribution.flux().value(), 1224.44, 0.005);
    EXPECT_NEAR(candela(b, 0, 30), candela(b, 180, 30), 1e-9);
    EXPECT_NEAR(candela(b, 0, 30), 390 * cos30, printed);
    EXPECT_NEAR(candela(b, 45, 30), candela(b, 135, 30), 1e-9);
    EXPECT_NEAR(candela(b, 270, 30), 480 * cos30, printed);
}

TEST(SyntheticFiles, CloseTheCircleByWrapping) {
    ISOLUX_NEEDS_CORPUS();
    const auto parsed = corpus::read("synthetic", "wrap-345.ies");
    const auto& l = parsed.value;
    EXPECT_NEAR(candela(l, 352.5, 40), 0.5 * (candela(l, 345, 40) + candela(l, 0, 40)), 1e-9);
    EXPECT_FALSE(parsed.notices.empty());
}

TEST(SyntheticFiles, ApplyTiltFactors) {
    ISOLUX_NEEDS_CORPUS();
    const auto read_tilted = [](const std::string& name, double tilt) {
        const auto path = corpus::root() / "synthetic" / name;
        auto options = corpus::options_beside(path);
        options.luminaire_tilt = degrees(tilt);
        return candela(parse_photometry(corpus::read_bytes(path), name, options).value, 0, 0);
    };
    EXPECT_NEAR(read_tilted("tilt-include.ies", 0), 100, 1e-9);
    EXPECT_NEAR(read_tilted("tilt-include.ies", 45), 85, 1e-9);
    EXPECT_NEAR(read_tilted("tilt-file.ies", 0), 100, 1e-9);
    EXPECT_NEAR(read_tilted("tilt-file.ies", 22.5), 97.5, 1e-9);
    EXPECT_TRUE(corpus::read("synthetic", "tilt-file.ies").notices.empty());
    EXPECT_TRUE(corpus::read("synthetic", "tilt-none-blanks.ies").notices.empty());
}

TEST(SyntheticFiles, AgreeWhateverSymmetryTheyAreStoredWith) {
    ISOLUX_NEEDS_CORPUS();
    const auto expect_same = [](const std::string& a, const std::string& b) {
        const auto first = read(a), second = read(b);
        for (double c = 1; c < 360; c += 7)
            for (double g = 1; g < 90; g += 7)
                EXPECT_NEAR(candela(first, c, g), candela(second, c, g), 1e-9) << a << b;
    };
    expect_same("ldt-quad-isym4.ldt", "ldt-quad-isym0.ldt");
    expect_same("ldt-quad-isym4.ldt", "ldt-quad-isym2.ldt");
    expect_same("ldt-quad-isym4.ldt", "ldt-quad-isym3.ldt");
    expect_same("ldt-quad-isym4.ldt", "ldt-comma.ldt");
    expect_same("ldt-c0-isym2.ldt", "ldt-c0-isym0.ldt");
    expect_same("ldt-c90-isym3.ldt", "ldt-c90-isym0.ldt");
}

TEST(SyntheticFiles, BeginIsym3AtC270) {
    ISOLUX_NEEDS_CORPUS();
    const auto l = read("ldt-c90-isym3.ldt");
    const double cos30 = std::cos(pi / 6);
    EXPECT_NEAR(candela(l, 90, 30), 300 * cos30, printed);
    EXPECT_NEAR(candela(l, 270, 30), 100 * cos30, printed);
    EXPECT_NEAR(candela(l, 0, 30), 200 * cos30, printed);
}

TEST(SyntheticFiles, ScaleEulumdatByLampFluxAndConversionFactor) {
    ISOLUX_NEEDS_CORPUS();
    EXPECT_NEAR(candela(read("ldt-factor.ldt"), 0, 0), 300, 1e-9);
    const auto absolute = read("ldt-absolute.ldt");
    EXPECT_NEAR(candela(absolute, 0, 0), 954.93, 0.005);
    EXPECT_TRUE(absolute.is_absolute);
    const auto uneven = read("ldt-uneven-isym4.ldt");
    EXPECT_NEAR(candela(uneven, 30, 40),
                0.5 * (candela(uneven, 20, 40) + candela(uneven, 40, 40)),
                1e-9);
}

TEST(SyntheticFiles, LetTheUserChooseTheLampSet) {
    ISOLUX_NEEDS_CORPUS();
    const auto bytes = corpus::read_bytes(corpus::root() / "synthetic" / "ldt-two-sets.ldt");
    PhotometryOptions options;
    options.lamp_set = 1;
    const auto second = parse_photometry(bytes, "x.ldt", options).value;
    EXPECT_NEAR(second.distribution.flux_trapezoid().value(), 5000, 10);
    EXPECT_EQ(second.lamp_set, 1U);
    options.lamp_set = 2;
    EXPECT_THROW(static_cast<void>(parse_photometry(bytes, "x.ldt", options)), InputError);
}

// ---- shapes.tsv ---------------------------------------------------------------------------

struct ShapeRow {
    std::string version;
    std::string width, length, height;
    std::string shape;
};

std::vector<ShapeRow> read_shapes() {
    std::istringstream stream(corpus::read_bytes(corpus::root() / "synthetic" / "shapes.tsv"));
    std::vector<ShapeRow> rows;
    std::string text;
    std::getline(stream, text);
    while (std::getline(stream, text)) {
        std::istringstream columns(text);
        ShapeRow r;
        for (std::string* field : {&r.version, &r.width, &r.length, &r.height, &r.shape})
            std::getline(columns, *field, '\t');
        rows.push_back(r);
    }
    return rows;
}

OpeningShape shape_named(const std::string& name) {
    const auto starts = [&](const char* s) { return name.starts_with(s); };
    if (starts("point"))
        return OpeningShape::point;
    if (starts("rectangle"))
        return OpeningShape::rectangle;
    if (starts("box"))
        return OpeningShape::box;
    if (starts("vertical cylinder") || starts("vertical elliptic cylinder"))
        return OpeningShape::vertical_cylinder;
    if (starts("vertical circle") || starts("vertical ellipse"))
        return OpeningShape::vertical_ellipse;
    if (starts("circle") || starts("ellipse"))
        return starts("ellipsoid") ? OpeningShape::ellipsoid : OpeningShape::ellipse;
    if (starts("horizontal"))
        return name.ends_with("length") ? OpeningShape::cylinder_along_x
                                        : OpeningShape::cylinder_along_y;
    return OpeningShape::ellipsoid; // sphere
}

TEST(SyntheticFiles, CodeEveryOpeningShape) {
    ISOLUX_NEEDS_CORPUS();
    const std::map<std::string, std::string> first_line{{"1986", "free text"},
                                                        {"1991", "IESNA91"},
                                                        {"1995", "IESNA:LM-63-1995"},
                                                        {"2002", "IESNA:LM-63-2002"},
                                                        {"2019", "IES:LM-63-2019"}};
    for (const ShapeRow& r : read_shapes()) {
        SCOPED_TRACE(r.version + " " + r.width + " " + r.length + " " + r.height + " "
                     + r.shape);
        const std::string text = first_line.at(r.version) + "\nTILT=NONE\n1 -1 1 2 1 1 2 "
                                 + r.width + " " + r.length + " " + r.height
                                 + "\n1 1 10\n0 90\n0\n5 5\n";
        const auto document = parse_ies(text, "shape.ies").value;
        const auto parsed = to_photometry(document);
        EXPECT_EQ(parsed.value.opening.shape, shape_named(r.shape));
        // another edition's code is told, the file's own is not
        EXPECT_EQ(parsed.notices.size(), r.shape.ends_with("(1995 code)") ? 1U : 0U);
        // a size that the code states is the size along that axis
        const double w = std::abs(std::stod(r.width)), l = std::abs(std::stod(r.length));
        if (w > 0 && l > 0) {
            EXPECT_DOUBLE_EQ(parsed.value.opening.extent_x.value(), l);
            EXPECT_DOUBLE_EQ(parsed.value.opening.extent_y.value(), w);
        }
    }
}

} // namespace
} // namespace isolux
