#include <algorithm>
#include <numeric>

#include "isolux/report/page_writer.h"

namespace isolux::report {

namespace {

constexpr double padding = 1.2;       // mm beside a cell's text
constexpr double tight_padding = 0.6; // in tables of two columns
constexpr double column_gap = 6.0;
constexpr double half_width = 0.5 * (PageWriter::text_width - column_gap);
const Stroke head_line{ink::black, 0.35, 0.0};
const Stroke row_line{ink::light_grey, 0.15, 0.0};

/// A cell's lines of text and where they go.
void write_lines(PageWriter& writer,
                 const std::vector<std::string>& lines,
                 const Box& box,
                 double size,
                 bool is_number,
                 Weight weight,
                 Colour colour,
                 double beside = padding) {
    double y = box.y + size;
    for (const std::string& line : lines) {
        const double x = is_number ? box.right() - beside : box.x + beside;
        writer.add(make_text(
            line, {x, y}, size, is_number ? Anchor::end : Anchor::start, weight, colour));
        y += PageWriter::line_space * size;
    }
}

/// Letters and the white beside them.
struct Setting {
    double size = 2.6; // mm
    double padding = report::padding;
    double spacing = 0.9; // above and below a row
};

enum class Titles { whole, broken };

std::vector<double> natural_widths(const PageWriter& writer,
                                   const Table& t,
                                   const Setting& setting,
                                   Titles titles) {
    std::vector<double> widths(t.columns.size(), 0.0);
    for (std::size_t k = 0; k < t.columns.size(); ++k) {
        const auto measure = [&](const std::string& text, Weight weight) {
            widths[k] = std::max(widths[k],
                                 writer.ruler().width(text, setting.size, weight)
                                     + 2.0 * setting.padding + 0.2);
        };
        const std::string& title = t.columns[k].title;
        for (std::size_t at = 0; at < title.size();) {
            const std::size_t end = titles == Titles::whole
                                        ? title.size()
                                        : std::min(title.find(' ', at), title.size());
            measure(title.substr(at, end - at), Weight::bold);
            at = end + 1;
        }
        for (const std::vector<Cell>& row : t.rows)
            measure(row[k].text, row[k].mark == Mark::none ? Weight::normal : Weight::bold);
    }
    return widths;
}

double sum_of(const std::vector<double>& widths) {
    return std::accumulate(widths.begin(), widths.end(), 0.0);
}

/// Natural widths where they fit; else titles break, then the wide text columns give way.
std::vector<double>
column_widths(const PageWriter& writer, const Table& t, const Setting& setting, double room) {
    std::vector<double> widths = natural_widths(writer, t, setting, Titles::whole);
    if (sum_of(widths) <= room)
        return widths;
    widths = natural_widths(writer, t, setting, Titles::broken);
    double sum = sum_of(widths);
    while (sum > room) {
        auto widest = std::max_element(widths.begin(), widths.end());
        double second = 0.0;
        for (auto w = widths.begin(); w != widths.end(); ++w)
            if (w != widest)
                second = std::max(second, *w);
        const double target = std::max({*widest - (sum - room), 0.97 * second - 0.5, 4.0});
        if (target >= *widest)
            break;
        sum += target - *widest;
        *widest = target;
    }
    return widths;
}

/// Long, narrow lists of numbers stand in two columns.
bool fits_half(const PageWriter& writer, const Table& t, const Setting& setting) {
    constexpr std::size_t long_list = 14;
    return t.is_small && t.rows.size() > long_list
           && sum_of(natural_widths(writer, t, setting, Titles::broken)) <= half_width;
}

class TableWriter {
public:
    TableWriter(PageWriter& writer, const Table& table) : writer_(writer), table_(table) {
        const Setting half{2.0, tight_padding, 0.3};
        in_two_ = fits_half(writer, table, half);
        if (in_two_)
            setting_ = half;
        else if (table.is_small)
            setting_ = {2.1, padding, 0.35};
        widths_ = column_widths(
            writer, table, setting_, in_two_ ? half_width : PageWriter::text_width);
    }

    void write() {
        writer_.reserve(first_part());
        writer_.write(table_.caption, 2.9, Weight::bold);
        writer_.skip(0.8);
        if (in_two_) {
            write_in_two();
        } else {
            write_head();
            for (const std::vector<Cell>& row : table_.rows)
                write_row(row);
        }
        writer_.skip(4.0);
    }

private:
    /// What must not be torn apart: short tables, and the start of long ones.
    [[nodiscard]] double first_part() const {
        constexpr double highest = 90.0; // mm
        double all = 6.0 + height_of(titles(), Weight::bold);
        for (const std::vector<Cell>& row : table_.rows)
            all += height_of(row, Weight::normal);
        return all <= highest ? all : 8.0 * PageWriter::line_space * setting_.size + 6.0;
    }

    [[nodiscard]] std::vector<Cell> titles() const {
        std::vector<Cell> cells;
        for (const Column& c : table_.columns)
            cells.push_back({c.title});
        return cells;
    }

    void write_head() { put(titles(), Weight::bold, head_line); }

    void write_row(const std::vector<Cell>& row) {
        if (height_of(row, Weight::normal) > writer_.left_over()) {
            writer_.new_page();
            write_head();
        }
        put(row, Weight::normal, row_line);
    }

    /// Down the left half of a page, then down its right half.
    void write_in_two() {
        const double head = height_of(titles(), Weight::bold);
        const double row = PageWriter::line_space * setting_.size + 2.0 * setting_.spacing;
        const std::size_t all = table_.rows.size();
        for (std::size_t first = 0; first < all;) {
            const double room = writer_.left_over() - head;
            const auto fitting = static_cast<std::size_t>(std::max(room / row, 1.0));
            const std::size_t rows = std::min(fitting, (all - first + 1) / 2);
            const double top = writer_.y();
            double lowest = top;
            for (const double x : {0.0, half_width + column_gap}) {
                writer_.skip(top - writer_.y());
                left_ = PageWriter::left + x;
                write_head();
                for (std::size_t k = 0; k < rows && first < all; ++k, ++first)
                    put(table_.rows[first], Weight::normal, row_line);
                lowest = std::max(lowest, writer_.y());
            }
            writer_.skip(lowest - writer_.y());
            if (first < all)
                writer_.new_page();
        }
    }

    [[nodiscard]] double height_of(const std::vector<Cell>& row, Weight weight) const {
        std::size_t lines = 1;
        for (std::size_t k = 0; k < row.size(); ++k)
            lines = std::max(lines, wrapped(row, k, weight).size());
        return PageWriter::line_space * setting_.size * static_cast<double>(lines)
               + 2.0 * setting_.spacing;
    }

    [[nodiscard]] std::vector<std::string>
    wrapped(const std::vector<Cell>& row, std::size_t k, Weight weight) const {
        return writer_.wrap(row[k].text,
                            widths_[k] - 2.0 * setting_.padding,
                            setting_.size,
                            row[k].mark == Mark::none ? weight : Weight::bold);
    }

    void put(const std::vector<Cell>& row, Weight weight, const Stroke& below) {
        const double height = height_of(row, weight);
        const double spacing = setting_.spacing;
        double x = left_;
        for (std::size_t k = 0; k < row.size(); ++k) {
            const Box box{x, writer_.y() + spacing, widths_[k], height - 2.0 * spacing};
            Colour colour = ink::black;
            Weight face = weight;
            if (row[k].mark != Mark::none) {
                Shape field = make_rectangle(box);
                field.fill = ink_of(row[k].mark).fill;
                field.stroke = Stroke{ink_of(row[k].mark).line, 0.2};
                writer_.add(std::move(field));
                colour = ink_of(row[k].mark).text;
                face = Weight::bold;
            }
            write_lines(writer_,
                        wrapped(row, k, weight),
                        box,
                        setting_.size,
                        table_.columns[k].is_number,
                        face,
                        colour,
                        setting_.padding);
            x += widths_[k];
        }
        writer_.skip(height);
        writer_.add(make_line({{left_, writer_.y()}, {x, writer_.y()}}, below));
    }

    PageWriter& writer_;
    const Table& table_;
    Setting setting_;
    std::vector<double> widths_;
    double left_ = PageWriter::left; ///< mm, where rows begin
    bool in_two_ = false;
};

} // namespace

void write_table(PageWriter& writer, const Table& table) { TableWriter(writer, table).write(); }

void write_facts(PageWriter& writer, const FactList& facts, double x, double box_width) {
    constexpr double size = 2.6;
    double names = 0.0;
    for (const std::vector<Cell>& row : facts.rows)
        names = std::max(names, writer.ruler().width(row[0].text, size, Weight::normal));
    names = std::min(names + 5.0, 0.45 * box_width);
    if (!facts.caption.empty()) {
        writer.add(
            make_text(facts.caption, {x, writer.y() + 2.9}, 2.9, Anchor::start, Weight::bold));
        writer.skip(5.0);
    }
    for (const std::vector<Cell>& row : facts.rows) {
        const auto left = writer.wrap(row[0].text, names - 2.0, size, Weight::normal);
        const auto right = writer.wrap(row[1].text, box_width - names, size, Weight::normal);
        const double height = PageWriter::line_space * size
                                  * static_cast<double>(std::max(left.size(), right.size()))
                              + 1.2;
        writer.reserve(height);
        write_lines(writer,
                    left,
                    {x - padding, writer.y(), names, height},
                    size,
                    false,
                    Weight::normal,
                    ink::grey);
        write_lines(writer,
                    right,
                    {x + names - padding, writer.y(), box_width - names, height},
                    size,
                    false,
                    Weight::normal,
                    ink::black);
        writer.skip(height);
    }
}

} // namespace isolux::report
