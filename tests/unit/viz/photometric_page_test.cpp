#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "isolux/viz/intensity_diagrams.h"
#include "isolux/viz/photometric_page.h"
#include "isolux/viz/photometric_web.h"

#include "support/photometric_files.h"
#include "support/source_dir.h"

namespace isolux {
namespace {

LuminaireType read_type(const std::filesystem::path& path) {
    LuminaireType type;
    type.name = path.filename().string();
    auto parsed =
        parse_photometry(corpus::read_bytes(path), type.name, corpus::options_beside(path));
    type.opening = parsed.value.opening;
    type.source = std::move(parsed.value);
    return type;
}

LuminaireType shipped(const std::string& name) {
    return read_type(isolux::test::source_dir() / "luminaires" / name);
}

std::string all_text(const Drawing& drawing) {
    std::string all;
    for (const auto& item : drawing.items)
        if (const auto* t = std::get_if<Text>(&item))
            all += t->text + "\n";
    return all;
}

/// Lines drawn with a stroke like `like`.
std::vector<Polyline> lines_with(const Drawing& drawing, const Stroke& like) {
    std::vector<Polyline> lines;
    for (const auto& item : drawing.items)
        if (const auto* s = std::get_if<Shape>(&item))
            if (s->stroke && s->stroke->colour == like.colour && s->stroke->width == like.width
                && s->stroke->dash == like.dash)
                lines.insert(lines.end(), s->lines.begin(), s->lines.end());
    return lines;
}

/// Curves of a cosine towards C0 (gamma 60 is its axis) and half of it towards C180.
PolarCurves tilted_curves() {
    PolarCurves curves;
    for (std::size_t k = 0; k < 4; ++k)
        for (int g = 0; g <= 180; ++g) {
            const double away = (g - (k == 0 ? 60.0 : 0.0)) * std::numbers::pi / 180.0;
            curves[k].gamma.push_back(g);
            curves[k].candela.push_back((k == 0 ? 1000.0 : 500.0)
                                        * std::max(0.0, std::cos(away)));
        }
    return curves;
}

TEST(PolarDiagram, PutsC0AtTheRightAndNadirDown) {
    Drawing page{100, 100, "", {}};
    draw_polar(page, {0, 0, 100, 100}, tilted_curves(), {});
    const auto lines = lines_with(page, c0_stroke);
    ASSERT_EQ(lines.size(), 2u);
    // The farthest point of the C0 curve lies 60 degrees from nadir, at the right and below.
    Point2 centre = lines[0].back(); // towards gamma 180 there is no light
    Point2 farthest = centre;
    for (const Point2& p : lines[0])
        if (std::hypot(p.x - centre.x, p.y - centre.y)
            > std::hypot(farthest.x - centre.x, farthest.y - centre.y))
            farthest = p;
    EXPECT_NEAR(
        std::atan2(farthest.x - centre.x, farthest.y - centre.y), std::numbers::pi / 3.0, 1e-9);
    for (const Point2& p : lines[1])
        EXPECT_LE(p.x, centre.x + 1e-9);
}

TEST(PolarDiagram, ScalesTheCurveByItsRings) {
    Drawing page{100, 100, "", {}};
    draw_polar(page, {0, 0, 100, 100}, tilted_curves(), {0.5, "cd/klm"});
    // 1000 cd become 500: rings at 200, 400 and 600.
    const std::string text = all_text(page);
    EXPECT_NE(text.find("600"), std::string::npos) << text;
    EXPECT_EQ(text.find("1000"), std::string::npos) << text;
}

TEST(CartesianDiagram, RunsFromC180AtTheLeftToC0AtTheRight) {
    Drawing page{100, 80, "", {}};
    draw_cartesian(page, {0, 0, 100, 80}, tilted_curves(), {});
    const auto lines = lines_with(page, c0_stroke);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_GT(lines[0].back().x, lines[0].front().x);
    EXPECT_LT(lines[1].back().x, lines[1].front().x);
    EXPECT_NEAR(lines[0].front().x, lines[1].front().x, 1e-9); // both start at nadir
}

TEST(PhotometricPage, TellsFluxMaximumBeamAndLongAxis) {
    const std::string text = all_text(
        draw_photometric_page(shipped("batwing-linear.ldt"), "batwing-linear.ldt", {}));
    for (const char* part : {"luminous flux",
                             "maximum",
                             "beam angle",
                             "C0-C180",
                             "C90-C270",
                             "along C90-C270 (y)",
                             "batwing-linear.ldt"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(PhotometricPage, LaysOneLuminaireDownAlikeFromBothFormats) {
    const std::string text =
        all_text(draw_photometric_page(shipped("batwing-linear.ies"), "", {}));
    EXPECT_NE(text.find("along C90-C270 (y)"), std::string::npos) << text;
}

TEST(PhotometricPage, CountsPerKilolumenOfTheLamps) {
    const LuminaireType type = shipped("lambertian-panel.ldt");
    PhotometricPageOptions options;
    options.unit = IntensityUnit::candela_per_kilolumen;
    const std::string text = all_text(draw_photometric_page(type, "", options));
    EXPECT_NE(text.find("cd per 1000 lm of the"), std::string::npos) << text;
    // Whatever the flux, a Lambertian luminaire has at most 1000/pi cd/klm.
    EXPECT_NE(text.find("300"), std::string::npos) << text;
}

TEST(PhotometricPage, DrawsOneDiagramAlone) {
    for (const DiagramKind kind :
         {DiagramKind::polar, DiagramKind::cartesian, DiagramKind::web}) {
        PhotometricPageOptions options;
        options.kind = kind;
        const Drawing page = draw_photometric_page(shipped("wall-washer.ies"), "", options);
        EXPECT_EQ(lines_with(page, c90_stroke).empty(), kind == DiagramKind::web);
        EXPECT_LT(page.width, 200.0);
    }
}

TEST(PhotometricWeb, ShowsTheArrowTowardsC0AndTheNamesOfThePlanes) {
    Drawing page{100, 100, "", {}};
    draw_web(page, {0, 0, 100, 100}, shipped("street-lantern.ies"));
    const std::string text = all_text(page);
    for (const char* plane : {"C0\n", "C90\n", "C180\n", "C270\n"})
        EXPECT_NE(text.find(plane), std::string::npos) << plane;
}

TEST(PhotometricWeb, StaysInsideItsBox) {
    Drawing page{120, 90, "", {}};
    draw_web(page, {10, 10, 100, 70}, shipped("narrow-downlight.ldt"));
    for (const auto& item : page.items)
        if (const auto* s = std::get_if<Shape>(&item))
            for (const Polyline& line : s->lines)
                for (const Point2& p : line) {
                    EXPECT_GE(p.x, 10.0 - 1e-9);
                    EXPECT_LE(p.x, 110.0 + 1e-9);
                    EXPECT_GE(p.y, 10.0 - 1e-9);
                    EXPECT_LE(p.y, 80.0 + 1e-9);
                }
}

TEST(PhotometricPage, DrawsEveryFileOfTheCorpus) {
    ISOLUX_NEEDS_CORPUS();
    for (const std::string& name : corpus::files("valid")) {
        const LuminaireType type = read_type(corpus::root() / "valid" / name);
        const Drawing page = draw_photometric_page(type, name, {});
        pugi::xml_document svg;
        const std::string text = to_svg(page);
        EXPECT_TRUE(svg.load_string(text.c_str())) << name;
        EXPECT_EQ(text.find("nan"), std::string::npos) << name;
    }
}

} // namespace
} // namespace isolux
