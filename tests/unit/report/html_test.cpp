#include <charconv>
#include <cmath>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "isolux/report/html.h"
#include "isolux/report/make_report.h"

#include "unit/report/example_document.h"

namespace isolux::report {
namespace {

using nlohmann::json;

std::string png_of_a_square() {
    Drawing d{10, 10, "", {}};
    return to_png(d, 50.0);
}

class HtmlReport : public testing::Test {
protected:
    ResultsDocument document_ = examples::make_document();
    std::string text_ =
        to_html(make_report(document_, {{"desk & door", png_of_a_square()}}, english()));
    pugi::xml_document xml_;

    void SetUp() override { ASSERT_TRUE(xml_.load_string(text_.c_str())) << "not well-formed"; }

    [[nodiscard]] pugi::xml_node section(const std::string& id) const {
        return xml_.select_node(("//section[@aria-labelledby='" + id + "']").c_str()).node();
    }
};

std::string text_of(const pugi::xml_node& node) {
    std::string all;
    for (const auto& found : node.select_nodes(".//text()"))
        all += found.node().value();
    return all;
}

double to_number(const std::string& text) {
    double value = NAN;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// The exact number behind a cell; its text must be that number, rounded.
double exact_value(const pugi::xml_node& cell) {
    const pugi::xml_node data = cell.child("data");
    const double exact = to_number(data.attribute("value").value());
    const std::string shown = text_of(cell);
    const double rounded = to_number(shown);
    const std::size_t point = shown.find('.');
    const std::size_t end = shown.find_first_not_of("0123456789.-");
    const auto decimals = point == std::string::npos
                              ? 0.0
                              : static_cast<double>(std::min(end, shown.size()) - point - 1);
    EXPECT_LE(std::abs(rounded - exact),
              0.5 * std::pow(10.0, -decimals) * (1.0 + 1e-9) + 1e-12 * std::abs(exact))
        << shown << " for " << exact;
    return exact;
}

TEST_F(HtmlReport, ShowsTheNumbersOfResultsJsonAtEveryPoint) {
    const json results = json::parse(to_results_json(document_));
    for (std::size_t s = 0; s < results["surfaces"].size(); ++s) {
        const auto rows = section("surface-" + std::to_string(s + 1))
                              .select_nodes(".//table[@class='long']/tbody/tr");
        const json& points = results["surfaces"][s]["points"];
        ASSERT_EQ(rows.size(), points.size());
        for (std::size_t p = 0; p < points.size(); ++p) {
            const auto cells = rows[p].node().select_nodes("td");
            ASSERT_EQ(cells.size(), 8u);
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_EQ(exact_value(cells[k].node()), points[p]["position"][k]);
            std::size_t k = 3;
            for (const char* member : {"value", "lower", "upper", "direct", "indirect"})
                EXPECT_EQ(exact_value(cells[k++].node()), points[p][member]) << member;
        }
    }
}

TEST_F(HtmlReport, ShowsTheSummariesOfResultsJson) {
    const json results = json::parse(to_results_json(document_));
    const auto overview = section("overview").select_nodes("(.//table)[1]/tbody/tr");
    ASSERT_EQ(overview.size(), results["surfaces"].size());
    for (std::size_t s = 0; s < overview.size(); ++s) {
        const json& summary = results["surfaces"][s]["summary"];
        const auto cells = overview[s].node().select_nodes("td");
        std::size_t k = 2;
        for (const char* member : {"mean", "minimum", "maximum", "U0", "Ud"})
            EXPECT_EQ(exact_value(cells[k++].node()), summary[member]["value"]) << member;
        const auto rows =
            section("surface-" + std::to_string(s + 1)).select_nodes("(.//table)[1]/tbody/tr");
        std::size_t row = 0;
        for (const char* member : {"mean", "minimum", "maximum", "U0", "Ud"}) {
            const auto figures = rows[row++].node().select_nodes("td");
            EXPECT_EQ(exact_value(figures[0].node()), summary[member]["value"]);
            EXPECT_EQ(exact_value(figures[1].node()), summary[member]["lower"]);
            EXPECT_EQ(exact_value(figures[2].node()), summary[member]["upper"]);
        }
    }
}

TEST_F(HtmlReport, CountsLuminairesAndTheirFlux) {
    const auto rows = section("luminaires").select_nodes("(.//table)[1]/tbody/tr");
    ASSERT_EQ(rows.size(), 3u); // two types and the total
    EXPECT_EQ(exact_value(rows[0].node().select_node("td[3]").node()), 1.0);
    EXPECT_EQ(exact_value(rows[0].node().select_node("td[4]").node()), 4000.0 / 3.0);
    EXPECT_EQ(exact_value(rows[2].node().select_node("td[5]").node()), 4000.0 / 3.0 + 800.0);
    const std::string text = text_of(section("luminaires"));
    EXPECT_NE(text.find("panel & co"), std::string::npos);
    EXPECT_NE(text.find("length axis aligned to x by the project"), std::string::npos);
    EXPECT_NE(text.find("long side 1.2 m along world x"), std::string::npos) << text;
}

TEST_F(HtmlReport, NeedsNothingBesideItself) {
    EXPECT_EQ(text_.find("<script"), std::string::npos);
    EXPECT_EQ(text_.find("url("), std::string::npos);
    EXPECT_EQ(text_.find("@import"), std::string::npos);
    EXPECT_TRUE(xml_.select_nodes("//link").empty());
    for (const auto& image : xml_.select_nodes("//img"))
        EXPECT_TRUE(std::string(image.node().attribute("src").value()).starts_with("data:"));
    for (const auto& link : xml_.select_nodes("//a"))
        EXPECT_TRUE(std::string(link.node().attribute("href").value()).starts_with("#"));
}

TEST_F(HtmlReport, CanBeReadAloud) {
    EXPECT_STREQ(xml_.child("html").attribute("lang").value(), "en");
    EXPECT_EQ(xml_.select_nodes("//h1").size(), 1u);
    const auto images = xml_.select_nodes("//img");
    EXPECT_GE(images.size(), 5u); // two polar diagrams, room, two maps, view
    for (const auto& image : images)
        EXPECT_GT(std::string(image.node().attribute("alt").value()).size(), 3u);
    for (const auto& table : xml_.select_nodes("//table"))
        EXPECT_FALSE(text_of(table.node().child("caption")).empty());
    for (const auto& header : xml_.select_nodes("//th"))
        EXPECT_FALSE(std::string(header.node().attribute("scope").value()).empty());
}

TEST_F(HtmlReport, LinksItsContents) {
    std::set<std::string> ids;
    for (const auto& node : xml_.select_nodes("//*[@id]"))
        EXPECT_TRUE(ids.insert(node.node().attribute("id").value()).second);
    const auto links = xml_.select_nodes("//nav//a");
    EXPECT_EQ(links.size(), xml_.select_nodes("//section").size());
    for (const auto& link : links)
        EXPECT_TRUE(ids.count(std::string(link.node().attribute("href").value()).substr(1)));
}

TEST_F(HtmlReport, KeepsNamesWithMarkupInThem) {
    EXPECT_EQ(text_of(xml_.select_node("//h1").node()), "Büro \"4\" <draft>");
    const std::string overview = text_of(section("overview"));
    EXPECT_NE(overview.find("office/work \"plane\", 1"), std::string::npos);
    EXPECT_NE(overview.find("outside every room. Move it in?"), std::string::npos);
}

TEST_F(HtmlReport, ListsTheHashesOfAllInputs) {
    const std::string method = text_of(section("method"));
    for (const char letter : {'a', 'b', 'c'})
        EXPECT_NE(method.find(std::string(64, letter)), std::string::npos) << letter;
}

TEST_F(HtmlReport, MarksWhatIsLessAccurateInWords) {
    const auto warning = section("surface-2").select_node(".//p").node();
    EXPECT_STREQ(warning.attribute("class").value(), "mark undecided");
    EXPECT_NE(text_of(warning).find("less accurate"), std::string::npos);
    EXPECT_TRUE(section("surface-1").select_nodes(".//p[@class='mark undecided']").empty());
}

TEST_F(HtmlReport, SaysThePointWhoseIntervalDeservesLessTrust) {
    const auto rows = section("surface-1").select_nodes(".//table[@class='long']/tbody/tr");
    EXPECT_EQ(text_of(rows[1].node().child("th")), "2*");
    EXPECT_EQ(text_of(rows[0].node().child("th")), "1");
}

/// A requirement of 500 lx on the first surface and what was found about it.
Verdict make_verdict(Decision decision, double value) {
    Verdict v;
    v.requirement.standard = "EN 12464-1:2021";
    v.requirement.row = "34.2";
    v.requirement.symbol = "Em";
    v.requirement.limit = 500.0;
    v.requirement.unit = "lx";
    v.subject = "work plane";
    v.decision = decision;
    v.value = {value, 1.25, 16};
    v.interval = {value - 3.0, value + 3.0};
    v.margin = value - 500.0;
    return v;
}

/// The section of a report with these verdicts.
std::string verdict_page(const std::vector<Verdict>& verdicts, pugi::xml_document& xml) {
    ResultsDocument document = examples::make_document();
    document.results.verdicts = verdicts;
    EXPECT_TRUE(xml.load_string(to_html(make_report(document, {}, english())).c_str()));
    return text_of(xml.select_node("//section[@aria-labelledby='verdict']").node());
}

TEST(VerdictPage, SaysWhatWasDecidedInWordsAndNumbers) {
    pugi::xml_document xml;
    const std::string text = verdict_page({make_verdict(Decision::pass, 512.5),
                                           make_verdict(Decision::undecided, 501.25),
                                           make_verdict(Decision::fail, 480.0)},
                                          xml);
    EXPECT_NE(text.find("fail: at least one requirement is not met"), std::string::npos)
        << text;
    const auto rows =
        xml.select_nodes("(//section[@aria-labelledby='verdict']//table)[1]/tbody/tr");
    ASSERT_EQ(rows.size(), 3u);
    std::size_t row = 0;
    for (const auto& [word, value] :
         {std::pair{"pass", 512.5}, std::pair{"undecided", 501.25}, std::pair{"fail", 480.0}}) {
        const auto cells = rows[row++].node().select_nodes("td");
        EXPECT_EQ(text_of(cells[2].node()), "≥ 500 lx");
        EXPECT_EQ(exact_value(cells[3].node()), value);
        EXPECT_EQ(exact_value(cells[4].node()), value - 3.0);
        EXPECT_EQ(exact_value(cells[5].node()), value + 3.0);
        EXPECT_EQ(exact_value(cells[6].node()), value - 500.0);
        EXPECT_EQ(text_of(cells[7].node()), word);
        EXPECT_EQ(cells[7].node().child("span").attribute("class").value(),
                  std::string("mark ") + word);
    }
}

TEST(VerdictPage, SaysWhyNothingWasJudged) {
    Verdict v = make_verdict(Decision::not_judged, 0.0);
    v.reason = "there are no observers";
    pugi::xml_document xml;
    const std::string text = verdict_page({v}, xml);
    EXPECT_NE(text.find("not judged: no requirement could be judged"), std::string::npos)
        << text;
    EXPECT_NE(text.find("there are no observers"), std::string::npos);
}

TEST(ScenesOfTheReport, SayOnceWhyAVerdictIsMissing) {
    ResultsDocument document = examples::make_document();
    SceneResult scene;
    scene.name = "evening";
    Verdict glare;
    glare.subject = "pupils";
    glare.requirement.symbol = "UGR";
    glare.reason = "UGR is not judged in scenes: no reason";
    scene.verdicts = {glare, glare};
    document.results.scenes = {scene};
    const std::string text = to_html(make_report(document, {}, english()));
    const std::string note = "pupils, UGR: UGR is not judged in scenes: no reason";
    const std::size_t at = text.find(note);
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(text.find(note, at + 1), std::string::npos);
}

TEST(VerdictPage, IsLeftOutWhereNothingIsRequired) {
    pugi::xml_document xml;
    EXPECT_EQ(verdict_page({}, xml), "");
}

TEST(HtmlReportWithoutPlan, HasStillItsTables) {
    ResultsDocument document = examples::make_document();
    document.plan = {};
    pugi::xml_document xml;
    ASSERT_TRUE(xml.load_string(to_html(make_report(document, {}, english())).c_str()));
    std::vector<std::string> titles;
    for (const auto& heading : xml.select_nodes("//section//h2"))
        titles.emplace_back(heading.node().text().get());
    EXPECT_THAT(titles,
                testing::ElementsAre("Verdict",
                                     "Results at a glance",
                                     document.results.surfaces[0].surface.name,
                                     document.results.surfaces[1].surface.name,
                                     "Glare",
                                     "Energy",
                                     "Method and uncertainty"));
}

TEST(HtmlReportOfManyPoints, SaysWhatItLeavesOut) {
    ResultsDocument document = examples::make_document();
    SurfaceResult& s = document.results.surfaces[1];
    while (s.points.size() < 1501) {
        s.points.push_back(s.points.front());
        s.surface.receivers.push_back(s.surface.receivers.front());
    }
    const std::string text = to_html(make_report(document, {}, english()));
    EXPECT_NE(text.find("1500 of 1501 points are listed here"), std::string::npos);
}

} // namespace
} // namespace isolux::report
