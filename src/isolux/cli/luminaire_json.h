#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isolux/photometry/luminaire_photometry.h"

namespace isolux {

/// What became of one luminaire file: its photometry, or why there is none.
struct ReadLuminaire {
    std::string file;
    std::optional<Parsed<LuminairePhotometry>> parsed;
    std::vector<Message> errors;
};

/// JSON text, ended by a line feed: an object for one file, an array of them for several. A
/// file that could not be read has the keys `file` and `errors`.
[[nodiscard]] std::string to_json_text(std::span<const ReadLuminaire> luminaires);

} // namespace isolux
