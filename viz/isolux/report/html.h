#pragma once

#include <string>

#include "isolux/report/content.h"

namespace isolux::report {

/// One self-contained page: no script, nothing from the network, pictures inside. Well-formed
/// XML as well as HTML; prints on A4. Rounded numbers stand in <data value="..."> with the
/// exact number.
[[nodiscard]] std::string to_html(const Report& report);

} // namespace isolux::report
