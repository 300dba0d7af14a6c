#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace isolux {

/// The known word that `word` most likely is a slip of (find_nearest of io/suggest.h), else the
/// only one that it begins.
[[nodiscard]] std::optional<std::string> find_similar(std::string_view word,
                                                      std::span<const std::string> known);

} // namespace isolux
