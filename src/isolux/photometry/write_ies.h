#pragma once

#include <string>

#include "isolux/base/error.h"
#include "isolux/photometry/luminaire_photometry.h"

namespace isolux {

struct IesWriteOptions {
    PhotometricFormat edition = PhotometricFormat::lm63_2019; ///< or lm63_2002
    std::string test = "none";
    std::string laboratory = "none";
    std::string issue_date; ///< dd-MMM-yyyy; may be empty
    /// LM-63-2019 file generation type: 1.00001 undefined, 1.0001 computer simulation.
    double generation_type = 1.00001;
    int significant_digits = 7; ///< of the largest candela
};

/// The luminaire as LM-63 text with CR LF line ends; types A and B stay what they are. Angles
/// keep their numbers, the opening's y extent becomes the width and its x extent the length, so
/// the light stays where it is. `notices` tell what the format has no place for.
/// @pre edition is lm63_2002 or lm63_2019
[[nodiscard]] Parsed<std::string> write_ies(const LuminairePhotometry& luminaire,
                                            const IesWriteOptions& options = {});

} // namespace isolux
