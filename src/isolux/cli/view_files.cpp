#include "isolux/cli/view_files.h"

#include <chrono>

#include <fmt/format.h>

#include "isolux/base/parallel.h"
#include "isolux/cli/terminal.h"
#include "isolux/io/exr.h"
#include "isolux/io/file_name.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// What a number of seconds is left for the next of `views` views.
std::optional<std::chrono::duration<double>>
share_of_time(const RenderSettings& settings, Clock::time_point start, std::size_t views) {
    if (!settings.time_limit)
        return std::nullopt;
    const std::chrono::duration<double> left = *settings.time_limit - (Clock::now() - start);
    return left / static_cast<double>(views);
}

std::string
write_files(const ViewJob& job, const ViewPicture& picture, const std::string& stem) {
    const Exposure exposure = choose_exposure(picture);
    // The .exr is packed while the others are drawn.
    for_each_index(2, 1, [&](std::size_t part) {
        if (part == 0) {
            write_exr(job.folder / (stem + ".exr"), picture);
            return;
        }
        write_tone_mapped(job.folder / (stem + ".png"), picture, exposure);
        write_false_colours(job.folder / (stem + "-luminance.png"),
                            picture,
                            PictureQuantity::luminance,
                            picture.view);
        if (job.with_illuminance)
            write_false_colours(job.folder / (stem + "-illuminance.png"),
                                picture,
                                PictureQuantity::illuminance,
                                picture.view);
    });
    return describe(exposure);
}

std::string
to_line(const ViewPicture& p, const std::string& stem, const std::string& exposure) {
    double rays = 0.0;
    for (const float s : p.samples)
        rays += static_cast<double>(s);
    rays /= static_cast<double>(p.size.pixels());
    return fmt::format("view {}: {} x {} pixels, {:.4g} rays a pixel{}, raw error {:.2g} %, "
                       "{}, {}; {}.exr, .png, -luminance.png",
                       p.view,
                       p.size.columns,
                       p.size.rows,
                       rays,
                       p.interrupted ? " (stopped early)" : "",
                       100.0 * p.error,
                       exposure,
                       format_seconds(p.wall_seconds),
                       stem);
}

} // namespace

std::vector<std::string> render_views(const ViewJob& job, std::stop_token stop) {
    std::vector<std::string> names;
    for (const View& v : job.views)
        names.push_back(v.name);
    const std::vector<std::string> stems = file_stems(names);
    std::vector<std::string> lines;
    const auto start = Clock::now();
    for (std::size_t i = 0; i < job.views.size(); ++i) {
        RenderSettings settings = job.settings;
        settings.time_limit = share_of_time(job.settings, start, job.views.size() - i);
        const bool no_time = settings.time_limit && settings.time_limit->count() <= 0.0;
        if (stop.stop_requested() || no_time) {
            lines.push_back("view " + names[i] + ": left out (no time was left)");
            continue;
        }
        ProgressLine line(job.is_progress_shown);
        const ViewPicture picture =
            render(job.scene, job.views[i], settings, {stop, [&](const Progress& p) {
                                                           line.show(p);
                                                       }});
        line.clear();
        lines.push_back(to_line(picture, stems[i], write_files(job, picture, stems[i])));
    }
    return lines;
}

} // namespace isolux
