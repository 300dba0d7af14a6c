#include "isolux/io/workbook.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <system_error>
#include <utility>

#include <sys/resource.h>
#include <xlsxwriter.h>

namespace isolux {

namespace {

/// Decimals that two digits of an error need, 0 to 4.
int decimals_of(double error) {
    if (!(error > 0.0))
        return 2;
    return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 4);
}

/// Fewer rows than these may stay in memory.
constexpr std::size_t many_rows = 10000;

/// Rows may wait in files, one for each sheet and all open at a time.
constexpr std::size_t most_sheets_in_files = 200;

/// ... and no more than a quarter of the files that the process may open.
std::size_t files_to_spare() noexcept {
    rlimit limit{};
    return getrlimit(RLIMIT_NOFILE, &limit) == 0
               ? std::min<std::size_t>(most_sheets_in_files, limit.rlim_cur / 4)
               : 0;
}

} // namespace

std::string cut_text(const std::string& text, std::size_t characters) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U && ++count > characters)
            return text.substr(0, i);
    return text;
}

Workbook::Workbook(const std::filesystem::path& file, std::size_t sheets, std::size_t rows) {
    std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
    lxw_workbook_options options{};
    const bool are_many = rows >= many_rows && sheets <= files_to_spare();
    options.constant_memory = are_many ? LXW_TRUE : LXW_FALSE;
    options.tmpdir = folder.data();
    book_ = workbook_new_opt(file.c_str(), &options);
    head_ = workbook_add_format(book_);
    format_set_bold(head_);
    format_set_text_wrap(head_);
    format_set_align(head_, LXW_ALIGN_VERTICAL_TOP);
    format_set_bottom(head_, LXW_BORDER_THIN);
}

Workbook::~Workbook() {
    if (book_ == nullptr)
        return;
    for (lxw_worksheet* sheet : sheets_) // the library closes these only where it ends well
        if (sheet->optimize_tmpfile != nullptr)
            std::fclose(sheet->optimize_tmpfile);
    lxw_workbook_free(book_);
}

lxw_format* Workbook::number(int decimals) {
    lxw_format*& format = numbers_[decimals];
    if (format == nullptr) {
        format = workbook_add_format(book_);
        const std::string form =
            decimals > 0 ? "0." + std::string(static_cast<std::size_t>(decimals), '0') : "0";
        format_set_num_format(format, form.c_str());
    }
    return format;
}

lxw_format* Workbook::verdict(Decision d) {
    lxw_format*& format = verdicts_[d];
    if (format == nullptr) {
        format = workbook_add_format(book_);
        format_set_bold(format);
        format_set_bg_color(format,
                            d == Decision::pass        ? 0xC6E5C3
                            : d == Decision::fail      ? 0xF4C2BE
                            : d == Decision::undecided ? 0xD9D9D9
                                                       : 0xFFFFFF);
    }
    return format;
}

lxw_worksheet* Workbook::add_sheet(const std::string& name) {
    lxw_worksheet* sheet = workbook_add_worksheet(book_, name.c_str());
    if (sheet == nullptr)
        throw std::system_error(std::make_error_code(std::errc::io_error));
    sheets_.push_back(sheet);
    return sheet;
}

void Workbook::set_title(const std::string& title) {
    lxw_doc_properties properties{};
    std::string text = cut_text(title, 200);
    std::string company = "isolux";
    properties.title = text.data();
    properties.author = company.data();
    constexpr time_t fixed = 1'577'836'800; // so that equal results are equal files
    properties.created = fixed;
    workbook_set_properties(book_, &properties);
}

void Workbook::close() {
    const auto is_lost = [](const lxw_worksheet* sheet) { // the library does not look
        FILE* rows = sheet->optimize_tmpfile;
        return rows != nullptr && (std::fflush(rows) != 0 || std::ferror(rows) != 0);
    };
    if (std::ranges::any_of(sheets_, is_lost)
        || workbook_close(std::exchange(book_, nullptr)) != LXW_NO_ERROR)
        throw std::system_error(std::make_error_code(std::errc::io_error));
}

Sheet::Sheet(Workbook& book, const std::string& name, const std::vector<Column>& columns)
    : book_(book), sheet_(book.add_sheet(name)) {
    for (const Column& c : columns) {
        worksheet_set_column(sheet_, column_, column_, c.width, nullptr);
        worksheet_write_string(sheet_, 0, column_++, c.head, book.head());
    }
    worksheet_freeze_panes(sheet_, 1, 0);
    worksheet_repeat_rows(sheet_, 0, 0);
    worksheet_set_landscape(sheet_);
    worksheet_set_paper(sheet_, 9); // A4
    worksheet_fit_to_pages(sheet_, 1, 0);
    next_row();
}

Sheet& Sheet::text(const std::string& t, lxw_format* format) {
    worksheet_write_string(sheet_, row_, column_++, cut_text(t, 32000).c_str(), format);
    return *this;
}

Sheet& Sheet::number(double value, double error) { return plain(value, decimals_of(error)); }

Sheet& Sheet::plain(double value, int decimals) {
    if (std::isfinite(value))
        worksheet_write_number(sheet_, row_, column_, value, book_.number(decimals));
    ++column_;
    return *this;
}

Sheet& Sheet::estimate(const Estimate& e, double confidence) {
    if (e.samples == 0)
        return skip().skip().skip().skip();
    const Interval i = confidence_interval(e, confidence);
    return number(e.mean, e.standard_error)
        .number(e.standard_error, e.standard_error)
        .number(i.lower, e.standard_error)
        .number(i.upper, e.standard_error);
}

} // namespace isolux
