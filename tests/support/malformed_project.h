#pragma once

#include <ostream>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/io/project_json.h"
#include "isolux/io/schema_check.h"

#include "support/small_project.h"

namespace isolux::test {

/// One wrong key in an otherwise good project, and the very words that tell the user.
struct Malformed {
    const char* name;
    const char* key;             ///< of the top level
    const char* value;           ///< JSON; empty: the key is left out
    const char* messages;        ///< all of them, a line each, the file's name left out
    bool against_schema = false; ///< the schema alone tells that it is wrong
};

inline constexpr bool shape = true; ///< for Malformed::against_schema

inline std::ostream& operator<<(std::ostream& out, const Malformed& m) { return out << m.name; }

inline std::string name_of(const testing::TestParamInfo<Malformed>& info) {
    return info.param.name;
}

/// A message about the file p.json without "p.json", and about a value in it, without the line
/// before the pointer. (Lines have tests of their own.)
inline std::string without_file(const std::string& message) {
    static const std::regex place("^p\\.json(:[1-9][0-9]*: (?=#/))?");
    return std::regex_replace(message, place, "");
}

/// What the user is told about the text of a file p.json, without "p.json" and the line.
inline std::string errors_of(const std::string& text) {
    const std::string file = "p.json";
    try {
        static_cast<void>(parse_project(text, file));
        return "";
    } catch (const InputError& error) {
        std::string all;
        for (const Message& message : error.messages()) {
            const std::string line = to_string(message);
            all += (all.empty() ? "" : "\n") + without_file(line);
        }
        return all;
    }
}

inline void expect_these_words(const Malformed& m) {
    EXPECT_EQ(errors_of(small_project({{m.key, m.value}})), m.messages);
}

inline void expect_schema_agrees(const Malformed& m) {
    EXPECT_EQ(!check_project_schema(small_project({{m.key, m.value}})).empty(),
              m.against_schema);
}

} // namespace isolux::test
