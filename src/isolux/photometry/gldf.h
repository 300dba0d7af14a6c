#pragma once

#include <string_view>

#include "isolux/photometry/findings.h"
#include "isolux/photometry/luminaire_photometry.h"
#include "isolux/photometry/read_photometry.h"

/// GLDF, the Global Lighting Data Format 1.0: a ZIP container with `product.xml` and the files
/// it names, photometry in the folder `ldc` (EULUMDAT, LM-63 or TM-33).
///
///     Variants/Variant/Geometry .. EmitterReference emitterId
///         -> Emitters/Emitter/FixedLightEmitter .. PhotometryReference photometryId
///             -> Photometries/Photometry/PhotometryFileReference fileId
///                 -> Files/File contentType="ldc/eulumdat" type="localFileName": its name
///
/// A product has variants, of which one hangs in a room: the first, unless another is chosen.
/// All emitters of a variant shine together: each reference adds the light of its file once,
/// from one photometric centre, and a notice says so. Of an emitter with several parts the
/// first that is not for emergencies only is taken. Rotations of emitters are not applied but
/// noticed. The files' own candelas hold; RatedLuminousFlux is only compared with them. Files
/// named by a URL are never fetched.
namespace isolux {

/// @param bytes    the whole container
/// @param options  `variant` chooses by id or number; `sibling` is not asked
/// @throws InputError  places are `source/product.xml:line` and `source/ldc/name:line`
[[nodiscard]] LuminairePhotometry
parse_gldf(std::string_view bytes, const PhotometryOptions& options, Findings& findings);

} // namespace isolux
