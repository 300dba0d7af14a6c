#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/base/vec.h"

namespace isolux {

/// A mesh file's content before OpenMesh holds it.
struct RawMesh {
    std::vector<Point3> points;
    std::vector<std::vector<std::uint32_t>> faces;
    std::vector<std::uint32_t> slot_of_face; ///< empty: all slot 0
    std::vector<std::string> slots{""};
};

[[nodiscard]] RawMesh parse_obj(std::string_view bytes, std::string_view source);
[[nodiscard]] RawMesh parse_off(std::string_view bytes, std::string_view source);
[[nodiscard]] RawMesh parse_ply(std::string_view bytes, std::string_view source);
[[nodiscard]] RawMesh parse_stl(std::string_view bytes, std::string_view source);

/// Walks through a text line by line and word by word; failures name the line.
class TextCursor {
public:
    TextCursor(std::string_view text, std::string_view source) : rest_(text), source_(source) {}

    /// Goes to the next line that holds words; `#` starts a comment.
    /// @return false at the end of the text
    bool next_line();

    [[nodiscard]] std::span<const std::string_view> words() const noexcept { return words_; }

    [[nodiscard]] std::string_view line() const noexcept { return line_; }

    [[nodiscard]] std::size_t line_number() const noexcept { return line_number_; }

    /// What has not been read yet.
    [[nodiscard]] std::string_view rest() const noexcept { return rest_; }

    /// Word `i` as a finite number. @throws InputError
    [[nodiscard]] double number(std::size_t i) const;
    /// Word `i` as a whole number. @throws InputError
    [[nodiscard]] std::int64_t integer(std::size_t i) const;
    /// Words `first` to `first + 2` as a point. @throws InputError
    [[nodiscard]] Point3 point(std::size_t first) const;

    /// @throws InputError at `source:line`
    [[noreturn]] void fail(std::string what, std::string hint = {}) const;
    /// The same at a line read before.
    [[noreturn]] void
    fail_at(std::size_t line_number, std::string what, std::string hint = {}) const;

private:
    [[nodiscard]] std::string_view word(std::size_t i) const;

    std::string_view rest_;
    std::string_view source_;
    std::string_view line_;
    std::vector<std::string_view> words_;
    std::size_t line_number_ = 0;
};

/// Parses a whole word as a number; false if it is anything else.
[[nodiscard]] bool read_number(std::string_view word, double& value) noexcept;
[[nodiscard]] bool read_integer(std::string_view word, std::int64_t& value) noexcept;

/// Faces with more corners than this are refused: no real mesh has them, and splitting them
/// would take for ever.
inline constexpr std::int64_t most_corners = 1000;

} // namespace isolux
