#pragma once

#include <string>
#include <vector>

#include "isolux/io/project_reader.h"

namespace isolux {

/// Where one luminaire of an entry hangs.
struct Spot {
    Point3 position;
    std::string pointer;        ///< what of the file put it there
    double extra_azimuth = 0.0; ///< degrees
};

/// Reads where the luminaires of one entry hang: "position", "positions", "field", "line" or
/// "ring". Empty: the error has been reported.
/// @param type  of the luminaires; null if it is not known
[[nodiscard]] std::vector<Spot> read_spots(const JsonObject& object,
                                           const ProjectReader& reader,
                                           const LuminaireTypeEntry* type);

} // namespace isolux
