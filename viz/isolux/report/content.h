#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "isolux/viz/drawing.h"

/// What a report says, before it becomes HTML or PDF. Both painters show the same content.
namespace isolux::report {

/// A colour with a word beside it; never a colour alone.
enum class Mark { none, pass, fail, undecided, not_judged };

struct Cell {
    std::string text;
    std::optional<double> exact = std::nullopt; ///< the unrounded number `text` shows
    Mark mark = Mark::none;
};

struct Column {
    std::string title;
    bool is_number = false; ///< aligned at the right
};

/// Maps and plans of a report are drawn with a frame of at most this many mm, so that A4 shows
/// their letters at nearly their own size.
inline constexpr double widest_map = 128.0;

/// A real table; the first cell of a row is its header.
struct Table {
    std::string caption;
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows; ///< as many cells as columns each
    bool is_small = false;               ///< long lists of numbers
};

/// Names and values without a header row.
struct FactList {
    std::string caption;
    std::vector<std::vector<Cell>> rows; ///< name, value
};

struct Paragraph {
    std::string text;
    Mark mark = Mark::none; ///< shown as a box of that colour
    bool is_small = false;
};

struct Figure {
    Drawing drawing;
    std::string alternative; ///< for who cannot see it
    std::string caption;
    double largest_width = 170.0;  ///< mm, on paper
    double largest_height = 215.0; ///< mm, on paper
};

struct Photograph {
    std::string png;
    std::string alternative;
    std::string caption;
};

/// A small picture with its figures beside it.
struct FactSheet {
    Figure figure;
    FactList facts;
};

struct Subheading {
    std::string text;
};

using Block =
    std::variant<Paragraph, Table, FactList, Figure, Photograph, FactSheet, Subheading>;

struct Section {
    std::string id; ///< letters, digits, hyphens
    std::string title;
    std::vector<Block> blocks;
    bool starts_page = true; ///< on paper; false: goes on below the section before it
    bool keeps_head = false; ///< on paper title to first figure, or all, stay on one page
};

struct Report {
    std::string language; ///< BCP 47
    std::string title;
    std::string kind; ///< what it is a report of, above the title
    std::string lead; ///< below the title
    FactList cover;
    std::string contents_title;
    std::vector<Section> sections;
    std::string footer; ///< on every page
};

} // namespace isolux::report
