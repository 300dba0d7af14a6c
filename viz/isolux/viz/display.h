#pragma once

#include <optional>
#include <string>

namespace isolux {

/// Why no window can be opened here; nothing where one can. Tries the X display that DISPLAY
/// names and its OpenGL extension (GLX), because VTK ends the program where they fail.
[[nodiscard]] std::optional<std::string> find_display_problem();

} // namespace isolux
