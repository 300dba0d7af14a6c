#pragma once

#include <optional>
#include <string>

#include "isolux/scene/luminaire.h"
#include "isolux/viz/space_view.h"

namespace isolux {

enum class DiagramKind { polar, cartesian, web };

enum class IntensityUnit { candela, candela_per_kilolumen };

struct PhotometricPageOptions {
    std::optional<DiagramKind> kind; ///< nothing: all three
    IntensityUnit unit = IntensityUnit::candela;
    ViewAngles view; ///< of the web
};

/// One page about a luminaire: polar diagram, Cartesian diagram, photometric web, and the
/// figures that go with them: flux, maximum, beam angles, efficacy, body and its long axis.
/// @param source  shown beside the name, usually the file's name; may be empty
[[nodiscard]] Drawing draw_photometric_page(const LuminaireType& type,
                                            const std::string& source,
                                            const PhotometricPageOptions& options);

} // namespace isolux
