#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "isolux/base/estimate.h"
#include "isolux/calc/judge.h"

struct lxw_format;
struct lxw_workbook;
struct lxw_worksheet;

namespace isolux {

/// Cuts UTF-8 text to so many characters.
[[nodiscard]] std::string cut_text(const std::string& text, std::size_t characters);

/// An Excel workbook on its way to a file, and its formats. Its sheets are filled one after the
/// other and row by row: where rows are many they need not stay in memory, but wait in
/// temporary files beside the workbook.
class Workbook {
public:
    /// @param sheets, rows  about as many as there will be
    Workbook(const std::filesystem::path& file, std::size_t sheets, std::size_t rows);
    ~Workbook();
    Workbook(const Workbook&) = delete;
    Workbook& operator=(const Workbook&) = delete;

    [[nodiscard]] lxw_format* head() const noexcept { return head_; }

    [[nodiscard]] lxw_format* number(int decimals);

    /// Words, never colour alone: the cell says "pass" and is green.
    [[nodiscard]] lxw_format* verdict(Decision d);

    /// @throws std::system_error
    lxw_worksheet* add_sheet(const std::string& name);

    void set_title(const std::string& title);

    /// Writes the file. @throws std::system_error
    void close();

private:
    lxw_workbook* book_ = nullptr;
    std::vector<lxw_worksheet*> sheets_;
    lxw_format* head_ = nullptr;
    std::map<int, lxw_format*> numbers_;
    std::map<Decision, lxw_format*> verdicts_;
};

/// Fills a sheet row by row.
class Sheet {
public:
    struct Column {
        const char* head;
        double width;
    };

    Sheet(Workbook& book, const std::string& name, const std::vector<Column>& columns);

    void next_row() {
        ++row_;
        column_ = 0;
    }

    Sheet& text(const std::string& t, lxw_format* format = nullptr);

    /// With the decimals that the error deserves. What is no number leaves the cell empty.
    Sheet& number(double value, double error);

    Sheet& plain(double value, int decimals);

    Sheet& skip() {
        ++column_;
        return *this;
    }

    /// Value, standard error and both ends of the interval.
    Sheet& estimate(const Estimate& e, double confidence);

private:
    Workbook& book_;
    lxw_worksheet* sheet_;
    std::uint32_t row_ = 0;
    std::uint16_t column_ = 0;
};

} // namespace isolux
