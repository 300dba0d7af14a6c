#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "isolux/viz/drawing.h"

namespace isolux {

namespace {

using Out = std::back_insert_iterator<std::string>;

/// Hundredths of a millimetre, without trailing zeros: short and the same everywhere.
std::string number(double v) {
    std::string text = fmt::format("{:.2f}", std::isfinite(v) ? v : 0.0);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string colour(const Colour& c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b);
}

std::string path_data(const std::vector<Polyline>& lines, Ends ends) {
    std::string d;
    for (const Polyline& line : lines) {
        char command = 'M';
        for (const Point2& p : line) {
            d += fmt::format("{}{} {}", command, number(p.x), number(p.y));
            command = 'L';
        }
        if (ends == Ends::closed && !line.empty())
            d += 'Z';
    }
    return d;
}

/// Writes one item after another; clips become nested groups.
class SvgWriter {
public:
    explicit SvgWriter(std::string& out) : out_(out) {}

    void operator()(const Shape& s) {
        fmt::format_to(at(), "<path d=\"{}\"", path_data(s.lines, s.ends));
        if (s.fill)
            fmt::format_to(at(), " fill=\"{}\" fill-rule=\"evenodd\"", colour(*s.fill));
        else
            out_ += " fill=\"none\"";
        if (s.fill && s.opacity < 1.0)
            fmt::format_to(at(), " fill-opacity=\"{}\"", number(s.opacity));
        if (s.stroke)
            write_stroke(*s.stroke);
        out_ += "/>\n";
    }

    void operator()(const Text& t) {
        if (t.halo)
            write_text(t,
                       fmt::format("fill=\"{0}\" stroke=\"{0}\" stroke-width=\"{1}\" "
                                   "stroke-linejoin=\"round\"",
                                   colour(*t.halo),
                                   number(0.35 * t.size)));
        write_text(t, fmt::format("fill=\"{}\"", colour(t.colour)));
    }

    void operator()(const Clip& c) {
        ++clips_;
        fmt::format_to(at(),
                       "<clipPath id=\"clip{0}\"><path d=\"{1}\" clip-rule=\"evenodd\"/>"
                       "</clipPath>\n<g clip-path=\"url(#clip{0})\">\n",
                       clips_,
                       path_data(c.lines, Ends::closed));
    }

    void operator()(const EndClip&) { out_ += "</g>\n"; }

    void operator()(const Picture& p) {
        fmt::format_to(at(),
                       "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
                       "preserveAspectRatio=\"none\" "
                       "xlink:href=\"data:image/png;base64,{}\"/>\n",
                       number(p.at.x),
                       number(p.at.y),
                       number(p.width),
                       number(p.height),
                       to_base64(p.png));
    }

private:
    [[nodiscard]] Out at() { return std::back_inserter(out_); }

    void write_stroke(const Stroke& s) {
        fmt::format_to(at(),
                       " stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                       colour(s.colour),
                       number(s.width));
        if (s.dash > 0.0)
            fmt::format_to(at(), " stroke-dasharray=\"{}\"", number(s.dash));
    }

    void write_text(const Text& t, std::string_view paint) {
        constexpr std::array<std::string_view, 3> anchors{"start", "middle", "end"};
        fmt::format_to(at(),
                       "<text x=\"{}\" y=\"{}\" font-size=\"{}\" {}",
                       number(t.at.x),
                       number(t.at.y),
                       number(t.size),
                       paint);
        if (t.anchor != Anchor::start)
            fmt::format_to(
                at(), " text-anchor=\"{}\"", anchors[static_cast<std::size_t>(t.anchor)]);
        if (t.weight == Weight::bold)
            out_ += " font-weight=\"bold\"";
        if (t.turn != 0.0)
            fmt::format_to(at(),
                           " transform=\"rotate({} {} {})\"",
                           number(-t.turn),
                           number(t.at.x),
                           number(t.at.y));
        fmt::format_to(at(), ">{}</text>\n", escape_xml(t.text));
    }

    std::string& out_;
    int clips_ = 0;
};

} // namespace

std::string to_svg(const Drawing& drawing) {
    const bool has_picture =
        std::any_of(drawing.items.begin(), drawing.items.end(), [](const auto& item) {
            return std::holds_alternative<Picture>(item);
        });
    std::string out;
    fmt::format_to(
        std::back_inserter(out),
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\"{3} version=\"1.1\" width=\"{0}mm\" "
        "height=\"{1}mm\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"'DejaVu Sans',Verdana,sans-serif\">\n"
        "<title>{2}</title>\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        number(drawing.width),
        number(drawing.height),
        escape_xml(drawing.title),
        has_picture ? " xmlns:xlink=\"http://www.w3.org/1999/xlink\"" : "");
    SvgWriter writer(out);
    for (const auto& item : drawing.items)
        std::visit(writer, item);
    out += "</svg>\n";
    return out;
}

} // namespace isolux
