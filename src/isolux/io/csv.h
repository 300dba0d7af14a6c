#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "isolux/calc/results.h"

namespace isolux {

/// The points of a surface as CSV (RFC 4180: comma, CRLF, quotes where needed). One header row
/// with the units, then one row a point in the order of the surface's receivers:
/// `x_m,y_m,z_m,nx,ny,nz,illuminance_lx,standard_error_lx,lower_lx,upper_lx,direct_lx,
/// indirect_lx,flags`; the value's column is named after the quantity
/// (`cylindrical_illuminance_lx`). Decimal point, as many digits as a double needs to be read
/// back exactly; flags are words with spaces between.
/// @param confidence  two-sided, of lower and upper
[[nodiscard]] std::string to_csv(const SurfaceResult& result, double confidence);

/// The summaries of all surfaces: `surface,quantity,unit,value,standard_error,lower,upper,
/// replicates`, the quantities of a surface (mean, minimum, maximum, U0, Ud) below each other;
/// U0 and Ud have the unit "1".
[[nodiscard]] std::string to_summary_csv(const Results& results);

inline constexpr const char* sensitivities_table = "sensitivities.csv";

/// The derivatives of a calculation: `surface,point,x_m,y_m,z_m,material,reflectance,
/// derivative_lx,standard_error_lx`. For each surface and material first the derivative of the
/// surface's mean (`point` is "mean", without a position), then a row a point, counted from 1.
/// @pre results.sensitivities
[[nodiscard]] std::string to_sensitivities_csv(const Results& results);

/// One record of a CSV file and the line it began on.
struct CsvRecord {
    int line = 1;
    std::vector<std::string> fields;
};

/// Parses RFC 4180 text; bare LF line ends are taken as well, empty lines are skipped.
/// @throws InputError  `source:line: ...` for a quote that is never closed or text after one
[[nodiscard]] std::vector<CsvRecord> parse_csv(std::string_view text, std::string_view source);

/// The shortest decimal text that reads back as the same double: "0.1", "1e-09", "500".
[[nodiscard]] std::string to_shortest(double value);

} // namespace isolux
