#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace isolux {

struct JsonMember;

/// A JSON document as it was written: members keep their order, repeated keys are all there.
struct JsonValue {
    enum class Kind { null, boolean, number, text, array, object };

    Kind kind = Kind::null;
    bool boolean = false;
    bool is_integer = false; ///< a number written without point and exponent
    double number = 0.0;
    std::string text;
    std::vector<JsonValue> items;
    std::vector<JsonMember> members;

    [[nodiscard]] const JsonValue* find(std::string_view key) const noexcept;
};

struct JsonMember {
    std::string key;
    JsonValue value;
};

/// Parses JSON with // and /* */ comments.
/// @throws InputError  `source:line:column: ...` for what is no JSON, is nested deeper than
/// 100 levels or holds a text longer than 10 000 bytes
[[nodiscard]] JsonValue parse_json(std::string_view text, std::string_view source);

/// "a number", "text", "an object" ...
[[nodiscard]] std::string_view kind_in_words(const JsonValue& value) noexcept;

} // namespace isolux
