#pragma once

#include <string>

#include "isolux/photometry/luminaire_photometry.h"

namespace isolux {

/// What a photometrist wants to see of one luminaire, a line each thing, without its notices.
[[nodiscard]] std::string to_info_text(const std::string& file,
                                       const LuminairePhotometry& luminaire);

} // namespace isolux
