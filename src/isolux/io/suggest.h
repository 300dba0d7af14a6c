#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace isolux {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn one word
/// into the other; upper and lower case count as equal. (Optimal string alignment distance.)
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate that the word was most likely meant to be: the nearest one, if it is no
/// further away than a third of the word.
[[nodiscard]] std::optional<std::string> find_nearest(std::string_view word,
                                                      std::span<const std::string> candidates);

/// `Did you mean "height"?`, or empty if nothing is near.
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       std::span<const std::string> candidates);

} // namespace isolux
