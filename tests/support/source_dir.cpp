#include "source_dir.h"

namespace isolux::test {

std::filesystem::path source_dir() { return ISOLUX_SOURCE_DIR; }

} // namespace isolux::test
