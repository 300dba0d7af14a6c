#include "isolux/photometry/source_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace isolux {

namespace {

void append_utf8(std::string& text, std::uint32_t code) {
    const auto put = [&text](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
    if (code < 0x80) {
        put(code);
    } else if (code < 0x800) {
        put(0xC0 | (code >> 6));
        put(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        put(0xE0 | (code >> 12));
        put(0x80 | ((code >> 6) & 0x3F));
        put(0x80 | (code & 0x3F));
    } else {
        put(0xF0 | (code >> 18));
        put(0x80 | ((code >> 12) & 0x3F));
        put(0x80 | ((code >> 6) & 0x3F));
        put(0x80 | (code & 0x3F));
    }
}

/// Bytes of the UTF-8 sequence a lead byte opens; 0 for a byte that opens none.
std::size_t sequence_length(unsigned char lead) noexcept {
    if (lead < 0x80)
        return 1;
    if (lead >= 0xC2 && lead < 0xE0)
        return 2;
    if (lead >= 0xE0 && lead < 0xF0)
        return 3;
    return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

bool is_utf8(std::string_view bytes) noexcept {
    for (std::size_t i = 0; i < bytes.size();) {
        const std::size_t n = sequence_length(static_cast<unsigned char>(bytes[i]));
        if (n == 0 || i + n > bytes.size())
            return false;
        for (std::size_t k = 1; k < n; ++k)
            if ((static_cast<unsigned char>(bytes[i + k]) & 0xC0) != 0x80)
                return false;
        i += n;
    }
    return true;
}

/// Code points of bytes 0x80 to 0x9F in Windows-1252; unassigned ones keep their number.
constexpr std::array<std::uint32_t, 32> windows_1252{
    0x20AC, 0x81,   0x201A, 0x192,  0x201E, 0x2026, 0x2020, 0x2021, 0x2C6,  0x2030, 0x160,
    0x2039, 0x152,  0x8D,   0x17D,  0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x2DC,  0x2122, 0x161,  0x203A, 0x153,  0x9D,   0x17E,  0x178};

std::string from_windows_1252(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size() + bytes.size() / 8);
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        append_utf8(text, byte >= 0x80 && byte < 0xA0 ? windows_1252[byte - 0x80] : byte);
    }
    return text;
}

enum class ByteOrder { little, big };

std::string from_utf16(std::string_view bytes, ByteOrder order) {
    const auto unit = [&](std::size_t i) -> std::uint32_t {
        const auto first = static_cast<unsigned char>(bytes[i]);
        const auto second = static_cast<unsigned char>(bytes[i + 1]);
        return order == ByteOrder::little ? first | (second << 8) : (first << 8) | second;
    };
    constexpr std::uint32_t replacement = 0xFFFD;
    std::string text;
    text.reserve(bytes.size());
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        std::uint32_t code = unit(i);
        if (code >= 0xD800 && code < 0xDC00 && i + 3 < bytes.size()
            && (unit(i + 2) & 0xFC00) == 0xDC00) {
            code = 0x10000 + ((code & 0x3FF) << 10) + (unit(i + 2) & 0x3FF);
            i += 2;
        } else if (code >= 0xD800 && code < 0xE000) {
            code = replacement;
        }
        append_utf8(text, code);
    }
    return text;
}

std::string decode(std::string_view bytes, Findings& findings) {
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
        findings.warn(1,
                      "the text is UTF-16 (luminaire files are ASCII or Latin-1)",
                      "Decoded by its byte order mark");
        return from_utf16(bytes.substr(2),
                          bytes[0] == '\xFF' ? ByteOrder::little : ByteOrder::big);
    }
    if (bytes.starts_with("\xEF\xBB\xBF")) {
        findings.note(1, "UTF-8 byte order mark before the first line (ignored)");
        bytes.remove_prefix(3);
    }
    return is_utf8(bytes) ? std::string(bytes) : from_windows_1252(bytes);
}

} // namespace

SourceText::SourceText(std::string_view bytes, Findings& findings) {
    if (bytes.size() > max_bytes)
        findings.fail(1,
                      "the file has " + std::to_string(bytes.size())
                          + " bytes (no luminaire file needs more than 32 MiB)");
    text_ = decode(bytes, findings);
    split_lines(findings);
    for (std::size_t n = 1; n <= line_count(); ++n)
        if (line(n).find('\0') != std::string_view::npos)
            findings.fail(n, "NUL bytes (this is no text file)", "Damaged, or another format?");
}

void SourceText::split_lines(Findings& findings) {
    bool has_lone_return = false;
    for (std::size_t begin = 0; begin < text_.size();) {
        const std::size_t stop = std::min(text_.find_first_of("\r\n", begin), text_.size());
        lines_.push_back({begin, stop - begin});
        // LF, CR LF, CR, and CR CR LF, which careless copying makes of CR LF
        std::size_t feed = stop;
        while (feed < text_.size() && feed < stop + 2 && text_[feed] == '\r')
            ++feed;
        const bool ends_with_feed = feed < text_.size() && text_[feed] == '\n';
        has_lone_return = has_lone_return || (stop < text_.size() && !ends_with_feed);
        begin = ends_with_feed ? feed + 1 : stop + 1;
    }
    if (has_lone_return)
        findings.warn(1,
                      "lines end with carriage returns alone (old Macintosh text; accepted)");
}

std::size_t SourceText::last_line() const noexcept {
    for (std::size_t n = line_count(); n > 1; --n)
        if (!trim(line(n)).empty())
            return n;
    return 1;
}

std::string_view trim(std::string_view text) noexcept {
    constexpr std::string_view blanks = " \t\r\v\f";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string to_upper(std::string_view text) {
    std::string upper(text);
    for (char& c : upper)
        if (c >= 'a' && c <= 'z')
            c = static_cast<char>(c - 'a' + 'A');
    return upper;
}

} // namespace isolux
