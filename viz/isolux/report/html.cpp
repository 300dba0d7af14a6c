#include "isolux/report/html.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace isolux::report {

namespace {

constexpr std::string_view style = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.2rem; max-width: 62rem; color: #1a1a1a; background: #fff;
  font: 1rem/1.5 "DejaVu Sans", Verdana, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 2rem; line-height: 1.2; margin: 0.2rem 0 0.6rem; }
h2 { font-size: 1.4rem; margin: 2.4rem 0 0.8rem; padding-bottom: 0.2rem; border-bottom: 2px solid #1a1a1a; }
h3 { font-size: 1.1rem; margin: 1.6rem 0 0.5rem; }
a { color: #004f91; }
.kind { color: #555; margin: 0; letter-spacing: 0.04em; }
.lead { font-size: 1.1rem; max-width: 45rem; }
.small { font-size: 0.85rem; color: #444; }
.scroll { overflow-x: auto; margin: 0.8rem 0; }
table { border-collapse: collapse; font-size: 0.9rem; overflow-wrap: normal; }
caption { text-align: left; font-weight: bold; padding: 0 0 0.3rem; }
th, td { padding: 0.25rem 0.6rem; text-align: left; vertical-align: top; border-bottom: 1px solid #ccc; }
thead th { border-bottom: 2px solid #1a1a1a; vertical-align: bottom; }
tbody th { font-weight: normal; }
.list th { color: #444; min-width: 8rem; }
.list td { overflow-wrap: anywhere; }
.long { font-size: 0.78rem; }
.broad { min-width: 58rem; }
.long th, .long td { padding: 0.1rem 0.5rem; }
th.n, td.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
figure { margin: 1rem 0; }
figure img { display: block; width: 100%; height: auto; border: 1px solid #ddd; }
figcaption { font-size: 0.85rem; color: #444; }
.sheet { display: flex; flex-wrap: wrap; gap: 1rem 2rem; align-items: flex-start; margin: 0.8rem 0; }
.sheet figure { flex: 0 1 17rem; min-width: 14rem; margin: 0; }
.sheet > div { flex: 1 1 18rem; min-width: 0; margin: 0; }
.mark { font-weight: bold; padding: 0.05rem 0.45rem; border-radius: 0.2rem; border: 1px solid; white-space: nowrap; }
p.mark { white-space: normal; padding: 0.6rem 0.9rem; font-size: 1.15rem; }
.pass { color: #0d4a1c; background: #dff2e2; border-color: #2e7d3c; }
.fail { color: #8a1313; background: #fde4e1; border-color: #b3261e; }
.undecided { color: #333; background: #e6e6e6; border-color: #777; }
.not-judged { color: #333; background: #fff; border-color: #999; }
footer { margin-top: 3rem; border-top: 1px solid #999; font-size: 0.85rem; color: #444; }
@page { size: A4; margin: 16mm 15mm; }
@media print {
  html { font-size: 9.5pt; }
  body { max-width: none; padding: 0; line-height: 1.4; }
  nav { display: none; }
  h2 { break-before: page; margin-top: 0; }
  h2.joins { break-before: auto; margin-top: 2.4rem; }
  h2, h3, h2 + p, h3 + p, caption, thead { break-after: avoid; }
  figure, .sheet, tr, p, .whole { break-inside: avoid; }
  thead { display: table-header-group; }
  tbody tr:nth-child(-n+3), tbody tr:nth-last-child(-n+3) { break-before: avoid; }
  .scroll { overflow: visible; }
  footer { margin-top: 1rem; break-before: avoid; }
  table { font-size: 8pt; }
  .broad { min-width: 0; font-size: 7.5pt; }
  .broad th, .broad td { padding: 0.2rem 0.3rem; }
  .long { font-size: 6.5pt; }
  th, td { padding: 0.2rem 0.45rem; }
  .pair { columns: 2; column-gap: 6mm; }
  .pair table { width: 100%; font-size: 6pt; }
  .pair th, .pair td { padding: 0.06rem 0.12rem; }
  figure img { max-height: var(--highest, 225mm); width: auto; max-width: 100%; margin: 0 auto; }
  * { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
}
@media screen and (max-width: 48rem) { .long th, .long td { white-space: nowrap; } }
@media (max-width: 30rem) { body { padding: 0.8rem; } h1 { font-size: 1.5rem; } }
)";

const char* class_of(Mark mark) {
    switch (mark) {
    case Mark::pass:
        return "pass";
    case Mark::fail:
        return "fail";
    case Mark::undecided:
        return "undecided";
    default:
        return "not-judged";
    }
}

/// Letters a row would have in one line.
std::size_t letters_in_a_row(const Table& t) {
    const auto letters = [](const std::string& text) {
        return static_cast<std::size_t>(std::count_if(
            text.begin(), text.end(), [](char c) { return (c & '\xC0') != '\x80'; }));
    };
    std::size_t sum = 0;
    for (std::size_t k = 0; k < t.columns.size(); ++k) {
        std::size_t most = letters(t.columns[k].title);
        for (const std::vector<Cell>& row : t.rows)
            most = std::max(most, letters(row[k].text));
        sum += most;
    }
    return sum;
}

/// On narrow screens broad tables are moved sideways rather than pressed into one word a line.
const char* table_class(const Table& t) {
    if (t.is_small)
        return " class=\"long\"";
    constexpr std::size_t broad = 60;
    return letters_in_a_row(t) > broad ? " class=\"broad\"" : "";
}

/// On paper long, narrow tables go in two columns, short ones stay on one page.
const char* print_class(const Table& t) {
    constexpr std::size_t few = 14;
    constexpr std::size_t narrow = 62;
    if (t.rows.size() <= few)
        return " whole";
    return t.is_small && letters_in_a_row(t) <= narrow ? " pair" : "";
}

class HtmlWriter {
public:
    explicit HtmlWriter(std::string& out) : out_(out) {}

    void operator()(const Paragraph& p) {
        std::string classes = p.is_small ? "small" : "";
        if (p.mark != Mark::none)
            classes += fmt::format("{}mark {}", classes.empty() ? "" : " ", class_of(p.mark));
        write(classes.empty() ? "<p>{1}</p>\n" : "<p class=\"{0}\">{1}</p>\n",
              classes,
              escape_xml(p.text));
    }

    void operator()(const Subheading& h) { write("<h3>{}</h3>\n", escape_xml(h.text)); }

    void operator()(const Table& t) {
        write("<div class=\"scroll{2}\" tabindex=\"0\" role=\"group\" aria-label=\"{0}\">\n"
              "<table{1}>\n<caption>{0}</caption>\n<thead>\n<tr>",
              escape_xml(t.caption),
              table_class(t),
              print_class(t));
        for (const Column& c : t.columns)
            write("<th scope=\"col\"{}>{}</th>",
                  c.is_number ? " class=\"n\"" : "",
                  escape_xml(c.title));
        out_ += "</tr>\n</thead>\n<tbody>\n";
        for (const std::vector<Cell>& row : t.rows) {
            out_ += "<tr>";
            for (std::size_t k = 0; k < row.size(); ++k)
                write_cell(row[k], k == 0 ? "th scope=\"row\"" : "td", t.columns[k].is_number);
            out_ += "</tr>\n";
        }
        out_ += "</tbody>\n</table>\n</div>\n";
    }

    void operator()(const FactList& list) {
        out_ += "<div class=\"scroll\">\n<table class=\"list\">\n";
        if (!list.caption.empty())
            write("<caption>{}</caption>\n", escape_xml(list.caption));
        out_ += "<tbody>\n";
        for (const std::vector<Cell>& row : list.rows) {
            out_ += "<tr>";
            write_cell(row[0], "th scope=\"row\"", false);
            write_cell(row[1], "td", false);
            out_ += "</tr>\n";
        }
        out_ += "</tbody>\n</table>\n</div>\n";
    }

    void operator()(const Figure& f) {
        out_ += "<figure>\n";
        write("<img alt=\"{}\" width=\"{:.0f}\" height=\"{:.0f}\" "
              "style=\"--highest: {:.0f}mm\" src=\"data:image/svg+xml;base64,{}\"/>\n",
              escape_xml(f.alternative),
              pixels_per_mm * f.drawing.width,
              pixels_per_mm * f.drawing.height,
              f.largest_height,
              to_base64(to_svg(f.drawing)));
        write_figcaption(f.caption);
    }

    void operator()(const Photograph& p) {
        const PixelSize size = png_size(p.png).value_or(PixelSize{4, 3});
        out_ += "<figure>\n";
        write("<img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\"/>\n",
              escape_xml(p.alternative),
              size.width,
              size.height,
              to_base64(p.png));
        write_figcaption(p.caption);
    }

    void operator()(const FactSheet& sheet) {
        out_ += "<div class=\"sheet\">\n";
        (*this)(sheet.figure);
        (*this)(sheet.facts);
        out_ += "</div>\n";
    }

    template <class... Values> void write(fmt::string_view format, const Values&... values) {
        fmt::format_to(std::back_inserter(out_), fmt::runtime(format), values...);
    }

private:
    static constexpr double pixels_per_mm = 96.0 / 25.4;

    void write_cell(const Cell& cell, std::string_view tag, bool is_number) {
        const std::string_view name = tag.substr(0, 2);
        write("<{}{}>", tag, is_number ? " class=\"n\"" : "");
        if (cell.mark != Mark::none)
            write("<span class=\"mark {}\">{}</span>",
                  class_of(cell.mark),
                  escape_xml(cell.text));
        else if (cell.exact)
            write("<data value=\"{}\">{}</data>", *cell.exact, escape_xml(cell.text));
        else
            out_ += escape_xml(cell.text);
        write("</{}>", name);
    }

    void write_figcaption(const std::string& caption) {
        if (!caption.empty())
            write("<figcaption>{}</figcaption>\n", escape_xml(caption));
        out_ += "</figure>\n";
    }

    std::string& out_;
};

} // namespace

std::string to_html(const Report& r) {
    std::string out;
    HtmlWriter html(out);
    html.write("<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"{0}\" "
               "xml:lang=\"{0}\">\n<head>\n<meta charset=\"utf-8\"/>\n"
               "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
               "img-src data:; style-src 'unsafe-inline'\"/>\n"
               "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
               "<title>{1}</title>\n<style>{2}</style>\n</head>\n<body>\n<header>\n"
               "<p class=\"kind\">{3}</p>\n<h1>{1}</h1>\n",
               r.language,
               escape_xml(r.title),
               style,
               escape_xml(r.kind));
    if (!r.lead.empty())
        html.write("<p class=\"lead\">{}</p>\n", escape_xml(r.lead));
    html(r.cover);
    html.write("</header>\n<nav aria-label=\"{0}\">\n<h3>{0}</h3>\n<ol>\n",
               escape_xml(r.contents_title));
    for (const Section& s : r.sections)
        html.write("<li><a href=\"#{}\">{}</a></li>\n", s.id, escape_xml(s.title));
    out += "</ol>\n</nav>\n<main>\n";
    for (const Section& s : r.sections) {
        bool is_open = s.keeps_head;
        html.write("<section aria-labelledby=\"{0}\">\n{3}<h2 id=\"{0}\"{2}>{1}</h2>\n",
                   s.id,
                   escape_xml(s.title),
                   s.starts_page ? "" : " class=\"joins\"",
                   is_open ? "<div class=\"whole\">\n" : "");
        for (const Block& block : s.blocks) {
            std::visit(html, block);
            if (is_open && std::holds_alternative<Figure>(block)) {
                out += "</div>\n";
                is_open = false;
            }
        }
        if (is_open)
            out += "</div>\n";
        out += "</section>\n";
    }
    html.write("</main>\n<footer>\n<p>{}</p>\n</footer>\n</body>\n</html>\n",
               escape_xml(r.footer));
    return out;
}

} // namespace isolux::report
