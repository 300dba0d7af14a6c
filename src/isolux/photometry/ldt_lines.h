#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/photometry/file_number.h"
#include "isolux/photometry/source_text.h"

namespace isolux {

/// A EULUMDAT file as a queue of lines, one value each.
class LdtLines {
public:
    LdtLines(const SourceText& text, Findings& findings);

    /// Lines left, blank ones at the end of the file not counted.
    [[nodiscard]] std::size_t remaining() const noexcept { return last_ + 1 - next_; }

    /// Number of the next line.
    [[nodiscard]] std::size_t line() const noexcept { return next_; }

    /// The next line without blanks around it.
    [[nodiscard]] std::string_view peek() const noexcept { return trim(text_.line(next_)); }

    /// @param what  the value's name for messages. @throws InputError at the end of the file
    [[nodiscard]] std::string take_text(std::string_view what);

    /// A blank line counts as 0, with a warning. @throws InputError  not a number
    [[nodiscard]] FileNumber take_number(std::string_view what);

    /// For numbers that tell the reader something and nothing depends on: text in their place
    /// counts as 0, with a warning.
    [[nodiscard]] FileNumber take_informative(std::string_view what);

    /// A blank line is refused. @throws InputError
    [[nodiscard]] FileNumber take_count(std::string_view what, int least, int most);

    /// @throws InputError  where the file ends too early, on its last line
    [[nodiscard]] std::vector<FileNumber> take_numbers(std::size_t count,
                                                       std::string_view what);

private:
    [[nodiscard]] std::string_view take_line(std::string_view what);
    [[nodiscard]] double to_number(std::string_view text, std::string_view what);

    const SourceText& text_;
    Findings& findings_;
    std::size_t next_ = 1;
    std::size_t last_ = 0;
    bool has_told_of_commas_ = false;
};

} // namespace isolux
