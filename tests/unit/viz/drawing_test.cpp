#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "isolux/base/error.h"
#include "isolux/viz/drawing_parts.h"

#include "support/temporary_folder.h"

namespace isolux {
namespace {

Drawing sample() {
    Drawing d{50, 40, "A & B", {}};
    Shape square = make_rectangle({5, 5, 20, 10});
    square.fill = Colour{10, 200, 30};
    square.opacity = 0.5;
    d.items.emplace_back(std::move(square));
    d.items.emplace_back(make_line({{0, 0}, {10, 10}}, {ink::black, 0.4, 1.0}));
    d.items.emplace_back(make_text("Größe <1>", {5, 20}, 3.0));
    return d;
}

TEST(Pdf, HasOnePageADrawingAndEndsProperly) {
    const std::vector<Drawing> pages{sample(), sample(), sample()};
    const std::string pdf = to_pdf(pages, "Report");
    EXPECT_TRUE(pdf.starts_with("%PDF-"));
    EXPECT_NE(pdf.rfind("%%EOF"), std::string::npos);
    EXPECT_NE(pdf.find("/Count 3"), std::string::npos);
}

TEST(Pdf, IsTheSameBytesForTheSameDrawings) {
    const std::vector<Drawing> pages{sample()};
    EXPECT_EQ(to_pdf(pages, "Report"), to_pdf(pages, "Report"));
    EXPECT_EQ(to_pdf(pages, "Report").find("/CreationDate"), std::string::npos);
}

TEST(Drawing, IsPlacedInsideAnotherToScale) {
    Drawing page{210, 297, "", {}};
    place(page, sample(), {100, 50}, 2.0);
    ASSERT_EQ(page.items.size(), sample().items.size());
    EXPECT_EQ(std::get<Shape>(page.items[0]).lines[0][2], (Point2{150, 80}));
    EXPECT_EQ(std::get<Shape>(page.items[1]).stroke->width, 0.8);
    EXPECT_EQ(std::get<Shape>(page.items[1]).stroke->dash, 2.0);
    EXPECT_EQ(std::get<Text>(page.items[2]).size, 6.0);
    EXPECT_EQ(std::get<Text>(page.items[2]).at, (Point2{110, 90}));
}

TEST(Picture, IsShownInEveryFormat) {
    const std::string png = to_png(sample(), 50.0);
    const auto size = png_size(png);
    ASSERT_TRUE(size.has_value());
    EXPECT_EQ(size->width, 99u); // 50 mm at 50 dots per inch
    EXPECT_EQ(size->height, 79u);
    Drawing d{60, 60, "", {}};
    d.items.emplace_back(Picture{png, {5, 5}, 50, 40});
    pugi::xml_document svg;
    ASSERT_TRUE(svg.load_string(to_svg(d).c_str()));
    const std::string href = svg.select_node("//image").node().attribute("xlink:href").value();
    EXPECT_EQ(href, "data:image/png;base64," + to_base64(png));
    EXPECT_GT(to_png(d).size(), 500u);
    EXPECT_NE(to_pdf({&d, 1}, "").find("/Subtype /Image"), std::string::npos);
}

TEST(Picture, IsNotTakenFromOtherBytes) {
    EXPECT_FALSE(png_size("GIF89a").has_value());
    EXPECT_FALSE(png_size(to_png(sample()).substr(0, 20)).has_value());
    Drawing d{60, 60, "", {}};
    d.items.emplace_back(Picture{to_png(sample()).substr(0, 100), {5, 5}, 50, 40});
    EXPECT_THROW(static_cast<void>(to_png(d)), DeviceError);
}

TEST(Base64, AgreesWithTheTestVectorsOfRfc4648) {
    EXPECT_EQ(to_base64(""), "");
    EXPECT_EQ(to_base64("f"), "Zg==");
    EXPECT_EQ(to_base64("fo"), "Zm8=");
    EXPECT_EQ(to_base64("foo"), "Zm9v");
    EXPECT_EQ(to_base64("foobar"), "Zm9vYmFy");
}

TEST(WriteDrawingFile, FollowsTheEndingOfTheName) {
    const test::TemporaryFolder folder;
    for (const auto& [name, start] : {std::pair{"a.svg", "<?xml"},
                                      std::pair{"a.PNG", "\x89PNG"},
                                      std::pair{"a.pdf", "%PDF"}}) {
        write_drawing_file(folder.path() / name, sample());
        EXPECT_TRUE(test::read_bytes(folder.path() / name).starts_with(start)) << name;
    }
    try {
        write_drawing_file("a.jpg", sample());
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "a.jpg: no picture format goes by this name. A name that ends in .svg, "
                     ".png or .pdf?");
    }
}

} // namespace
} // namespace isolux
