#pragma once

#include <filesystem>
#include <vector>

#include "isolux/report/make_report.h"

namespace isolux::report {

/// The pictures in `folder`/views, by name.
/// @throws InputError  for one that cannot be read
[[nodiscard]] std::vector<View> find_views(const std::filesystem::path& folder);

/// Writes report.html and report.pdf into a results folder. @throws WriteError
void write_reports(const std::filesystem::path& folder, const ResultsDocument& document);

/// Writes one report in the format the name ends in: .html or .pdf (in any letter case).
/// @param folder  where the views lie
/// @throws InputError  for another ending
/// @throws WriteError
void write_report(const std::filesystem::path& file,
                  const ResultsDocument& document,
                  const std::filesystem::path& folder);

} // namespace isolux::report
