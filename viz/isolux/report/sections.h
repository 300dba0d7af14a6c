#pragma once

#include "isolux/report/make_report.h"

/// The sections of a report, one source file each.
namespace isolux::report {

/// @pre there are verdicts
[[nodiscard]] Section make_verdict_section(const ResultsDocument& document, const Texts& t);
[[nodiscard]] Section make_overview(const ResultsDocument& document, const Texts& t);
[[nodiscard]] Section make_luminaire_section(const ResultsDocument& document, const Texts& t);
[[nodiscard]] Section make_room_section(const ResultsDocument& document, const Texts& t);

/// @param index  which of the surfaces
[[nodiscard]] Section
make_surface_section(const ResultsDocument& document, std::size_t index, const Texts& t);

[[nodiscard]] Section make_glare_section(const ResultsDocument& document, const Texts& t);
[[nodiscard]] Section make_energy_section(const ResultsDocument& document, const Texts& t);
[[nodiscard]] Section make_scene_section(const ResultsDocument& document, const Texts& t);
[[nodiscard]] Section make_view_section(const std::vector<View>& views, const Texts& t);
[[nodiscard]] Section make_method_section(const ResultsDocument& document,
                                          const std::optional<SelftestRecord>& self_test,
                                          const Texts& t);

/// The verdicts as a table: place, requirement, limit, value, interval, margin, word.
[[nodiscard]] Table
make_verdict_table(const std::vector<Verdict>& verdicts, std::string caption, const Texts& t);

/// A pattern of Texts with its values.
[[nodiscard]] std::string fill(const std::string& pattern,
                               const std::vector<std::string>& values);

} // namespace isolux::report
