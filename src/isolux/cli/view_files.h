#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "isolux/calc/render.h"
#include "isolux/viz/picture_png.h"

namespace isolux {

/// Renders a project's views one after the other and writes each as soon as it is done, for
/// `run` and `render`.
struct ViewJob {
    const Scene& scene;
    std::vector<View> views;
    RenderSettings settings; ///< the time limit is shared by the views
    std::filesystem::path folder;
    bool with_illuminance = false; ///< a false-colour picture of it, too
    bool is_progress_shown = false;
};

/// @return  a line about each picture; views left out for want of time are named, too
/// Files: STEM.exr, STEM.png (tone-mapped), STEM-luminance.png and STEM-illuminance.png (false
/// colours).
[[nodiscard]] std::vector<std::string> render_views(const ViewJob& job, std::stop_token stop);

} // namespace isolux
