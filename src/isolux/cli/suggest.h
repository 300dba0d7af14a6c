#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace isolux {

/// The known word that `word` most likely is a slip of: at most a third of its letters (and at
/// least one) inserted, left out, swapped with a neighbour or replaced; or a beginning of
/// exactly one known word.
[[nodiscard]] std::optional<std::string> find_similar(std::string_view word,
                                                      std::span<const std::string> known);

} // namespace isolux
