#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/photometry/file_number.h"
#include "isolux/photometry/source_text.h"

namespace isolux {

/// The data part of a LM-63 file as a queue of tokens. LM-63 lets a record run over any number
/// of lines and lets a new one start in the middle of a line, so lines mean nothing here except
/// for messages.
class IesTokens {
public:
    /// @param first_line  where the data part begins, 1-based
    IesTokens(const SourceText& text, std::size_t first_line, const Findings& findings);

    [[nodiscard]] std::size_t remaining() const noexcept { return tokens_.size() - next_; }

    /// Line of the next token; the last line of the file when none is left.
    [[nodiscard]] std::size_t line() const noexcept;

    /// The next token as it stands. @pre remaining() > 0
    [[nodiscard]] std::string_view peek() const noexcept { return tokens_[next_].text; }

    /// @param what  the number's name for messages. @throws InputError
    [[nodiscard]] FileNumber take_number(std::string_view what);

    /// A whole number from `least` up. @throws InputError
    [[nodiscard]] FileNumber take_count(std::string_view what, int least);

    /// `count` numbers. @pre count <= remaining()
    [[nodiscard]] std::vector<FileNumber> take_numbers(std::size_t count,
                                                       std::string_view what);

    /// Refuses a list that does not ascend. @throws InputError
    void expect_ascending(const std::vector<FileNumber>& values, std::string_view what) const;

    /// A hint where decimal commas are the likely cause of a contradiction.
    [[nodiscard]] std::string comma_hint(std::string otherwise) const;

private:
    struct Token {
        std::string_view text;
        std::size_t line;
    };

    void tokenise(std::string_view line_text, std::size_t line);

    const Findings& findings_;
    std::vector<Token> tokens_;
    std::size_t next_ = 0;
    std::size_t last_line_ = 1;
    bool has_tight_comma_ = false; ///< digit, comma, digit
};

} // namespace isolux
