#include "isolux/photometry/luminaire_photometry.h"

namespace isolux {

std::string to_string(PhotometricFormat format) {
    switch (format) {
    case PhotometricFormat::lm63_1986:
        return "LM-63-1986";
    case PhotometricFormat::lm63_1991:
        return "LM-63-1991";
    case PhotometricFormat::lm63_1995:
        return "LM-63-1995";
    case PhotometricFormat::lm63_2002:
        return "LM-63-2002";
    case PhotometricFormat::lm63_2019:
        return "LM-63-2019";
    case PhotometricFormat::eulumdat:
        return "EULUMDAT";
    case PhotometricFormat::tm33:
        return "TM-33";
    case PhotometricFormat::gldf:
        return "GLDF";
    }
    return "unknown format";
}

std::string to_string(OpeningShape shape) {
    switch (shape) {
    case OpeningShape::point:
        return "point";
    case OpeningShape::rectangle:
        return "rectangle";
    case OpeningShape::box:
        return "box";
    case OpeningShape::ellipse:
        return "ellipse";
    case OpeningShape::vertical_cylinder:
        return "vertical cylinder";
    case OpeningShape::cylinder_along_x:
        return "cylinder along x";
    case OpeningShape::cylinder_along_y:
        return "cylinder along y";
    case OpeningShape::ellipsoid:
        return "ellipsoid";
    case OpeningShape::vertical_ellipse:
        return "vertical ellipse";
    }
    return "unknown shape";
}

} // namespace isolux
