#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "isolux/viz/label_layout.h"
#include "isolux/viz/map.h"
#include "isolux/viz/map_values.h"

#include "unit/viz/example_results.h"

namespace isolux {
namespace {

using namespace examples;

const MapNotes notes{"Example <project>", 0.95, 0.01, 0.1};

std::vector<std::string> texts_of(const Drawing& drawing) {
    std::vector<std::string> texts;
    for (const auto& item : drawing.items)
        if (const auto* t = std::get_if<Text>(&item))
            texts.push_back(t->text);
    return texts;
}

bool has_text(const Drawing& drawing, const std::string& part) {
    const auto texts = texts_of(drawing);
    return std::any_of(texts.begin(), texts.end(), [&](const std::string& t) {
        return t.find(part) != std::string::npos;
    });
}

/// Rooms that texts take on the page. Height: what digits and capitals fill.
std::vector<LabelBox> text_boxes(const Drawing& drawing) {
    const FontRuler ruler;
    std::vector<LabelBox> boxes;
    for (const auto& item : drawing.items)
        if (const auto* t = std::get_if<Text>(&item)) {
            const double width = ruler.width(t->text, t->size, t->weight);
            const double turn = t->turn * std::acos(-1.0) / 180.0;
            const double along = t->anchor == Anchor::start
                                     ? 0.5 * width
                                     : (t->anchor == Anchor::middle ? 0.0 : -0.5 * width);
            const double up = 0.5 * cap_height * t->size;
            boxes.push_back({{t->at.x + along * std::cos(turn) - up * std::sin(turn),
                              t->at.y - along * std::sin(turn) - up * std::cos(turn)},
                             width,
                             cap_height * t->size,
                             t->turn});
        }
    return boxes;
}

void expect_no_text_over_text(const Drawing& drawing, const char* name) {
    const auto boxes = text_boxes(drawing);
    const auto texts = texts_of(drawing);
    for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = a + 1; b < boxes.size(); ++b)
            EXPECT_FALSE(overlap(boxes[a], boxes[b]))
                << name << ": '" << texts[a] << "' over '" << texts[b] << "'";
}

void expect_texts_on_page(const Drawing& drawing, const char* name) {
    const auto boxes = text_boxes(drawing);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        const double half = boxes[k].turn == 0.0 ? 0.5 * boxes[k].width : 0.0;
        EXPECT_GE(boxes[k].centre.x - half, 0.0) << name << texts_of(drawing)[k];
        EXPECT_LE(boxes[k].centre.x + half, drawing.width) << name << texts_of(drawing)[k];
        EXPECT_LE(boxes[k].centre.y, drawing.height) << name << texts_of(drawing)[k];
    }
}

SurfaceResult one_point(double value) {
    SurfaceResult r;
    r.surface.name = "point";
    r.surface.receivers = {{{3, 4, 0.75}, UnitVector3(Vector3{0, 0, 1})}};
    PointResult p;
    p.total = {value, 0.001 * value, 32};
    r.points = {p};
    return r;
}

SurfaceResult rectangle(GridCounts counts, double width, double height, const Field& field) {
    return make_result("surface", frame_at(0, 0, 0.75), width, height, counts, field);
}

TEST(Map, KeepsTextsApartAndOnThePage) {
    const auto [office, plan] = open_office();
    const auto [corridor, corridor_plan] = l_corridor();
    const auto slope = [](double u, double v) { return 100.0 + 40.0 * u + 10.0 * v; };
    const std::vector<std::tuple<const char*, SurfaceResult, Plan>> cases{
        {"office", office, plan},
        {"L", corridor, corridor_plan},
        {"row", rectangle({30, 1}, 30, 1, slope), {}},
        {"column", rectangle({1, 30}, 1, 30, slope), {}},
        {"one cell", rectangle({1, 1}, 1.6, 0.8, slope), {}},
        {"large", rectangle({120, 90}, 12, 9, slope), plan},
        {"flat", rectangle({9, 7}, 9, 7, [](double, double) { return 500.0; }), plan},
        {"dark", rectangle({9, 7}, 9, 7, [](double, double) { return 0.0; }), {}},
        {"decades",
         rectangle({9, 7}, 9, 7, [](double u, double) { return std::pow(10.0, u - 3); }),
         {}},
        {"point", one_point(512), {}},
    };
    for (const auto& [name, result, its_plan] : cases) {
        const Drawing drawing = draw_map(result, its_plan, notes);
        expect_no_text_over_text(drawing, name);
        expect_texts_on_page(drawing, name);
    }
}

TEST(Map, IsWellFormedXmlWithRealText) {
    auto [result, plan] = open_office();
    result.surface.name = "B\xC3\xBCro <1> & \x01 \xFF";
    pugi::xml_document document;
    const std::string svg = to_svg(draw_map(result, plan, notes));
    const auto parsed = document.load_buffer(svg.data(), svg.size());
    ASSERT_TRUE(parsed) << parsed.description() << " at " << parsed.offset;
    const pugi::xml_node root = document.child("svg");
    EXPECT_STREQ(root.child_value("title"), "B\xC3\xBCro <1> &   ?");
    EXPECT_GT(std::distance(root.children("g").begin(), root.children("g").end()), 0);
    for (const pugi::xml_node text : root.children("text"))
        EXPECT_STRNE(text.child_value(), "");
}

TEST(Map, GivesEqualBytesForEqualInput) {
    const auto [result, plan] = l_corridor();
    const Drawing once = draw_map(result, plan, notes);
    const Drawing again = draw_map(result, plan, notes);
    EXPECT_EQ(to_svg(once), to_svg(again));
    EXPECT_EQ(to_png(once, 60), to_png(again, 60));
}

TEST(Map, StatesFiguresWithTheirIntervals) {
    const auto [result, plan] = open_office();
    const Drawing drawing = draw_map(result, plan, notes);
    // Student's 97.5 % quantile for 31 degrees of freedom is 2.04.
    EXPECT_TRUE(has_text(drawing, "Em 330 lx ± 0.61 %"));
    EXPECT_TRUE(has_text(drawing, "U0 0.69 ± 0.82 %"));
    EXPECT_TRUE(has_text(drawing, "every point within ± 0.82 % (asked for 1 %)"));
    EXPECT_TRUE(has_text(drawing, "grid 18 × 13"));
}

TEST(Map, SaysWhereTheToleranceIsNotReached) {
    auto [result, plan] = open_office();
    result.converged = false;
    result.points[3].total.standard_error = 0.05 * result.points[3].total.mean;
    EXPECT_TRUE(has_text(draw_map(result, plan, notes),
                         "NOT CONVERGED: points known to ± 10 % only (asked for 1 %)"));
}

TEST(Map, MarksLowestAndHighestValue) {
    const auto [result, plan] = l_corridor();
    const Drawing drawing = draw_map(result, plan, notes);
    EXPECT_TRUE(has_text(drawing, "▼1.59"));
    EXPECT_TRUE(has_text(drawing, "▲129"));
}

TEST(Map, ShowsAWallFromItsFrontWithItsOwnCoordinates) {
    Frame wall;
    wall.origin = {8, 5, 0};
    wall.x = UnitVector3(Vector3{-1, 0, 0});
    wall.y = UnitVector3(Vector3{0, 0, 1});
    wall.z = UnitVector3(Vector3{0, 1, 0});
    const auto result = make_result(
        "wall", wall, 8, 2.8, {20, 7}, [](double u, double) { return 100.0 + 50.0 * u; });
    const auto [office, plan] = open_office();
    const Drawing drawing = draw_map(result, plan, notes);
    EXPECT_TRUE(has_text(drawing, "u / m"));
    EXPECT_FALSE(has_text(drawing, "luminaire"));
    // u runs to the right, so the darkest point (u = 0) is left of the brightest.
    double lowest = 0.0;
    double highest = 0.0;
    for (const auto& item : drawing.items)
        if (const auto* t = std::get_if<Text>(&item)) {
            lowest = t->text.starts_with("▼1") ? t->at.x : lowest;
            highest = t->text.starts_with("▲4") ? t->at.x : highest;
        }
    EXPECT_LT(lowest, highest);
}

TEST(Map, SurvivesASurfaceWithoutPoints) {
    SurfaceResult result;
    result.surface.name = "nothing";
    EXPECT_GT(draw_map(result, {}, notes).items.size(), 0u);
    auto [empty_grid, plan] = open_office();
    empty_grid.points.clear();
    empty_grid.surface.receivers.clear();
    empty_grid.surface.grid->cell_of_point.clear();
    EXPECT_GT(draw_map(empty_grid, plan, notes).items.size(), 0u);
}

TEST(PlanMap, NumbersLuminairesByTypeAndCountsThem) {
    auto [result, plan] = open_office();
    const std::vector<CalculationSurface> surfaces{result.surface};
    const Drawing drawing = draw_plan_map(plan, surfaces, "Example");
    EXPECT_TRUE(has_text(drawing, "1: 40 × Linear direct/indirect 1200, 4200 lm"));
    EXPECT_TRUE(has_text(drawing, "40 luminaires, 168000 lm"));
    const auto texts = texts_of(drawing);
    EXPECT_GE(std::count(texts.begin(), texts.end(), "1"), 40);
    expect_no_text_over_text(drawing, "plan");
    expect_texts_on_page(drawing, "plan");
}

TEST(PlanMap, SurvivesAnEmptyScene) { EXPECT_GT(draw_plan_map({}, {}, "").items.size(), 0u); }

TEST(Map, WritesSvgAndPngAndNothingElse) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "isolux_maps";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    write_map(folder / "work plane 0.75", one_point(100), {}, notes);
    EXPECT_GT(std::filesystem::file_size(folder / "work plane 0.75.svg"), 1000u);
    EXPECT_GT(std::filesystem::file_size(folder / "work plane 0.75.png"), 1000u);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 2);
}

TEST(Png, HasThePixelsOfThePage) {
    Drawing drawing;
    drawing.width = 50.8;
    drawing.height = 25.4;
    const std::string png = to_png(drawing, 100);
    ASSERT_GT(png.size(), 24u);
    EXPECT_EQ(png.substr(1, 3), "PNG");
    const auto number = [&](std::size_t at) {
        return (static_cast<unsigned char>(png[at + 2]) << 8)
               + static_cast<unsigned char>(png[at + 3]);
    };
    EXPECT_EQ(number(16), 200);
    EXPECT_EQ(number(20), 100);
}

} // namespace
} // namespace isolux
