#pragma once

#include <string>
#include <vector>

#include "isolux/report/content.h"
#include "isolux/viz/drawing_parts.h"

namespace isolux::report {

/// A column of text on A4 pages that starts a new page when one is full.
class PageWriter {
public:
    static constexpr double width = 210.0; ///< mm
    static constexpr double height = 297.0;
    static constexpr double left = 20.0;
    static constexpr double top = 18.0;
    static constexpr double bottom = 275.0;
    static constexpr double text_width = width - left - 18.0;

    /// Pages that follow bear this title in the PDF's bookmarks.
    void begin_section(const std::string& title);

    /// The section goes on below the one before it, if `needed` mm of the page are left.
    void join_section(const std::string& title, double needed);

    /// A new page, unless this one is still empty.
    void new_page();

    /// Makes sure that `needed` mm are left on the page.
    void reserve(double needed);

    void skip(double mm) { y_ += mm; }

    [[nodiscard]] double y() const noexcept { return y_; }

    [[nodiscard]] double left_over() const noexcept { return bottom - y_; }

    [[nodiscard]] bool is_at_top() const noexcept { return y_ <= top + 1e-9; }

    [[nodiscard]] const FontRuler& ruler() const noexcept { return ruler_; }

    template <class Item> void add(Item item) { page().items.emplace_back(std::move(item)); }

    /// Text broken into lines, from the cursor on.
    void write(const std::string& text,
               double size,
               Weight weight = Weight::normal,
               Colour colour = ink::black);

    /// `text` in lines that fit `line_width` mm; words longer than a line are cut.
    [[nodiscard]] std::vector<std::string>
    wrap(const std::string& text, double line_width, double size, Weight weight) const;

    /// All pages with `footer` and their numbers.
    [[nodiscard]] std::vector<Drawing> finish(const std::string& footer) &&;

    static constexpr double line_space = 1.4; ///< in text sizes

private:
    [[nodiscard]] Drawing& page();

    std::vector<Drawing> pages_;
    std::string section_;
    double y_ = top;
    FontRuler ruler_;
};

/// Fill and line of a mark.
struct MarkInk {
    Colour text;
    Colour fill;
    Colour line;
};

[[nodiscard]] MarkInk ink_of(Mark mark);

/// Draws a table from the writer's cursor on.
void write_table(PageWriter& writer, const Table& table);

/// Draws names and values within `box_width` mm from `x`, from the cursor on; the cursor moves
/// below the list.
void write_facts(PageWriter& writer, const FactList& facts, double x, double box_width);

} // namespace isolux::report
