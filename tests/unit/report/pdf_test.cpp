#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "isolux/report/make_report.h"
#include "isolux/report/page_writer.h"
#include "isolux/report/pdf.h"

#include "unit/report/example_document.h"

namespace isolux::report {
namespace {

Report make_example() { return make_report(examples::make_document(), {}, english()); }

std::string all_text(const std::vector<Drawing>& pages) {
    std::string all;
    for (const Drawing& page : pages)
        for (const auto& item : page.items)
            if (const auto* t = std::get_if<Text>(&item))
                all += t->text + "\n";
    return all;
}

TEST(PdfReport, KeepsEveryTextOnItsPage) {
    const FontRuler ruler;
    for (const Drawing& page : lay_out(make_example()))
        for (const auto& item : page.items)
            if (const auto* t = std::get_if<Text>(&item); t != nullptr && t->turn == 0.0) {
                const double width = ruler.width(t->text, t->size, t->weight);
                const double start = t->anchor == Anchor::start    ? t->at.x
                                     : t->anchor == Anchor::middle ? t->at.x - 0.5 * width
                                                                   : t->at.x - width;
                EXPECT_GE(start, 10.0) << t->text;
                EXPECT_LE(start + width, 203.0) << t->text;
                EXPECT_GE(t->at.y, 10.0) << t->text;
                EXPECT_LE(t->at.y, 290.0) << t->text;
            }
}

TEST(PdfReport, IsA4WithNumberedPagesAndOneBookmarkASection) {
    const Report report = make_example();
    const auto pages = lay_out(report);
    std::string bookmarks;
    for (const Drawing& page : pages)
        bookmarks += page.title + "\n";
    for (const Section& s : report.sections)
        EXPECT_NE(bookmarks.find(s.title), std::string::npos) << s.title;
    for (const Drawing& page : pages) {
        EXPECT_EQ(page.width, 210.0);
        EXPECT_EQ(page.height, 297.0);
    }
    const std::string text = all_text(pages);
    const std::string n = std::to_string(pages.size());
    EXPECT_NE(text.find("1 / " + n), std::string::npos);
    EXPECT_NE(text.find(n + " / " + n), std::string::npos);
    const std::string pdf = to_pdf_report(report);
    EXPECT_TRUE(pdf.starts_with("%PDF-"));
    EXPECT_NE(pdf.find("/Outlines"), std::string::npos);
}

TEST(PdfReport, SaysWhatTheHtmlSays) {
    const std::string text = all_text(lay_out(make_example()));
    for (const char* part : {"Büro \"4\" <draft>",
                             "Results at a glance",
                             "Luminaire schedule",
                             "panel & co",
                             "office <1>",
                             "Uncertainty budget",
                             "2026-05-13 09:30 UTC"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(PageWriter, BreaksLinesBetweenWordsAndLongWordsAnywhere) {
    const PageWriter writer;
    const auto lines = writer.wrap("one two three", 12.0, 3.0, Weight::normal);
    EXPECT_GT(lines.size(), 1u);
    for (const std::string& line : lines)
        EXPECT_LE(writer.ruler().width(line, 3.0, Weight::normal), 12.0) << line;
    const std::string hash(64, 'f');
    std::string joined;
    for (const std::string& line : writer.wrap(hash, 20.0, 3.0, Weight::normal)) {
        EXPECT_LE(writer.ruler().width(line, 3.0, Weight::normal), 20.0);
        joined += line;
    }
    EXPECT_EQ(joined, hash);
    joined.clear();
    for (const std::string& line : writer.wrap("äöüäöüäöüäöü", 5.0, 3.0, Weight::normal))
        joined += printable(line);
    EXPECT_EQ(joined, "äöüäöüäöüäöü"); // never inside a character
}

TEST(PageWriter, SetsLongNarrowListsInTwoColumns) {
    PageWriter writer;
    writer.begin_section("s");
    Table table{"caption", {{"column"}, {"n", true}}, {}, true};
    for (int k = 0; k < 260; ++k)
        table.rows.push_back({{"row"}, {fmt::format("number {}", k)}});
    write_table(writer, table);
    const auto pages = std::move(writer).finish("footer");
    ASSERT_EQ(pages.size(), 2u);
    int heads = 0;
    double rightmost = 0.0;
    double lowest = 0.0;
    std::size_t at = 0;
    const std::string text = all_text(pages);
    for (int k = 0; k < 260; ++k) { // all of them, in order
        at = text.find(fmt::format("\nnumber {}\n", k), at);
        ASSERT_NE(at, std::string::npos) << k;
    }
    for (const Drawing& page : pages)
        for (const auto& item : page.items)
            if (const auto* t = std::get_if<Text>(&item)) {
                heads += t->text == "column" ? 1 : 0;
                if (t->text.starts_with("number"))
                    lowest = std::max(lowest, t->at.y);
                if (t->text == "row")
                    rightmost = std::max(rightmost, t->at.x);
            }
    EXPECT_EQ(heads, 4);
    EXPECT_GT(rightmost, PageWriter::left + 0.5 * PageWriter::text_width);
    EXPECT_LE(lowest, PageWriter::bottom);
}

TEST(PageWriter, RepeatsTheHeadOfATableThatGoesOn) {
    PageWriter writer;
    writer.begin_section("s");
    Table table{"caption", {{"column"}, {"n", true}}, {}};
    for (int k = 0; k < 120; ++k)
        table.rows.push_back({{"row"}, {std::to_string(k)}});
    write_table(writer, table);
    const auto pages = std::move(writer).finish("footer");
    EXPECT_GE(pages.size(), 2u);
    for (const Drawing& page : pages)
        EXPECT_NE(all_text({page}).find("column\n"), std::string::npos);
    EXPECT_NE(all_text(pages).find("\n119\n"), std::string::npos);
}

} // namespace
} // namespace isolux::report
