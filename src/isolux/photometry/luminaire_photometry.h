#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/photometry/intensity_distribution.h"

namespace isolux {

enum class PhotometricFormat {
    lm63_1986,
    lm63_1991,
    lm63_1995,
    lm63_2002,
    lm63_2019,
    eulumdat,
    tm33,
    gldf
};

[[nodiscard]] std::string to_string(PhotometricFormat format);

/// The luminous opening, in the luminaire's own frame, centred on the photometric centre.
enum class OpeningShape {
    point,
    rectangle,         ///< flat, x by y
    box,               ///< luminous sides: x by y by z
    ellipse,           ///< flat; a circle when x == y
    vertical_cylinder, ///< elliptic when x != y; axis z
    cylinder_along_x,  ///< horizontal cylinder whose axis is x
    cylinder_along_y,  ///< horizontal cylinder whose axis is y
    ellipsoid,         ///< a sphere when x == y == z
    vertical_ellipse,  ///< flat, upright, faces +x ("photometric horizontal"); y by z
};

[[nodiscard]] std::string to_string(OpeningShape shape);

struct LuminousOpening {
    OpeningShape shape = OpeningShape::point;
    Metre extent_x;
    Metre extent_y;
    Metre extent_z;
};

struct LampSet {
    int lamps = 1; ///< negative: absolute photometry
    std::string type;
    Lumen flux; ///< of the whole set; 0 where the file tells none
    std::string colour;
    std::string colour_rendering;
    double watts = 0.0; ///< including control gear
};

/// What a LM-63 file says under a keyword that has no field here.
struct PhotometryLabel {
    std::string keyword; ///< upper case, without brackets
    std::string text;
};

/// One luminaire's photometry in our units and conventions; from here nobody can tell whether
/// it came from LM-63 or EULUMDAT. Candelas are absolute, after every factor the file asks for.
struct LuminairePhotometry {
    PhotometricFormat format = PhotometricFormat::lm63_2002;
    char photometric_type = 'C'; ///< 'A', 'B' or 'C' as in the file
    std::string symmetry;        ///< in words: "rotational", "quadrant", "bilateral 0-180", ...
    std::size_t planes_in_file = 0;
    std::size_t gammas_in_file = 0;
    std::string manufacturer;
    std::string name;
    std::string catalogue_number;
    std::string report = {};         ///< number of the test report
    std::string laboratory = {};     ///< who measured
    std::string date = {};           ///< as the file writes it
    std::string contained_file = {}; ///< GLDF: the file in the container that has the light
    IntensityDistribution distribution;
    LuminousOpening opening; ///< placed as METHODS says: LM-63 length along x, EULUMDAT along y
    LuminousOpening housing; ///< body; the opening again where the file tells no more
    bool is_absolute = false;
    std::optional<Lumen> declared_flux; ///< of the luminaire, where the file declares one
    std::vector<LampSet> lamp_sets;     ///< alternatives, never added up
    std::size_t lamp_set = 0;           ///< the one that lights the table
    double input_watts = 0.0;
    /// EULUMDAT: luminous height of the opening's sides seen from C0, C90, C180, C270
    /// (`opening` is as high as the largest of them).
    std::optional<std::array<Metre, 4>> side_heights = std::nullopt;
    std::vector<PhotometryLabel> other_labels = {}; ///< LM-63, in the order of the file
};

} // namespace isolux
