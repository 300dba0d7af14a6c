#pragma once

#include <filesystem>

namespace isolux::test {

/// The folder this project's sources lie in. Known to one file, so that the compiled tests of
/// two checkouts are the same bytes and a compiler cache serves both.
std::filesystem::path source_dir();

} // namespace isolux::test
