#include "isolux/io/words.h"

#include <fmt/format.h>

namespace isolux {

std::string enumerate(std::span<const std::string> words, std::string_view last_joint) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0)
            text += i + 1 == words.size() ? fmt::format(" {} ", last_joint) : ", ";
        text += '"' + words[i] + '"';
    }
    return text;
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t enough = 60;
    std::string shown;
    for (const char c : text.substr(0, enough))
        shown += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    if (text.size() > enough)
        shown += "...";
    return '"' + shown + '"';
}

} // namespace isolux
