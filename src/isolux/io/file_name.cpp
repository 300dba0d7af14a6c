#include "isolux/io/file_name.h"

#include <algorithm>
#include <cstddef>
#include <set>

namespace isolux {

namespace {

constexpr std::size_t longest = 120; ///< bytes; 255 is what file systems take

/// Bytes of the UTF-8 sequence at the start of `text`, 0 if there is none (RFC 3629).
std::size_t utf8_length(std::string_view text) noexcept {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    const std::size_t n = first < 0x80   ? 1
                          : first < 0xC2 ? 0
                          : first < 0xE0 ? 2
                          : first < 0xF0 ? 3
                          : first < 0xF5 ? 4
                                         : 0;
    if (n == 0 || n > text.size())
        return 0;
    for (std::size_t i = 1; i < n; ++i)
        if ((byte(i) & 0xC0U) != 0x80U)
            return 0;
    const bool is_overlong =
        (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
    const bool is_surrogate = first == 0xED && byte(1) > 0x9F;
    const bool is_too_large = first == 0xF4 && byte(1) > 0x8F;
    return is_overlong || is_surrogate || is_too_large ? 0 : n;
}

bool is_awkward(char c) noexcept {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7F
           || std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos;
}

std::string fold_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return text;
}

void trim_end(std::string& stem) {
    while (!stem.empty() && (stem.back() == ' ' || stem.back() == '.'))
        stem.pop_back();
}

} // namespace

std::string file_stem(std::string_view name) {
    std::string stem;
    while (!name.empty() && stem.size() < longest) {
        const std::size_t n = utf8_length(name);
        if (n == 0 || is_awkward(name.front()))
            stem += '_';
        else if (stem.size() + n > longest)
            break;
        else
            stem += name.substr(0, n);
        name.remove_prefix(std::max<std::size_t>(n, 1));
    }
    stem.erase(0, stem.find_first_not_of(" ."));
    trim_end(stem);
    return stem.empty() ? "_" : stem;
}

std::vector<std::string> file_stems(std::span<const std::string> names) {
    std::vector<std::string> stems;
    std::set<std::string> taken;
    for (const std::string& name : names) {
        const std::string plain = file_stem(name);
        std::string stem = plain;
        for (int i = 2; !taken.insert(fold_case(stem)).second; ++i)
            stem = plain + "-" + std::to_string(i);
        stems.push_back(stem);
    }
    return stems;
}

} // namespace isolux
