#pragma once

#include "isolux/photometry/ies.h"

namespace isolux {

/// The luminous opening of a LM-63 file from its three signed numbers: the code of the file's
/// own edition first, then that of the others (files mix them all the time). Length lies along
/// x, width along y. A combination that no edition knows becomes a box of the absolute values,
/// with a warning.
///
/// Signs (w, l, h), d = diameter:
///
///     shape                    1986, 1991   1995                 2002, 2019
///     rectangle, box           w l 0, w l h (one of w, l may be 0 in a box)
///     circle, ellipse          -d 0 0, -w l 0   also  w -l 0     -w -l 0
///     vertical cylinder        -d 0 h           -w l h, w -l h   -w -l h
///     sphere, ellipsoid        -w l h           -d 0 -d, -w l -h -w -l -h
///     cylinder along length                     0 l -d           -w l -h
///     cylinder along width                      w 0 -d           w -l -h
///     upright circle, ellipse                                    -w 0 -h
[[nodiscard]] LuminousOpening make_opening(const IesDocument& document, Findings& findings);

} // namespace isolux
