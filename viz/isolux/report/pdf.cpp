#include "isolux/report/pdf.h"

#include <algorithm>

#include "isolux/report/page_writer.h"

namespace isolux::report {

namespace {

constexpr double body_size = 2.9; // mm
constexpr double small_size = 2.4;

constexpr double highest = 215.0; // mm, of a picture

double scale_of(const Figure& f) {
    const double width = std::min(f.largest_width, PageWriter::text_width);
    return std::min(width / f.drawing.width,
                    std::min(f.largest_height, highest) / f.drawing.height);
}

/// What a section needs of a page so that it may begin there, mm; roughly.
double room_for_head(const Section& s) {
    constexpr double least = 70.0;
    if (!s.keeps_head)
        return least;
    double sum = 20.0;
    for (const Block& block : s.blocks) {
        if (const auto* figure = std::get_if<Figure>(&block))
            return sum + scale_of(*figure) * figure->drawing.height + 9.0;
        if (const auto* table = std::get_if<Table>(&block))
            sum += 14.0 + 5.6 * static_cast<double>(table->rows.size());
        else
            sum += 16.0;
    }
    constexpr double most = 150.0; // longer ones are torn
    return std::clamp(sum, least, most);
}

/// Writes one block after another.
class PdfWriter {
public:
    explicit PdfWriter(PageWriter& writer) : w_(writer) {}

    void operator()(const Paragraph& p) {
        if (p.mark != Mark::none) {
            write_banner(p);
            return;
        }
        w_.write(p.text, p.is_small ? small_size : body_size);
        w_.skip(2.2);
    }

    void operator()(const Subheading& h) {
        w_.reserve(30.0);
        if (!w_.is_at_top())
            w_.skip(2.5);
        w_.write(h.text, 3.8, Weight::bold);
        w_.skip(1.2);
    }

    void operator()(const Table& t) { write_table(w_, t); }

    void operator()(const FactList& list) {
        write_facts(w_, list, PageWriter::left, PageWriter::text_width);
        w_.skip(3.0);
    }

    void operator()(const Figure& f) {
        const double scale = scale_of(f);
        begin_picture(scale * f.drawing.height, f.caption);
        Drawing inner;
        place(inner, f.drawing, {PageWriter::left, w_.y()}, scale);
        for (auto& item : inner.items)
            w_.add(std::move(item));
        end_picture(scale * f.drawing.height, f.caption);
    }

    void operator()(const Photograph& p) {
        const PixelSize pixels = png_size(p.png).value_or(PixelSize{4, 3});
        const double scale =
            std::min(PageWriter::text_width / pixels.width, highest / pixels.height);
        const double height = scale * pixels.height;
        begin_picture(height, p.caption);
        w_.add(Picture{p.png, {PageWriter::left, w_.y()}, scale * pixels.width, height});
        end_picture(height, p.caption);
    }

    void operator()(const FactSheet& sheet) {
        constexpr double picture = 62.0;
        const double scale = picture / sheet.figure.drawing.width;
        const double rows = static_cast<double>(sheet.facts.rows.size());
        w_.reserve(std::max(scale * sheet.figure.drawing.height, 6.5 * rows) + 8.0);
        const double y = w_.y();
        Drawing inner;
        place(inner, sheet.figure.drawing, {PageWriter::left, y}, scale);
        for (auto& item : inner.items)
            w_.add(std::move(item));
        write_facts(w_,
                    sheet.facts,
                    PageWriter::left + picture + 6.0,
                    PageWriter::text_width - picture - 6.0);
        const double below = y + scale * sheet.figure.drawing.height;
        w_.skip(std::max(0.0, below - w_.y()) + 4.0);
    }

private:
    void begin_picture(double height, const std::string& caption) {
        w_.reserve(height + (caption.empty() ? 0.0 : 8.0));
    }

    void end_picture(double height, const std::string& caption) {
        w_.skip(height + 1.0);
        if (!caption.empty())
            w_.write(caption, small_size, Weight::normal, ink::grey);
        w_.skip(4.0);
    }

    void write_banner(const Paragraph& p) {
        constexpr double size = 3.6;
        const auto lines = w_.wrap(p.text, PageWriter::text_width - 8.0, size, Weight::bold);
        const double height =
            PageWriter::line_space * size * static_cast<double>(lines.size()) + 6.0;
        w_.reserve(height + 3.0);
        const MarkInk colours = ink_of(p.mark);
        Shape field =
            make_rectangle({PageWriter::left, w_.y(), PageWriter::text_width, height});
        field.fill = colours.fill;
        field.stroke = Stroke{colours.line, 0.4};
        w_.add(std::move(field));
        double y = w_.y() + 2.6 + size;
        for (const std::string& line : lines) {
            w_.add(make_text(line,
                             {PageWriter::left + 4.0, y},
                             size,
                             Anchor::start,
                             Weight::bold,
                             colours.text));
            y += PageWriter::line_space * size;
        }
        w_.skip(height + 4.0);
    }

    PageWriter& w_;
};

void write_cover(PageWriter& writer, const Report& r) {
    writer.begin_section(r.title);
    writer.skip(45.0);
    writer.write(r.kind, 3.6, Weight::normal, ink::grey);
    writer.skip(2.0);
    writer.write(r.title, 8.5, Weight::bold);
    writer.skip(3.0);
    if (!r.lead.empty()) {
        writer.write(r.lead, 3.4);
        writer.skip(4.0);
    }
    writer.skip(6.0);
    write_facts(writer, r.cover, PageWriter::left, PageWriter::text_width);
    writer.skip(10.0);
    writer.write(r.contents_title, 3.4, Weight::bold);
    writer.skip(1.0);
    for (const Section& s : r.sections)
        writer.write(s.title, body_size);
}

} // namespace

std::vector<Drawing> lay_out(const Report& r) {
    PageWriter writer;
    write_cover(writer, r);
    PdfWriter blocks(writer);
    for (const Section& s : r.sections) {
        if (s.starts_page)
            writer.begin_section(s.title);
        else
            writer.join_section(s.title, room_for_head(s));
        writer.write(s.title, 5.4, Weight::bold);
        writer.skip(1.0);
        writer.add(make_line({{PageWriter::left, writer.y()},
                              {PageWriter::left + PageWriter::text_width, writer.y()}},
                             {ink::black, 0.4}));
        writer.skip(4.0);
        for (const Block& block : s.blocks)
            std::visit(blocks, block);
    }
    return std::move(writer).finish(r.footer);
}

std::string to_pdf_report(const Report& r) { return to_pdf(lay_out(r), r.title); }

} // namespace isolux::report
