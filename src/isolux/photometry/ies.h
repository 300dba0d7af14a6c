#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/base/angle.h"
#include "isolux/base/error.h"
#include "isolux/photometry/file_number.h"
#include "isolux/photometry/luminaire_photometry.h"
#include "isolux/photometry/read_photometry.h"

/// ANSI/IES LM-63, the North American luminaire file ("*.ies"). To read one by eye:
///
///     IESNA:LM-63-2002            version; a 1986 file has none and starts with free text
///     [TEST] 1234                 labels: [KEYWORD] text, [MORE] goes on
///     TILT=NONE                   ends the labels; INCLUDE: four records follow; else a file
///     name 1 3000 1 37 5 1 2 0.3 1.2 0 lamps, lumens per lamp (-1: absolute photometry),
///     multiplier,
///                                 vertical angles, horizontal angles, type (1 C, 2 B, 3 A),
///                                 unit (1 feet, 2 metres), width, length, height of the
///                                 opening
///     1 1 40                      ballast factor, a field that changed its meaning, watts
///     0 2.5 5 ... 90              vertical angles, 0 is down
///     0 22.5 45 67.5 90           horizontal angles; their range tells the symmetry
///     812 810 ...                 candelas, all verticals of the first plane, then the next
///
/// Numbers are separated by blanks, line ends or commas. Signs of width, length and height code
/// the shape of the opening. Length lies along the plane 0-180, width along 90-270.
namespace isolux {

class Findings;
class SourceText;

/// `[KEYWORD] text`, or a free line (empty keyword).
struct IesLabel {
    std::string keyword; ///< upper case, without brackets
    std::string text;
    std::size_t line = 0;
};

/// Candela factors of a lamp that changes its output when tilted.
struct IesTilt {
    FileNumber geometry; ///< 1 lamp upright; 2 lamp level and stays so; 3 lamp level and tilts
    std::vector<FileNumber> angles; ///< degrees, ascending
    std::vector<FileNumber> factors;
};

/// A LM-63 file, faithful: its own order, units and line numbers.
struct IesDocument {
    std::string source;
    PhotometricFormat format = PhotometricFormat::lm63_1986;
    std::string version_line; ///< as found; empty in a 1986 file
    std::vector<IesLabel> labels;
    std::string tilt; ///< NONE, INCLUDE or a file name
    std::size_t tilt_line = 0;
    std::optional<IesTilt> tilt_data; ///< of TILT=INCLUDE

    FileNumber lamps;
    FileNumber lumens_per_lamp; ///< -1: absolute photometry
    FileNumber multiplier;
    FileNumber photometric_type; ///< 1 C, 2 B, 3 A
    FileNumber units;            ///< 1 feet, 2 metres
    FileNumber width;
    FileNumber length;
    FileNumber height;
    FileNumber ballast_factor;
    FileNumber second_factor; ///< ballast-lamp factor, future use, or file generation type
    FileNumber input_watts;
    std::vector<FileNumber> vertical;   ///< degrees
    std::vector<FileNumber> horizontal; ///< degrees
    std::vector<FileNumber> candela;    ///< vertical fastest, as stored, without any factor
};

/// Text of a keyword with all its [MORE] lines, joined by blanks; empty if absent.
[[nodiscard]] std::string find_text(const IesDocument& document, std::string_view keyword);

/// Linear between the pairs, the end values beyond them.
[[nodiscard]] double tilt_factor(const IesTilt& tilt, Angle angle) noexcept;

/// @throws InputError  with `source:line` of whatever makes the file unreadable
[[nodiscard]] Parsed<IesDocument> parse_ies(std::string_view bytes, std::string_view source);
[[nodiscard]] IesDocument parse_ies(const SourceText& text, Findings& findings);

/// Our units and conventions: factors applied, symmetry expanded, types A and B turned into the
/// frame of type C, opening placed with its length along x.
/// @throws InputError
[[nodiscard]] Parsed<LuminairePhotometry> to_photometry(const IesDocument& document,
                                                        const PhotometryOptions& options = {});
[[nodiscard]] LuminairePhotometry to_photometry(const IesDocument& document,
                                                const PhotometryOptions& options,
                                                Findings& findings);

/// The four records of a tilt file or of TILT=INCLUDE. @throws InputError
[[nodiscard]] IesTilt parse_tilt_file(std::string_view bytes, std::string_view source);

} // namespace isolux
