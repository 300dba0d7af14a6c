#include "isolux/viz/drawing.h"

#include <array>

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

} // namespace

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

void write_drawing(const std::filesystem::path& stem, const Drawing& drawing) {
    std::filesystem::path svg = stem;
    svg += ".svg";
    write_file_safely(svg, to_svg(drawing));
    std::filesystem::path png = stem;
    png += ".png";
    write_file_safely(png, to_png(drawing));
}

} // namespace isolux
