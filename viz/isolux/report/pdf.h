#pragma once

#include <string>
#include <vector>

#include "isolux/report/content.h"

namespace isolux::report {

/// The report on A4 pages, upright: headings, tables that go on over pages with their heads
/// repeated, pictures, a footer with page numbers.
[[nodiscard]] std::vector<Drawing> lay_out(const Report& report);

/// The same as PDF with a bookmark for each section. @throws DeviceError  if cairo cannot
[[nodiscard]] std::string to_pdf_report(const Report& report);

} // namespace isolux::report
