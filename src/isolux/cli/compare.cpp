#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/base/colour.h"
#include "isolux/base/error.h"
#include "isolux/cli/console.h"
#include "isolux/cli/text_table.h"
#include "isolux/cli/verbs.h"
#include "isolux/filter/picture_metrics.h"
#include "isolux/io/exr.h"

namespace isolux {

namespace {

struct CompareOptions {
    std::string test;
    std::string reference;
    std::string second_half;
    std::string layer;
    bool is_json = false;
};

struct LuminancePicture {
    PictureSize size;
    Plane luminance;
};

Plane luminance_of(const Plane& r, const Plane& g, const Plane& b) {
    Plane y(r.size());
    for (std::size_t i = 0; i < y.size(); ++i)
        y[i] = static_cast<float>(luminance_sum({r[i], g[i], b[i]}));
    return y;
}

/// Luminance of a layer: its Y, else its R, G, B. Without a layer: luminance.Y, Y, or R, G, B.
std::optional<Plane> find_luminance(const ExrImage& image, const std::string& layer) {
    const std::string prefix = layer.empty() ? "" : layer + ".";
    if (layer.empty())
        if (const Plane* y = image.find("luminance.Y"))
            return *y;
    if (const Plane* y = image.find(prefix + "Y"))
        return *y;
    const Plane* r = image.find(prefix + "R");
    const Plane* g = image.find(prefix + "G");
    const Plane* b = image.find(prefix + "B");
    if (r != nullptr && g != nullptr && b != nullptr)
        return luminance_of(*r, *g, *b);
    return std::nullopt;
}

LuminancePicture read_luminance(const std::string& path, const std::string& layer) {
    const ExrImage image = read_exr(path);
    if (auto y = find_luminance(image, layer))
        return {image.size, std::move(*y)};
    std::string names;
    for (const ExrChannel& c : image.channels)
        names += (names.empty() ? "" : ", ") + c.name;
    throw InputError(path,
                     layer.empty() ? "no luminance in it (neither Y nor R, G, B)"
                                   : fmt::format("no layer '{}' with luminance", layer),
                     fmt::format("Its channels are {}", names));
}

void check_same_size(const LuminancePicture& a,
                     const std::string& path,
                     const LuminancePicture& b,
                     const std::string& other) {
    if (a.size == b.size)
        return;
    throw InputError(path,
                     fmt::format("{} x {} pixels, but {} has {} x {} (pixels cannot be paired)",
                                 a.size.columns,
                                 a.size.rows,
                                 other,
                                 b.size.columns,
                                 b.size.rows),
                     "Render both views at one resolution");
}

void check_trustworthy(const SquaredError& e, const std::string& path) {
    if (e.is_trustworthy())
        return;
    throw InputError(path,
                     fmt::format("its own noise may change the squared error {:.3g} by {:.2g} "
                                 "(more than a tenth of it)",
                                 e.value,
                                 e.reference_noise),
                     "Render the reference with more rays a pixel");
}

std::string to_text(const PictureMetrics& m) {
    const auto number = [](const std::optional<double>& v) {
        return v ? fmt::format("{:.6f}", *v) : std::string("-");
    };
    TextTable table({{"measure", Align::left}, {"value", Align::right}, {"unit", Align::left}});
    table.add_row({"MSE", fmt::format("{:.6g}", m.mse.value), "(cd/m2)2"});
    table.add_row({"relMSE", fmt::format("{:.6g}", m.relative_mse.value), ""});
    table.add_row({"PSNR", fmt::format("{:.3f}", m.psnr), "dB"});
    table.add_row({"ssim-g11", number(m.ssim_g11), ""});
    table.add_row({"ssim-u7", number(m.ssim_u7), ""});
    table.add_row({"ssim-g11 of log luminance", number(m.log_ssim_g11), ""});
    return table.text();
}

/// What has no value (no window fits, PSNR of equal pictures) is null.
std::string to_json(const CompareOptions& options, const PictureMetrics& m) {
    using Json = nlohmann::ordered_json;
    const auto number = [](const std::optional<double>& v) { return v ? Json(*v) : Json(); };
    const Json document{
        {"isolux_compare", 1},
        {"test", options.test},
        {"reference", options.reference},
        {"mse", m.mse.value},
        {"relative_mse", m.relative_mse.value},
        {"psnr_db", std::isfinite(m.psnr) ? Json(m.psnr) : Json()},
        {"ssim_g11", number(m.ssim_g11)},
        {"ssim_u7", number(m.ssim_u7)},
        {"log_luminance_ssim_g11", number(m.log_ssim_g11)},
    };
    return document.dump(2) + "\n";
}

ExitCode compare(const CompareOptions& options) {
    const LuminancePicture test = read_luminance(options.test, options.layer);
    const LuminancePicture half = read_luminance(options.reference, options.layer);
    check_same_size(test, options.test, half, options.reference);
    Reference reference{half.luminance, std::nullopt, std::nullopt};
    if (!options.second_half.empty()) {
        LuminancePicture other = read_luminance(options.second_half, options.layer);
        check_same_size(other, options.second_half, half, options.reference);
        for (std::size_t i = 0; i < other.luminance.size(); ++i)
            reference.mean[i] = 0.5F * (half.luminance[i] + other.luminance[i]);
        reference.half_1 = half.luminance;
        reference.half_2 = std::move(other.luminance);
    }
    const PictureMetrics m = compare_pictures(test.size, test.luminance, reference);
    check_trustworthy(m.mse, options.reference);
    check_trustworthy(m.relative_mse, options.reference);
    print(options.is_json ? to_json(options, m) : to_text(m));
    return ExitCode::success;
}

} // namespace

Action add_compare(CLI::App& verb) {
    verb.description("Say how far the luminances of two OpenEXR pictures differ");
    verb.footer(R"(
Mean squared error in (cd/m2)2; relMSE, relative to the reference and a tenth of its mean; PSNR
and both SSIM of display-encoded luminance; SSIM of log10 luminance. METHODS 12.5. Luminance is
a layer's Y or is made of its R, G and B; without --layer it is the picture as shown.

Examples:
  isolux compare view.exr reference.exr
  isolux compare view.exr reference.exr --layer raw --json
  isolux compare view.exr seed-1.exr --second-half seed-2.exr
                                          two renderings of the reference with different seeds:
                                          its own noise drops out of MSE and relMSE

Exit status: 0 compared, however different they are; 2 a file is wrong, they differ in size, or
the reference is too noisy to tell.)");
    const auto options = std::make_shared<CompareOptions>();
    verb.add_option("A", options->test, "The picture to judge, OpenEXR")
        ->required()
        ->type_name("");
    verb.add_option("B", options->reference, "The reference to judge it by, OpenEXR")
        ->required()
        ->type_name("");
    verb.add_option("--second-half",
                    options->second_half,
                    "The reference with another seed; the reference is the mean of both")
        ->type_name("C");
    verb.add_option("--layer", options->layer, "Layer of all files, such as raw or indirect")
        ->type_name("NAME");
    verb.add_flag("--json", options->is_json, "Print JSON with all digits");
    return [options] { return compare(*options); };
}

} // namespace isolux
