#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/photometry/file_number.h"
#include "isolux/photometry/luminaire_photometry.h"
#include "isolux/photometry/read_photometry.h"

/// EULUMDAT, the European luminaire file ("*.ldt", Stockmar 1990). One value a line, no names;
/// to read one by eye, count lines:
///
///     1..3    company; type indicator; symmetry Isym (0 none, 1 rotational, 2 about C0-C180,
///             3 about C90-C270, 4 both)
///     4..7    Mc C planes, their step; Ng gammas, their step (0: uneven)
///     8..12   report, luminaire name, number, file name, date
///     13..21  luminaire length, width, height; luminous length, width; luminous heights seen
///             from C0, C90, C180, C270; all in mm; width 0: round
///     22..25  downward flux %, light output ratio %, factor of the intensities, tilt
///     26      n lamp sets, then six lines each: lamps (negative: absolute photometry), type,
///             flux of the set, colour, colour rendering, watts
///     then    10 direct ratios, Mc C angles, Ng gammas, intensities in cd/klm, gamma fastest
///
/// All C angles are listed whatever the symmetry; intensities only for the planes that it does
/// not imply. Isym 3 starts at C270 and runs over C0 to C90. The length lies along C90-C270.
namespace isolux {

class Findings;
class SourceText;

struct LdtLampSet {
    FileNumber lamps; ///< negative: absolute photometry
    std::string type;
    FileNumber flux; ///< lm, of the whole set
    std::string colour;
    std::string colour_rendering;
    FileNumber watts; ///< with control gear
};

/// A EULUMDAT file, faithful: its own order, units and line numbers.
struct LdtDocument {
    std::string source;
    std::string company;
    FileNumber type_indicator;
    FileNumber symmetry; ///< Isym, 0 to 4
    FileNumber planes;   ///< Mc
    FileNumber plane_step;
    FileNumber gammas; ///< Ng
    FileNumber gamma_step;
    std::string report;
    std::string name;
    std::string number;
    std::string file_name;
    std::string date_and_user;
    FileNumber length; ///< mm, as are all sizes
    FileNumber width;
    FileNumber height;
    FileNumber luminous_length;
    FileNumber luminous_width;
    std::array<FileNumber, 4> luminous_heights; ///< seen from C0, C90, C180, C270
    FileNumber downward_flux;                   ///< percent
    FileNumber light_output_ratio;              ///< percent
    FileNumber conversion_factor;
    FileNumber tilt; ///< degrees
    FileNumber set_count;
    std::vector<LdtLampSet> lamp_sets;
    std::array<FileNumber, 10> direct_ratios;
    std::vector<FileNumber> c_angles;     ///< degrees, all Mc of them
    std::vector<FileNumber> gamma_angles; ///< degrees
    std::vector<std::size_t> stored;      ///< index into c_angles of every stored plane
    bool stores_all_planes = false;       ///< although the symmetry asks for fewer
    std::vector<FileNumber> intensities;  ///< cd/klm, gamma fastest, stored.size() planes
};

/// @throws InputError  with `source:line` of whatever makes the file unreadable
[[nodiscard]] Parsed<LdtDocument> parse_ldt(std::string_view bytes, std::string_view source);
[[nodiscard]] LdtDocument parse_ldt(const SourceText& text, Findings& findings);

/// Our units and conventions: candelas of the chosen lamp set, symmetry expanded, metres,
/// opening placed with its length along y.
/// @throws InputError
[[nodiscard]] Parsed<LuminairePhotometry> to_photometry(const LdtDocument& document,
                                                        const PhotometryOptions& options = {});
[[nodiscard]] LuminairePhotometry to_photometry(const LdtDocument& document,
                                                const PhotometryOptions& options,
                                                Findings& findings);

} // namespace isolux
