#include "isolux/io/schemas.h"

#include <utility>

namespace isolux {

namespace {

// Written by CMake from schema/*.schema.json: {name, text}, sorted by name.
constexpr std::pair<std::string_view, std::string_view> schemas[] = {
#include "schema_texts.inc"
};

} // namespace

std::vector<std::string> schema_names() {
    std::vector<std::string> names;
    for (const auto& [name, text] : schemas)
        names.emplace_back(name);
    return names;
}

std::optional<std::string_view> find_schema(std::string_view name) noexcept {
    for (const auto& [known, text] : schemas) {
        if (known == name)
            return text;
    }
    return std::nullopt;
}

} // namespace isolux
