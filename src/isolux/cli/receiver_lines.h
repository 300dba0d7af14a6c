#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/base/receiver.h"

namespace isolux {

/// What the last three numbers of a line are.
enum class LineForm {
    receiver,  ///< `x y z nx ny nz`: a place and the normal of its plane
    sight_line ///< `x y z dx dy dz`: an eye and the direction it looks in
};

/// Reads `x y z nx ny nz` lines (metres; blanks, tabs, commas or semicolons between the
/// numbers; `#` begins a comment; empty lines are skipped), a batch at a time, so that input of
/// any length needs the memory of one batch.
class ReceiverLines {
public:
    /// @param source  names the input in messages: `source:line`
    /// @param form    a sight line comes as a receiver whose axis is the direction
    ReceiverLines(std::istream& in, std::string source, LineForm form = LineForm::receiver)
        : in_(in), source_(std::move(source)), form_(form) {}

    /// The next receivers, at most `count`; fewer only at the end of the input.
    /// @throws InputError  naming the lines that cannot be read, at most ten of them
    [[nodiscard]] std::vector<Receiver> read(std::size_t count);

private:
    std::istream& in_;
    std::string source_;
    LineForm form_;
    std::size_t line_ = 0;
};

/// One line; nothing if it is empty or a comment. @param where  for messages
/// @throws InputError
[[nodiscard]] std::optional<Receiver> parse_receiver(std::string_view text,
                                                     const std::string& where,
                                                     LineForm form = LineForm::receiver);

} // namespace isolux
