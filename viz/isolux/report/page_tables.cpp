#include <algorithm>
#include <numeric>

#include "isolux/report/page_writer.h"

namespace isolux::report {

namespace {

constexpr double padding = 1.2; // mm beside a cell's text
const Stroke head_line{ink::black, 0.35, 0.0};
const Stroke row_line{ink::light_grey, 0.15, 0.0};

/// A cell's lines of text and where they go.
void write_lines(PageWriter& writer,
                 const std::vector<std::string>& lines,
                 const Box& box,
                 double size,
                 bool is_number,
                 Weight weight,
                 Colour colour) {
    double y = box.y + size;
    for (const std::string& line : lines) {
        const double x = is_number ? box.right() - padding : box.x + padding;
        writer.add(make_text(
            line, {x, y}, size, is_number ? Anchor::end : Anchor::start, weight, colour));
        y += PageWriter::line_space * size;
    }
}

/// Natural widths where they fit; else the wide text columns give way.
std::vector<double>
column_widths(const PageWriter& writer, const Table& t, double size, double room) {
    std::vector<double> widths(t.columns.size(), 0.0);
    for (std::size_t k = 0; k < t.columns.size(); ++k) {
        const auto measure = [&](const std::string& text, Weight weight) {
            widths[k] = std::max(
                widths[k], writer.ruler().width(text, size, weight) + 2.0 * padding + 0.2);
        };
        for (std::size_t at = 0; at < t.columns[k].title.size();) { // titles may break
            const std::size_t end =
                std::min(t.columns[k].title.find(' ', at), t.columns[k].title.size());
            measure(t.columns[k].title.substr(at, end - at), Weight::bold);
            at = end + 1;
        }
        for (const std::vector<Cell>& row : t.rows)
            measure(row[k].text, row[k].mark == Mark::none ? Weight::normal : Weight::bold);
    }
    double sum = std::accumulate(widths.begin(), widths.end(), 0.0);
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

class TableWriter {
public:
    TableWriter(PageWriter& writer, const Table& table)
        : writer_(writer), table_(table), size_(table.is_small ? 2.1 : 2.6),
          widths_(column_widths(writer, table, size_, PageWriter::text_width)) {}

    void write() {
        writer_.reserve(8.0 * PageWriter::line_space * size_);
        writer_.write(table_.caption, 2.9, Weight::bold);
        writer_.skip(0.8);
        write_head();
        for (const std::vector<Cell>& row : table_.rows)
            write_row(row);
        writer_.skip(4.0);
    }

private:
    [[nodiscard]] double spacing() const { return table_.is_small ? 0.35 : 0.9; }

    void write_head() {
        std::vector<Cell> titles;
        for (const Column& c : table_.columns)
            titles.push_back({c.title});
        put(titles, Weight::bold, head_line);
    }

    void write_row(const std::vector<Cell>& row) {
        if (height_of(row, Weight::normal) > writer_.left_over()) {
            writer_.new_page();
            write_head();
        }
        put(row, Weight::normal, row_line);
    }

    [[nodiscard]] double height_of(const std::vector<Cell>& row, Weight weight) const {
        std::size_t lines = 1;
        for (std::size_t k = 0; k < row.size(); ++k)
            lines = std::max(lines, wrapped(row, k, weight).size());
        return PageWriter::line_space * size_ * static_cast<double>(lines) + 2.0 * spacing();
    }

    [[nodiscard]] std::vector<std::string>
    wrapped(const std::vector<Cell>& row, std::size_t k, Weight weight) const {
        return writer_.wrap(row[k].text,
                            widths_[k] - 2.0 * padding,
                            size_,
                            row[k].mark == Mark::none ? weight : Weight::bold);
    }

    void put(const std::vector<Cell>& row, Weight weight, const Stroke& below) {
        const double height = height_of(row, weight);
        double x = PageWriter::left;
        for (std::size_t k = 0; k < row.size(); ++k) {
            const Box box{x, writer_.y() + spacing(), widths_[k], height - 2.0 * spacing()};
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
                        size_,
                        table_.columns[k].is_number,
                        face,
                        colour);
            x += widths_[k];
        }
        writer_.skip(height);
        writer_.add(make_line({{PageWriter::left, writer_.y()}, {x, writer_.y()}}, below));
    }

    PageWriter& writer_;
    const Table& table_;
    double size_;
    std::vector<double> widths_;
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
