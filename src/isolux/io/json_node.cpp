#include "isolux/io/json_node.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "isolux/io/suggest.h"
#include "isolux/io/words.h"

namespace isolux {

namespace {

bool is_above(std::string_view pointer, std::string_view below) {
    return below.substr(0, pointer.size()) == pointer
           && (below.size() == pointer.size() || below[pointer.size()] == '/');
}

std::string found(const JsonNode& node) {
    return fmt::format("found {}", kind_in_words(node.value()));
}

} // namespace

void Problems::error(const std::string& pointer, std::string what, std::string hint) {
    error_pointers_.push_back(pointer);
    errors_.push_back({file_ + "#" + pointer, std::move(what), std::move(hint)});
}

void Problems::notice(const std::string& pointer, std::string what, std::string hint) {
    notices_.push_back({file_ + "#" + pointer, std::move(what), std::move(hint)});
}

void Problems::add_errors(std::vector<Message> messages) {
    for (Message& message : messages)
        errors_.push_back(std::move(message));
}

void Problems::add_notices(std::vector<Message> messages) {
    for (Message& message : messages)
        notices_.push_back(std::move(message));
}

bool Problems::has_error_near(std::string_view pointer) const {
    return std::any_of(
        error_pointers_.begin(), error_pointers_.end(), [&](const std::string& known) {
            return is_above(known, pointer) || is_above(pointer, known);
        });
}

std::string pointer_step(std::string_view key) {
    std::string step = "/";
    for (const char c : key) {
        if (c == '~')
            step += "~0";
        else if (c == '/')
            step += "~1";
        else
            step += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return step;
}

void JsonNode::error(std::string what, std::string hint) const {
    problems_->error(pointer_, std::move(what), std::move(hint));
}

void JsonNode::notice(std::string what, std::string hint) const {
    problems_->notice(pointer_, std::move(what), std::move(hint));
}

JsonNode JsonNode::item(std::size_t index) const {
    return {value_->items[index], fmt::format("{}/{}", pointer_, index), *problems_};
}

JsonNode JsonNode::member(std::string_view key, const JsonValue& value) const {
    return {value, pointer_ + pointer_step(key), *problems_};
}

std::optional<double> percentage_in(std::string_view text) {
    double value = 0.0;
    const auto [rest, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    std::string_view unit = text.substr(static_cast<std::size_t>(rest - text.data()));
    unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
    return failed == std::errc() && unit == "%" ? std::optional(value / 100.0) : std::nullopt;
}

std::optional<double> read_number(const JsonNode& node, const NumberRange& range) {
    if (!node.is(JsonValue::Kind::number)) {
        double value = 0.0;
        const std::string& text = node.value().text;
        const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_quoted = parsed.ec == std::errc();
        std::string hint = is_quoted ? fmt::format("Write {} without quotes?", value) : "";
        if (const std::optional<double> share = percentage_in(text);
            share && range.unit.empty() && range.upper <= 10.0)
            hint = fmt::format("Write {:.4g} for {:.4g} %?", *share, 100.0 * *share);
        node.error(fmt::format("a number is expected here ({})", found(node)), hint);
        return std::nullopt;
    }
    const double value = node.value().number;
    const bool too_small = range.above_lower ? value <= range.lower : value < range.lower;
    if (!too_small && value <= range.upper)
        return value;
    const bool is_percent =
        range.upper == 1.0 && range.unit.empty() && value >= 2.0 && value <= 100.0;
    node.error(fmt::format("{} is too {} (it must be {} {}{})",
                           value,
                           too_small ? "small" : "large",
                           too_small ? (range.above_lower ? "above" : "at least") : "at most",
                           too_small ? range.lower : range.upper,
                           range.unit),
               is_percent ? fmt::format("Write {:.4g} for {} %?", value / 100.0, value)
                          : std::string());
    return std::nullopt;
}

std::optional<double> read_length(const JsonNode& node) {
    return read_number(node, any_length);
}

std::optional<std::int64_t>
read_integer(const JsonNode& node, std::int64_t lower, std::int64_t upper) {
    const NumberRange range{static_cast<double>(lower), static_cast<double>(upper)};
    const std::optional<double> value = read_number(node, range);
    if (!value)
        return std::nullopt;
    const auto integer = static_cast<std::int64_t>(*value);
    if (static_cast<double>(integer) == *value)
        return integer;
    node.error(fmt::format("{} is not a whole number (only whole numbers count here)", *value));
    return std::nullopt;
}

std::optional<bool> read_boolean(const JsonNode& node) {
    if (node.is(JsonValue::Kind::boolean))
        return node.value().boolean;
    node.error(fmt::format("true or false is expected here ({})", found(node)));
    return std::nullopt;
}

std::optional<std::string> read_text(const JsonNode& node, std::size_t longest) {
    if (!node.is(JsonValue::Kind::text)) {
        node.error(fmt::format("text is expected here ({})", found(node)),
                   node.is(JsonValue::Kind::number)
                       ? fmt::format("Write \"{}\" in quotes?", node.value().number)
                       : std::string());
        return std::nullopt;
    }
    const std::string& text = node.value().text;
    if (text.empty()) {
        node.error("the text is empty (something must stand here)");
        return std::nullopt;
    }
    if (text.size() > longest) {
        node.error(
            fmt::format("the text is too long ({} bytes, at most {})", text.size(), longest));
        return std::nullopt;
    }
    return text;
}

std::optional<std::size_t> read_choice(const JsonNode& node,
                                       std::span<const std::string_view> choices) {
    const std::vector<std::string> words(choices.begin(), choices.end());
    if (!node.is(JsonValue::Kind::text)) {
        node.error(
            fmt::format("{} is expected here ({})", enumerate(words, "or"), found(node)));
        return std::nullopt;
    }
    const auto chosen = std::find(words.begin(), words.end(), node.value().text);
    if (chosen != words.end())
        return static_cast<std::size_t>(chosen - words.begin());
    node.error(fmt::format("{} is not known here (it must be {})",
                           in_quotes(node.value().text),
                           enumerate(words, "or")),
               did_you_mean(node.value().text, words));
    return std::nullopt;
}

std::optional<std::vector<double>> read_numbers(const JsonNode& node,
                                                std::size_t fewest,
                                                std::size_t most,
                                                std::string_view form,
                                                const NumberRange& range) {
    if (!node.is(JsonValue::Kind::array)) {
        node.error(fmt::format("a list {} is expected here ({})", form, found(node)));
        return std::nullopt;
    }
    const std::size_t count = node.value().items.size();
    if (count < fewest || count > most) {
        node.error(fmt::format("a list {} is expected here (found {} element{})",
                               form,
                               count,
                               count == 1 ? "" : "s"));
        return std::nullopt;
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i)
        if (const std::optional<double> number = read_number(node.item(i), range))
            numbers.push_back(*number);
    return numbers.size() == count ? std::optional(std::move(numbers)) : std::nullopt;
}

std::vector<JsonNode> read_list(const JsonNode& node, std::size_t fewest) {
    std::vector<JsonNode> items;
    if (!node.is(JsonValue::Kind::array)) {
        node.error(fmt::format("a list is expected here ({})", found(node)));
        return items;
    }
    const std::size_t count = node.value().items.size();
    if (count < fewest)
        node.error(fmt::format("the list has {} element{} (at least {} needed)",
                               count,
                               count == 1 ? "" : "s",
                               fewest));
    for (std::size_t i = 0; i < count; ++i)
        items.push_back(node.item(i));
    return items;
}

} // namespace isolux
