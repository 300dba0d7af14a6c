#include "isolux/io/suggest.h"

#include <algorithm>
#include <vector>

namespace isolux {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

} // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    // Three rows of the usual table are enough: this one, the last and the one before.
    std::vector<std::size_t> before(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool equal = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (equal ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2])
                                 && lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped)
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::optional<std::string> find_nearest(std::string_view word,
                                        std::span<const std::string> candidates) {
    constexpr std::size_t longest_word = 200; // names are not longer
    if (word.size() > longest_word)
        return std::nullopt;
    const std::size_t furthest = std::max<std::size_t>(1, word.size() / 3);
    std::optional<std::string> nearest;
    std::size_t smallest = furthest + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t shorter = std::min(word.size(), candidate.size());
        const std::size_t longer = std::max(word.size(), candidate.size());
        if (longer - shorter >= smallest)
            continue;
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < smallest && distance < longer) {
            smallest = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
    const std::optional<std::string> nearest = find_nearest(word, candidates);
    return nearest ? "Did you mean \"" + *nearest + "\"?" : std::string();
}

} // namespace isolux
