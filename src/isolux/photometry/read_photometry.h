#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "isolux/base/angle.h"
#include "isolux/base/error.h"
#include "isolux/photometry/luminaire_photometry.h"

namespace isolux {

class Findings;

struct PhotometryOptions {
    bool strict = false;      ///< whatever breaks a rule of the format becomes an error
    std::size_t lamp_set = 0; ///< EULUMDAT: which of the alternative lamp sets lights the table
    std::string variant;      ///< GLDF: id of the product's variant, or its number from 1
    Angle luminaire_tilt; ///< LM-63 TILT: how far the luminaire is turned up from straight down
    /// Gives the text of a file that lies beside this one (TILT=file). Reading files is io's
    /// work, so the reader asks; absent or empty answer: the file is treated as missing.
    std::function<std::optional<std::string>(std::string_view file_name)> sibling;
};

/// Reads a luminaire file of any supported format from its bytes; the format is told from the
/// content, the name only settles doubts.
/// @param source  the file's name as messages should show it
/// @throws InputError  with `source:line: problem (why). Suggestion?`
[[nodiscard]] Parsed<LuminairePhotometry> parse_photometry(
    std::string_view bytes, std::string_view source, const PhotometryOptions& options = {});

/// The same for a file that is no container; what was found is added to `findings`, and
/// `strict` is left to the caller.
[[nodiscard]] LuminairePhotometry parse_text_photometry(std::string_view bytes,
                                                        const PhotometryOptions& options,
                                                        Findings& findings);

} // namespace isolux
