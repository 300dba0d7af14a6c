#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/base/error.h"

namespace isolux {

/// What a reader has to say about one file. Places are `source:line`, lines counted from 1.
class Findings {
public:
    /// More than this nobody reads; what follows is left out.
    static constexpr std::size_t most_notices = 100;

    explicit Findings(std::string_view source) : source_(source) {}

    /// Within the format's rules, but worth knowing.
    void note(std::size_t line, std::string what, std::string hint = {});

    /// Against the format's rules, or something had to be assumed; `strict` refuses it.
    void warn(std::size_t line, std::string what, std::string hint = {});

    /// Takes over what was found in a file inside this one.
    void add(const Findings& inner);

    /// @throws InputError always
    [[noreturn]] void fail(std::size_t line, std::string what, std::string hint = {}) const;

    [[nodiscard]] const std::string& source() const noexcept { return source_; }

    /// Notes and warnings in the order they were found.
    [[nodiscard]] const std::vector<Message>& notices() const noexcept { return notices_; }

    /// @throws InputError with every warning, if there is one
    void refuse_warnings() const;

private:
    [[nodiscard]] std::string place(std::size_t line) const;

    std::string source_;
    std::vector<Message> notices_;
    std::vector<Message> warnings_;
};

} // namespace isolux
