#include <cstddef>
#include <cstdint>
#include <string_view>

#include "isolux/base/error.h"
#include "isolux/io/project_json.h"

/// Any bytes: a project or an InputError, nothing else. The project lies in a folder that does
/// not exist, so that no other file comes into play.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        static_cast<void>(isolux::parse_project(text, "no-such-folder/project.json"));
    } catch (const isolux::InputError&) {
        // told to the user
    }
    return 0;
}
