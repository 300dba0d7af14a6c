#include "isolux/io/json_value.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/base/error.h"

namespace isolux {

namespace {

constexpr std::size_t deepest_nesting = 100;
constexpr std::size_t longest_text = 10'000;

/// What nlohmann's parser tells us becomes a JsonValue. Events come in file order.
class DocumentBuilder : public nlohmann::json_sax<nlohmann::json> {
public:
    bool null() override { return add(JsonValue{}); }

    bool boolean(bool value) override {
        JsonValue v;
        v.kind = JsonValue::Kind::boolean;
        v.boolean = value;
        return add(std::move(v));
    }

    bool number_integer(number_integer_t value) override {
        return add_number(static_cast<double>(value), true);
    }

    bool number_unsigned(number_unsigned_t value) override {
        return add_number(static_cast<double>(value), true);
    }

    bool number_float(number_float_t value, const string_t&) override {
        return add_number(value, false);
    }

    bool string(string_t& value) override {
        if (value.size() > longest_text)
            return fail("a text of more than 10000 bytes (no key needs one)");
        JsonValue v;
        v.kind = JsonValue::Kind::text;
        v.text = std::move(value);
        return add(std::move(v));
    }

    bool binary(binary_t&) override { return false; }

    bool start_object(std::size_t) override { return open(JsonValue::Kind::object); }

    bool key(string_t& value) override {
        if (value.size() > longest_text)
            return fail("a key of more than 10000 bytes");
        stack_.back().members.push_back({std::move(value), {}});
        return true;
    }

    bool end_object() override { return close(); }

    bool start_array(std::size_t) override { return open(JsonValue::Kind::array); }

    bool end_array() override { return close(); }

    bool parse_error(std::size_t position,
                     const std::string&,
                     const nlohmann::json::exception& error) override {
        position_ = position;
        problem_ = error.what();
        is_syntax_ = true;
        return false;
    }

    JsonValue root;

    [[nodiscard]] std::size_t position() const { return position_; }

    [[nodiscard]] const std::string& problem() const { return problem_; }

    [[nodiscard]] bool is_syntax() const { return is_syntax_; }

private:
    bool fail(const char* problem) {
        problem_ = problem;
        return false;
    }

    bool add_number(double value, bool is_integer) {
        JsonValue v;
        v.kind = JsonValue::Kind::number;
        v.number = value;
        v.is_integer = is_integer;
        return add(std::move(v));
    }

    bool add(JsonValue&& value) {
        if (stack_.empty())
            root = std::move(value);
        else if (stack_.back().kind == JsonValue::Kind::array)
            stack_.back().items.push_back(std::move(value));
        else
            stack_.back().members.back().value = std::move(value);
        return true;
    }

    bool open(JsonValue::Kind kind) {
        if (stack_.size() >= deepest_nesting)
            return fail("nested more than 100 levels deep (no key needs that)");
        stack_.emplace_back().kind = kind;
        return true;
    }

    bool close() {
        JsonValue done = std::move(stack_.back());
        stack_.pop_back();
        return add(std::move(done));
    }

    std::vector<JsonValue> stack_;
    std::size_t position_ = 0;
    std::string problem_;
    bool is_syntax_ = false;
};

std::string place_of(std::string_view text, std::size_t offset, std::string_view source) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t start = before.rfind('\n') + 1; // npos + 1 is 0
    return fmt::format("{}:{}:{}", source, line, before.size() - start + 1);
}

/// The parser's own words without its place and its jargon:
/// "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while
/// parsing value - unexpected end of input; expected ...".
std::string reason_of(const std::string& words) {
    std::string reason = words;
    if (const std::size_t dash = reason.find(" - "); dash != std::string::npos)
        reason.erase(0, dash + 3);
    else if (const std::size_t bracket = reason.find("] "); bracket != std::string::npos)
        reason.erase(0, bracket + 2);
    if (const std::size_t last = reason.find("; last read: "); last != std::string::npos) {
        const std::size_t expected = reason.find("; expected", last + 1);
        reason.erase(last, expected == std::string::npos ? std::string::npos : expected - last);
    }
    return reason;
}

/// The parser stops at the end of an offending text; its place is where it starts.
std::size_t start_of_token(std::string_view text, std::size_t end) {
    if (end == 0 || end >= text.size() || text[end] != '"')
        return end;
    std::size_t start = end - 1;
    const auto is_quote = [&](std::size_t i) {
        return text[i] == '"' && (i == 0 || text[i - 1] != '\\');
    };
    while (start > 0 && !is_quote(start) && text[start] != '\n')
        --start;
    return is_quote(start) ? start : end;
}

std::string hint_for(std::string_view text, std::size_t offset) {
    std::size_t i = std::min(offset, text.size());
    const auto is_blank = [](char c) {
        return std::isspace(static_cast<unsigned char>(c)) != 0;
    };
    const char here = i < text.size() ? text[i] : '\0';
    while (i > 0 && is_blank(text[i - 1]))
        --i;
    const char last = i > 0 ? text[i - 1] : '\0';
    if ((here == '}' || here == ']') && last == ',')
        return "Remove the comma before it?";
    if (here == ',' && (last == ',' || last == '[' || last == '{'))
        return last == ',' ? "Remove one of the two commas?" : "Remove the comma?";
    const bool starts_value = here == '"' || here == '{' || here == '[';
    const bool ended_value = last == '"' || last == '}' || last == ']'
                             || std::isalnum(static_cast<unsigned char>(last)) != 0;
    if (starts_value && ended_value)
        return "Is a comma missing before it?";
    if (here == '\'')
        return "Write texts in double quotes?";
    return {};
}

} // namespace

const JsonValue* JsonValue::find(std::string_view key) const noexcept {
    for (const JsonMember& member : members)
        if (member.key == key)
            return &member.value;
    return nullptr;
}

JsonValue parse_json(std::string_view text, std::string_view source) {
    DocumentBuilder builder;
    constexpr bool strict = true;
    constexpr bool ignore_comments = true;
    const bool parsed = nlohmann::json::sax_parse(
        text, &builder, nlohmann::json::input_format_t::json, strict, ignore_comments);
    if (parsed)
        return std::move(builder.root);
    if (!builder.is_syntax())
        throw InputError(std::string(source), builder.problem());
    // The parser counts the bytes it has read, the offending one included.
    const std::size_t end = builder.position() > 0 ? builder.position() - 1 : 0;
    const std::size_t offset = start_of_token(text, end);
    throw InputError(place_of(text, offset, source),
                     "not valid JSON (" + reason_of(builder.problem()) + ")",
                     hint_for(text, offset));
}

std::string_view kind_in_words(const JsonValue& value) noexcept {
    switch (value.kind) {
    case JsonValue::Kind::null:
        return "null";
    case JsonValue::Kind::boolean:
        return value.boolean ? "true" : "false";
    case JsonValue::Kind::number:
        return "a number";
    case JsonValue::Kind::text:
        return "text";
    case JsonValue::Kind::array:
        return "a list";
    case JsonValue::Kind::object:
        return "an object";
    }
    return "something else";
}

} // namespace isolux
