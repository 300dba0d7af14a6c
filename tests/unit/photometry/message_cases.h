#pragma once

#include <algorithm>
#include <ostream>
#include <string>

#include <gmock/gmock.h>

#include "isolux/photometry/read_photometry.h"

namespace isolux::messages {

/// A file's text and the one message that it must give.
struct Case {
    std::string name; ///< of the test
    std::string text;
    std::string message; ///< "line: what", a beginning is enough
};

inline void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

/// The first place where `from` stands, replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline void
expect_error(const Case& c, const std::string& file, const PhotometryOptions& options = {}) {
    try {
        static_cast<void>(parse_photometry(c.text, file, options));
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::StartsWith(file + ":" + c.message));
    }
}

/// The file is used, the message is told, and with `strict` it refuses the file unless it is
/// only a note.
inline void expect_notice(const Case& c,
                          const std::string& file,
                          bool is_note = false,
                          PhotometryOptions options = {}) {
    const auto parsed = parse_photometry(c.text, file, options);
    EXPECT_TRUE(std::ranges::any_of(parsed.notices, [&](const Message& m) {
        return to_string(m).starts_with(file + ":" + c.message);
    })) << testing::PrintToString([&] {
        std::string all;
        for (const Message& m : parsed.notices)
            all += to_string(m) + "\n";
        return all;
    }());
    options.strict = true;
    const auto read_strictly = [&] {
        static_cast<void>(parse_photometry(c.text, file, options));
    };
    if (is_note)
        EXPECT_NO_THROW(read_strictly());
    else
        EXPECT_THROW(read_strictly(), InputError);
}

} // namespace isolux::messages
