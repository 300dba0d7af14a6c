#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "isolux/io/results_json.h"

namespace isolux {

enum class ViewerCamera {
    orbit,  ///< perspective, from above a corner
    plan,   ///< parallel, from above, north (+y) up, ceiling taken off
    section ///< parallel, along +y, cut through the middle
};

struct ViewerOptions {
    ViewerCamera camera = ViewerCamera::orbit;
    std::optional<std::filesystem::path> screenshot; ///< PNG; then no window stays open
    std::optional<Point3> probe;                     ///< shown from the start
    std::optional<std::size_t> surface;              ///< this one alone; all where absent
    int width = 1280;                                ///< pixels
    int height = 800;
};

/// What the keys do, one a line.
[[nodiscard]] std::string viewer_keys();

/// Opens a window with the room, the luminaires with C0 arrows and photometric solids, and the
/// calculation surfaces in false colours with isolux lines; returns when it is closed. A click
/// on a surface shows the nearest point's values.
/// @param folder  of the results: room.vtp and the file of web_export.h
/// @throws InputError  where there is no display (find_display_problem), or a file is missing
/// @throws WriteError  where the screenshot cannot be written
void view_results(const ResultsDocument& document,
                  const std::filesystem::path& folder,
                  const ViewerOptions& options);

} // namespace isolux
