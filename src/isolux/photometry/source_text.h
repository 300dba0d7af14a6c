#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/photometry/findings.h"

namespace isolux {

/// The text of a luminaire file, decoded to UTF-8 and cut into lines.
///
/// Accepted: ASCII, UTF-8 with or without byte order mark, UTF-16 with one, and, where the
/// bytes are no UTF-8, Windows-1252 (of which Latin-1's printable characters are a part). Lines
/// end with LF, CR LF or CR. NUL bytes are an error: the file is no text.
class SourceText {
public:
    /// Files larger than this are refused before anything is copied; the largest real luminaire
    /// files have less than 2 MB.
    static constexpr std::size_t max_bytes = std::size_t{32} << 20;

    /// @throws InputError  too large, NUL bytes
    SourceText(std::string_view bytes, Findings& findings);

    [[nodiscard]] std::size_t line_count() const noexcept { return lines_.size(); }

    /// @param number  1-based, <= line_count(). Without its line end.
    [[nodiscard]] std::string_view line(std::size_t number) const noexcept {
        const Span& s = lines_[number - 1];
        return std::string_view(text_).substr(s.begin, s.size);
    }

    /// The last line that is not blank; 1 in an empty file.
    [[nodiscard]] std::size_t last_line() const noexcept;

private:
    struct Span {
        std::size_t begin;
        std::size_t size;
    };

    void split_lines(Findings& findings);

    std::string text_;
    std::vector<Span> lines_;
};

/// Blanks of any kind removed from both ends.
[[nodiscard]] std::string_view trim(std::string_view text) noexcept;

/// ASCII letters made upper case.
[[nodiscard]] std::string to_upper(std::string_view text);

} // namespace isolux
