#pragma once

#include <map>
#include <string>

namespace isolux::test {

/// The text of a small valid project (a 6 x 4 x 3 m office with six panels) in which some keys
/// of the top level have other values: JSON, or empty to leave the key out.
inline std::string small_project(const std::map<std::string, std::string>& changes = {}) {
    std::map<std::string, std::string> keys{
        {"isolux", "1"},
        {"maintenance_factor", "0.8"},
        {"rooms", R"([{"name": "office", "size": [6, 4], "height": 3}])"},
        {"luminaire_types", R"({"panel": {"lambertian": {"size": [0.6, 0.6], "flux": 4000}}})"},
        {"luminaires",
         R"([{"type": "panel", "field": {"room": "office", "rows": 2, "columns": 3}}])"},
    };
    for (const auto& [key, value] : changes)
        keys[key] = value;
    std::string text;
    for (const auto& [key, value] : keys)
        if (!value.empty())
            text += (text.empty() ? "{\"" : ",\n\"") + key + "\": " + value;
    return text + "}";
}

} // namespace isolux::test
