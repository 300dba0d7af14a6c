#pragma once

#include <string>
#include <string_view>

namespace isolux {

/// SHA-256 of the bytes (FIPS 180-4), 64 lower-case hexadecimal digits. Says in the results
/// which inputs they belong to.
[[nodiscard]] std::string sha256(std::string_view bytes);

} // namespace isolux
