#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/photometry/file_number.h"
#include "isolux/photometry/luminaire_photometry.h"
#include "isolux/photometry/read_photometry.h"
#include "isolux/photometry/xml_tree.h"

/// ANSI/IES TM-33 (2018, 2023; also ATLA S001 and UNI 11733): a luminaire as XML.
///
///     <IESTM33-22>                          or LuminaireOpticalData, the name of S001
///       <Header> Manufacturer, CatalogNumber, Description, Laboratory, ReportNumber ...
///       <Luminaire><Dimensions> Length, Width, Height   of the body
///       <Emitter>                           one or more, each with its own light
///         Quantity, Description, RatedLumens, InputWattage, BallastFactor
///         <LuminousData><LuminousIntensity> Multiplier, NumberHorz, NumberVert
///           <IntData h="0" v="0">812</IntData>   one for every direction, any order
///         <EmissionAreas> BottomFace, C0Face ... the luminous faces
///
/// S001 calls the table IntensityDistribution with IntensityData elements (attributes h, v or
/// horz, vert). Only luminous intensity is read; radiant, photon and spectral data are not.
/// Angles are those of LM-63 type C. A face towards C0 is Length by Height, so the length lies
/// along C90-C270, as in EULUMDAT. Sizes are metres in IESTM33 files and millimetres in S001.
namespace isolux {

struct Tm33Value {
    FileNumber horizontal; ///< degrees
    FileNumber vertical;   ///< degrees
    FileNumber intensity;  ///< as stored, without any factor
};

struct Tm33Emitter {
    std::size_t line = 1;
    std::size_t table_line = 1;
    std::string description;
    std::string colour;
    std::string colour_rendering;
    FileNumber quantity{1.0, 0};
    std::optional<FileNumber> rated_lumens;
    std::optional<FileNumber> luminous_flux; ///< of the light that leaves
    FileNumber input_watts;
    FileNumber ballast_factor{1.0, 0};
    FileNumber multiplier{1.0, 0};
    bool is_absolute = false;
    bool is_per_kilolumen = false; ///< S001 with Units "cd/klm"
    std::vector<Tm33Value> values;
};

/// A luminous face, metres after the file's unit is known.
struct Tm33Face {
    double along_y = 0.0; ///< Length (or the width of a face towards C90)
    double across = 0.0;  ///< Width or Height
    bool is_circular = false;
};

/// A TM-33 file, faithful except that sizes are metres.
struct Tm33Document {
    std::string manufacturer, catalogue_number, description, laboratory, report, date;
    double length = 0.0, width = 0.0, height = 0.0; ///< m, of the body
    std::optional<Tm33Face> horizontal_face;        ///< bottom, or top where there is no bottom
    std::array<double, 4> side_heights{}; ///< m, of the faces towards C0, C90, C180, C270
    bool states_faces = false;
    std::vector<Tm33Emitter> emitters; ///< those with luminous intensity
};

/// @throws InputError
[[nodiscard]] Tm33Document parse_tm33(const SourceText& text, Findings& findings);

/// All emitters at full power, added up; a notice says so where there are several.
/// @throws InputError
[[nodiscard]] LuminairePhotometry to_photometry(const Tm33Document& document,
                                                const PhotometryOptions& options,
                                                Findings& findings);

} // namespace isolux
