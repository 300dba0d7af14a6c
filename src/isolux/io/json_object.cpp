#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "isolux/io/json_node.h"
#include "isolux/io/suggest.h"
#include "isolux/io/words.h"

namespace isolux {

namespace {

std::string found(const JsonNode& node) {
    return fmt::format("found {}", kind_in_words(node.value()));
}

/// Other words that people write, and ours.
constexpr std::array<std::array<std::string_view, 2>, 14> other_words{{
    {"angle", "rotation"},
    {"dim", "dimming"},
    {"elevation", "floor_level"},
    {"fov", "field_of_view"},
    {"lumen", "flux"},
    {"lumens", "flux"},
    {"luminous_flux", "flux"},
    {"length", "size"},
    {"mounting_height", "height"},
    {"rotate", "rotation"},
    {"rotated", "rotation"},
    {"dimensions", "size"},
    {"reflectivity", "reflectance"},
    {"look_at", "target"},
}};

/// The one of our keys that another word stands for; empty: none of them.
std::string usual_word(std::string_view key, const std::vector<std::string>& known) {
    for (const auto& [theirs, ours] : other_words)
        if (key == theirs && std::find(known.begin(), known.end(), ours) != known.end())
            return std::string(ours);
    return {};
}

} // namespace

JsonObject::JsonObject(JsonNode node,
                       std::string_view noun,
                       std::initializer_list<const char*> keys,
                       bool (*is_known)(std::string_view key))
    : node_(std::move(node)), noun_(noun) {
    if (!is_object()) {
        node_.error(fmt::format("{} is an object {{...}} ({})", noun, found(node_)));
        return;
    }
    const std::vector<std::string> known(keys.begin(), keys.end());
    for (const JsonMember& member : node_.value().members) {
        if (std::find(known.begin(), known.end(), member.key) != known.end()
            || (is_known != nullptr && is_known(member.key)))
            continue;
        std::string hint = did_you_mean(member.key, known);
        if (const std::string word = usual_word(member.key, known); !word.empty())
            hint = fmt::format("Did you mean \"{}\"?", word);
        const std::string why = hint.empty() ? enumerate(known, "and") : std::string();
        node_.member(member.key, member.value)
            .error(why.empty() ? fmt::format(
                       "unknown key {} ({} has no such key)", in_quotes(member.key), noun)
                               : fmt::format("unknown key {} ({} has the keys {})",
                                             in_quotes(member.key),
                                             noun,
                                             why),
                   std::move(hint));
    }
    check_repeated_keys(node_);
}

bool JsonObject::has(std::string_view key) const noexcept {
    return is_object() && node_.value().find(key) != nullptr;
}

std::optional<JsonNode> JsonObject::find(std::string_view key) const {
    const JsonValue* value = is_object() ? node_.value().find(key) : nullptr;
    return value != nullptr ? std::optional(node_.member(key, *value)) : std::nullopt;
}

std::optional<JsonNode> JsonObject::require(std::string_view key) const {
    std::optional<JsonNode> node = find(key);
    if (!node && is_object())
        node_.error(fmt::format("the key \"{}\" is missing ({} needs it)", key, noun_));
    return node;
}

std::optional<std::string>
JsonObject::require_one_of(std::initializer_list<const char*> keys) const {
    if (!is_object())
        return std::nullopt;
    const std::vector<std::string> all(keys.begin(), keys.end());
    std::vector<std::string> present;
    for (const std::string& key : all)
        if (has(key))
            present.push_back(key);
    if (present.size() == 1)
        return present.front();
    if (present.empty())
        node_.error(
            fmt::format("{} needs one of {} (none is given)", noun_, enumerate(all, "and")));
    else
        node_.error(fmt::format(
            "{} exclude each other ({} has one of them)", enumerate(present, "and"), noun_));
    return std::nullopt;
}

void JsonObject::exclude(std::string_view key, std::initializer_list<const char*> keys) const {
    if (!has(key))
        return;
    for (const char* other : keys)
        if (const std::optional<JsonNode> node = find(other))
            node->error(fmt::format(
                "\"{}\" does not go with \"{}\" (give one of the two)", other, key));
}

double
JsonObject::number(std::string_view key, const NumberRange& range, double fallback) const {
    const std::optional<JsonNode> node = find(key);
    return node ? read_number(*node, range).value_or(fallback) : fallback;
}

bool JsonObject::boolean(std::string_view key, bool fallback) const {
    const std::optional<JsonNode> node = find(key);
    return node ? read_boolean(*node).value_or(fallback) : fallback;
}

std::string JsonObject::text(std::string_view key, std::string fallback) const {
    const std::optional<JsonNode> node = find(key);
    return node ? read_text(*node).value_or(std::move(fallback)) : fallback;
}

void check_repeated_keys(const JsonNode& object) {
    std::set<std::string_view> seen;
    for (const JsonMember& member : object.value().members)
        if (!seen.insert(member.key).second)
            object.member(member.key, member.value)
                .error(fmt::format("the key {} is there twice (only one can count)",
                                   in_quotes(member.key)));
}

} // namespace isolux
