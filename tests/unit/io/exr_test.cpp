#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "isolux/base/error.h"
#include "isolux/io/exr.h"
#include "isolux/io/safe_file.h"

namespace isolux::test {
namespace {

namespace fs = std::filesystem;

class Exr : public testing::Test {
protected:
    Exr() { fs::create_directories(folder_); }

    ~Exr() override { fs::remove_all(folder_); }

    fs::path folder_ =
        fs::temp_directory_path()
        / ("isolux-exr-test-" + std::to_string(::getpid())); // tests run side by side
    fs::path file_ = folder_ / "view.exr";
};

Planes3 ramp(std::size_t pixels, float step) {
    Planes3 p;
    p.assign(pixels, 0.0F);
    for (std::size_t i = 0; i < pixels; ++i)
        p.set(i, Rgb{step * i, 2.0 * step * i, 3.0 * step * i});
    return p;
}

ViewPicture small_picture(bool filtered) {
    ViewPicture p;
    p.view = "door";
    p.size = {5, 3};
    p.raw = ramp(15, 1.0F);
    p.emission = ramp(15, 0.1F);
    p.direct = ramp(15, 0.6F);
    p.indirect = ramp(15, 0.3F);
    p.albedo = ramp(15, 0.01F);
    p.normal = ramp(15, 0.02F);
    p.position = ramp(15, 0.5F);
    p.depth.assign(15, 2.5F);
    p.object.assign(15, 1);
    p.object_names = {"office/floor"};
    p.standard_error.assign(15, 0.25F);
    p.illuminance.assign(15, 300.0F);
    p.samples.assign(15, 16.0F);
    if (filtered) {
        p.filtered = ramp(15, 1.5F);
        p.filter_width.assign(15, 3.0F);
        p.filtered_error.assign(15, 0.125F);
        p.filter = "axis-aligned";
    }
    return p;
}

TEST_F(Exr, GivesBackWhatWasWritten) {
    write_exr(file_, small_picture(true));
    const ExrImage image = read_exr(file_);
    EXPECT_EQ(image.size, (PictureSize{5, 3}));
    const auto value = [&](const char* name, std::size_t i) {
        const Plane* p = image.find(name);
        EXPECT_NE(p, nullptr) << name;
        return p != nullptr ? p->at(i) : -1.0F;
    };
    EXPECT_EQ(value("R", 7), 10.5F); // what is shown: filtered
    EXPECT_EQ(value("filtered.G", 7), 21.0F);
    EXPECT_EQ(value("raw.B", 7), 21.0F);
    EXPECT_NEAR(value("raw.Y", 7), 7.0 * (0.2126 + 2 * 0.7152 + 3 * 0.0722), 1e-5);
    EXPECT_NEAR(value("luminance.Y", 7), 1.5 * value("raw.Y", 7), 1e-5);
    EXPECT_EQ(value("error.Y", 7), 0.25F);
    EXPECT_EQ(value("error.filtered", 7), 0.125F);
    EXPECT_EQ(value("direct.R", 14), 0.6F * 14.0F);
    EXPECT_EQ(value("indirect.R", 10), 3.0F);
    EXPECT_EQ(value("position.X", 4), 2.0F);
    EXPECT_EQ(value("Z", 0), 2.5F);
    EXPECT_EQ(value("object.id", 0), 1.0F);
    EXPECT_EQ(value("filter.width", 3), 3.0F);
    EXPECT_EQ(value("samples.N", 3), 16.0F);
    EXPECT_EQ(value("illuminance.E", 3), 300.0F);
}

TEST_F(Exr, HasNoFilteredLayersWithoutAFilter) {
    write_exr(file_, small_picture(false));
    const ExrImage image = read_exr(file_);
    EXPECT_EQ(image.find("filtered.R"), nullptr);
    EXPECT_EQ(image.find("filter.width"), nullptr);
    ASSERT_NE(image.find("R"), nullptr);
    EXPECT_EQ(image.find("R")->at(7), 7.0F);
}

/// `isolux run` renders previews: their files hold what all others do.
TEST_F(Exr, HasTheSameLayersForAPreview) {
    ViewPicture picture = small_picture(true);
    write_exr(file_, picture);
    const ExrImage full = read_exr(file_);
    picture.is_preview = true;
    write_exr(file_, picture);
    const ExrImage preview = read_exr(file_);
    ASSERT_EQ(preview.channels.size(), full.channels.size());
    for (const ExrChannel& c : full.channels)
        EXPECT_NE(preview.find(c.name), nullptr) << c.name;
    EXPECT_NE(preview.find("luminance.Y"), nullptr);
    EXPECT_NE(preview.find("position.X"), nullptr);
}

TEST_F(Exr, ReplacesAFileWholeOrNotAtAll) {
    write_exr(file_, small_picture(false));
    write_exr(file_, small_picture(true));
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder_))
        files += entry.is_regular_file() ? 1U : 0U;
    EXPECT_EQ(files, 1u); // no temporary file is left
    EXPECT_THROW(write_exr(folder_ / "no such folder" / "a.exr", small_picture(false)),
                 WriteError);
}

TEST_F(Exr, SaysWhatIsWrongWithAFile) {
    std::ofstream(file_) << "not a picture";
    try {
        static_cast<void>(read_exr(file_));
        FAIL();
    } catch (const InputError& e) {
        EXPECT_EQ(to_string(e.messages().front())
                      .rfind(file_.string() + ": not a readable OpenEXR picture (", 0),
                  0u)
            << to_string(e.messages().front());
    }
    // half a file
    write_exr(file_, small_picture(true));
    fs::resize_file(file_, fs::file_size(file_) / 2);
    EXPECT_THROW(static_cast<void>(read_exr(file_)), InputError);
    EXPECT_THROW(static_cast<void>(read_exr(folder_ / "missing.exr")), InputError);
}

/// Output of a shell command; empty if it fails.
std::string output_of(const std::string& command, const fs::path& scratch) {
    if (std::system((command + " > '" + scratch.string() + "' 2>&1").c_str()) != 0)
        return {};
    std::ifstream in(scratch);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(Exr, IsReadByTheFormatsOwnTool) {
    write_exr(file_, small_picture(true));
    if (std::system("command -v exrheader > /dev/null") != 0)
        GTEST_SKIP() << "exrheader is not installed";
    const std::string header =
        output_of("exrheader '" + file_.string() + "'", folder_ / "out.txt");
    for (const char* text : {"whiteLuminance (type float): 1",
                             "chromaticities",
                             "raw.Y, 32-bit floating-point",
                             "object.id, 32-bit unsigned integer",
                             "normal.X",
                             "office/floor"})
        EXPECT_NE(header.find(text), std::string::npos) << text << "\n" << header;
}

TEST_F(Exr, IsReadByImageMagick) {
    write_exr(file_, small_picture(true));
    const char* tool = "convert";
    if (std::system("command -v convert > /dev/null && convert -list format | grep -q ' EXR '")
        != 0)
        GTEST_SKIP() << "no ImageMagick that reads OpenEXR";
    const std::string pixel = output_of(std::string(tool) + " '" + file_.string()
                                            + "' -colorspace RGB -format '%w %h' info:",
                                        folder_ / "out.txt");
    EXPECT_EQ(pixel.rfind("5 3", 0), 0u) << pixel;
}

} // namespace
} // namespace isolux::test
