#include "isolux/report/report_files.h"

#include <algorithm>
#include <cctype>

#include "isolux/base/error.h"
#include "isolux/io/safe_file.h"
#include "isolux/io/text_file.h"
#include "isolux/report/html.h"
#include "isolux/report/pdf.h"

namespace isolux::report {

namespace fs = std::filesystem;

namespace {

std::string ending_of(const fs::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return ending;
}

} // namespace

std::vector<View> find_views(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code ignored; // no folder, no views
    for (const auto& entry : fs::directory_iterator(folder / "views", ignored))
        if (ending_of(entry.path()) == ".png")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<View> views;
    for (const fs::path& file : files)
        if (std::string png = read_file_bytes(file, FileLimits::picture); png_size(png))
            views.push_back({file.stem().string(), std::move(png)});
    return views;
}

void write_reports(const fs::path& folder, const ResultsDocument& document) {
    const Report report =
        make_report(document, find_views(folder), english(), find_selftest(folder));
    write_file_safely(folder / "report.html", to_html(report));
    write_file_safely(folder / "report.pdf", to_pdf_report(report));
}

void write_report(const fs::path& file,
                  const ResultsDocument& document,
                  const fs::path& folder) {
    const std::string ending = ending_of(file);
    if (ending != ".html" && ending != ".pdf")
        throw InputError(file.string(),
                         "no report format goes by this name",
                         "A name that ends in .html or .pdf?");
    const Report report =
        make_report(document, find_views(folder), english(), find_selftest(folder));
    write_file_safely(file, ending == ".html" ? to_html(report) : to_pdf_report(report));
}

} // namespace isolux::report
