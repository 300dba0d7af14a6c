#pragma once

#include <string>

#include "isolux/base/error.h"
#include "isolux/photometry/luminaire_photometry.h"

namespace isolux {

struct LdtWriteOptions {
    std::string report;
    std::string file_name;
    std::string date_and_user;
    int significant_digits = 7; ///< of the largest intensity in cd/klm
};

/// The luminaire as EULUMDAT text with CR LF line ends. Angles keep their numbers, the
/// opening's y extent becomes the length and its x extent the width, so the light stays where
/// it is. Absolute photometry is written with a negative number of lamps and the table's own
/// flux. The ten direct ratios are written as 0, as many makers do: nothing here depends on
/// them. `notices` tell what the format has no place for.
[[nodiscard]] Parsed<std::string> write_ldt(const LuminairePhotometry& luminaire,
                                            const LdtWriteOptions& options = {});

} // namespace isolux
