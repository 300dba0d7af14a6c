#include "isolux/viz/drawing.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "isolux/base/error.h"
#include "isolux/io/safe_file.h"

namespace isolux {

namespace {

/// Length of the UTF-8 sequence at the start of `text`, 0 if it is not one (RFC 3629: shortest
/// form, no surrogates, at most U+10FFFF) or is not allowed in XML (U+FFFE, U+FFFF).
std::size_t sequence_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80)
        return 1;
    const std::size_t length = first >= 0xF0 ? 4 : (first >= 0xE0 ? 3 : 2);
    if (first < 0xC0 || first > 0xF7 || text.size() < length)
        return 0;
    constexpr std::array<std::uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
    std::uint32_t code = first & (0xFFu >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80)
            return 0;
        code = (code << 6) | (byte(i) & 0x3Fu);
    }
    const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
    const bool is_forbidden = code == 0xFFFE || code == 0xFFFF || code > 0x10FFFF;
    return code < smallest[length] || is_surrogate || is_forbidden ? 0 : length;
}

/// Moves and scales one item after another into another page.
class Placer {
public:
    Placer(Drawing& page, const Point2& at, double scale)
        : page_(page), at_(at), scale_(scale) {}

    void operator()(Shape s) {
        s.lines = moved(std::move(s.lines));
        if (s.stroke) {
            s.stroke->width *= scale_;
            s.stroke->dash *= scale_;
        }
        page_.items.emplace_back(std::move(s));
    }

    void operator()(Text t) {
        t.at = moved(t.at);
        t.size *= scale_;
        page_.items.emplace_back(std::move(t));
    }

    void operator()(Clip c) { page_.items.emplace_back(Clip{moved(std::move(c.lines))}); }

    void operator()(const EndClip& e) { page_.items.emplace_back(e); }

    void operator()(Picture p) {
        p.at = moved(p.at);
        p.width *= scale_;
        p.height *= scale_;
        page_.items.emplace_back(std::move(p));
    }

private:
    [[nodiscard]] Point2 moved(const Point2& p) const {
        return {at_.x + scale_ * p.x, at_.y + scale_ * p.y};
    }

    [[nodiscard]] std::vector<Polyline> moved(std::vector<Polyline> lines) const {
        for (Polyline& line : lines)
            for (Point2& p : line)
                p = moved(p);
        return lines;
    }

    Drawing& page_;
    Point2 at_;
    double scale_;
};

std::uint32_t big_endian(std::string_view four_bytes) {
    std::uint32_t value = 0;
    for (const char c : four_bytes)
        value = (value << 8) | static_cast<unsigned char>(c);
    return value;
}

} // namespace

void place(Drawing& page, const Drawing& inner, const Point2& at, double scale) {
    Placer placer(page, at, scale);
    for (const auto& item : inner.items)
        std::visit(placer, item);
}

std::optional<PixelSize> png_size(std::string_view png) {
    constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
    if (png.size() < 24 || !png.starts_with(signature) || png.substr(12, 4) != "IHDR")
        return std::nullopt;
    const PixelSize size{big_endian(png.substr(16, 4)), big_endian(png.substr(20, 4))};
    return size.width > 0 && size.height > 0 ? std::optional(size) : std::nullopt;
}

std::string to_base64(std::string_view bytes) {
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::string_view part = bytes.substr(i, 3);
        std::string padded(part);
        padded.resize(3, '\0');
        const std::uint32_t bits = big_endian(padded);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= part.size() ? letters[(bits >> (18 - 6 * k)) & 0x3F] : '=';
    }
    return out;
}

std::string printable(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = sequence_length(text);
        const bool is_control =
            length == 1 && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7F);
        if (length == 0)
            out += '?';
        else if (is_control)
            out += ' ';
        else
            out += text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return out;
}

std::string escape_xml(std::string_view text) {
    std::string out;
    for (const char c : printable(text)) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            out += c;
        }
    }
    return out;
}

void write_drawing(const std::filesystem::path& stem, const Drawing& drawing) {
    std::filesystem::path svg = stem;
    svg += ".svg";
    write_file_safely(svg, to_svg(drawing));
    std::filesystem::path png = stem;
    png += ".png";
    write_file_safely(png, to_png(drawing));
}

void write_drawing_file(const std::filesystem::path& file, const Drawing& drawing) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    if (ending == ".svg")
        write_file_safely(file, to_svg(drawing));
    else if (ending == ".png")
        write_file_safely(file, to_png(drawing));
    else if (ending == ".pdf")
        write_file_safely(file, to_pdf({&drawing, 1}, drawing.title));
    else
        throw InputError(file.string(),
                         "no picture format goes by this name",
                         "A name that ends in .svg, .png or .pdf?");
}

} // namespace isolux
