#include "isolux/cli/suggest.h"

#include <algorithm>

#include "isolux/io/suggest.h"

namespace isolux {

std::optional<std::string> find_similar(std::string_view word,
                                        std::span<const std::string> known) {
    if (word.empty())
        return std::nullopt;
    if (auto nearest = find_nearest(word, known))
        return nearest;
    const auto begins = [&](const std::string& k) { return k.starts_with(word); };
    if (std::count_if(known.begin(), known.end(), begins) != 1)
        return std::nullopt;
    return *std::find_if(known.begin(), known.end(), begins);
}

} // namespace isolux
