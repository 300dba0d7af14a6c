#pragma once

#include <string>
#include <vector>

#include "isolux/io/results_json.h"
#include "isolux/io/selftest_file.h"
#include "isolux/report/content.h"
#include "isolux/report/texts.h"

namespace isolux::report {

/// A picture that lies in the results folder.
struct View {
    std::string name; ///< as the caption names it
    std::string png;
};

/// Everything a report says about a calculation, from results.json alone; pictures of views and
/// the outcome of a self-test are given beside it.
[[nodiscard]] Report make_report(const ResultsDocument& document,
                                 const std::vector<View>& views,
                                 const Texts& texts,
                                 const std::optional<SelftestRecord>& self_test = std::nullopt);

} // namespace isolux::report
