#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/io/json_value.h"

namespace isolux {

/// Everything that is wrong and everything that is odd about one file, by JSON pointer.
class Problems {
public:
    explicit Problems(std::string file) : file_(std::move(file)) {}

    void error(const std::string& pointer, std::string what, std::string hint = {});
    void notice(const std::string& pointer, std::string what, std::string hint = {});
    /// Messages that bring their own place, such as those of a luminaire file.
    void add_errors(std::vector<Message> messages);
    void add_notices(std::vector<Message> messages);

    [[nodiscard]] const std::string& file() const noexcept { return file_; }

    [[nodiscard]] const std::vector<Message>& errors() const noexcept { return errors_; }

    [[nodiscard]] const std::vector<Message>& notices() const noexcept { return notices_; }

    /// Whether an error lies at the pointer, above it or below it.
    [[nodiscard]] bool has_error_near(std::string_view pointer) const;

private:
    std::string file_;
    std::vector<std::string> error_pointers_;
    std::vector<Message> errors_;
    std::vector<Message> notices_;
};

/// `key` as one step of a JSON pointer (RFC 6901: "~" and "/" escaped).
[[nodiscard]] std::string pointer_step(std::string_view key);

/// A value and its place; what is wrong with it is told to `problems`.
class JsonNode {
public:
    JsonNode(const JsonValue& value, std::string pointer, Problems& problems)
        : value_(&value), pointer_(std::move(pointer)), problems_(&problems) {}

    [[nodiscard]] const JsonValue& value() const noexcept { return *value_; }

    [[nodiscard]] const std::string& pointer() const noexcept { return pointer_; }

    [[nodiscard]] Problems& problems() const noexcept { return *problems_; }

    void error(std::string what, std::string hint = {}) const;
    void notice(std::string what, std::string hint = {}) const;

    [[nodiscard]] bool is(JsonValue::Kind kind) const noexcept { return value_->kind == kind; }

    /// Element of a list. @pre a list, index < number of items
    [[nodiscard]] JsonNode item(std::size_t index) const;
    /// Member of an object, whether it exists or not. @pre an object
    [[nodiscard]] JsonNode member(std::string_view key, const JsonValue& value) const;

private:
    const JsonValue* value_;
    std::string pointer_;
    Problems* problems_;
};

/// What a number may be. `unit` is for messages.
struct NumberRange {
    double lower = 0.0;
    double upper = 0.0;
    bool above_lower = false; ///< the lower end itself is excluded
    std::string_view unit = {};
};

inline constexpr double furthest = 1e6; ///< m; no coordinate is larger
inline constexpr NumberRange any_length{0.0, furthest, true, " m"};
inline constexpr NumberRange any_distance{0.0, furthest, false, " m"};
inline constexpr NumberRange any_coordinate{-furthest, furthest, false, " m"};
inline constexpr NumberRange any_angle{-360'000.0, 360'000.0, false, " degrees"};
inline constexpr NumberRange any_share{0.0, 1.0};
inline constexpr NumberRange any_factor{-furthest, furthest}; ///< 0 is for the caller to refuse
inline constexpr NumberRange any_flux{0.0, 1e12, true, " lm"};

/// The share that a text such as "80%" means: 0.8.
[[nodiscard]] std::optional<double> percentage_in(std::string_view text);

// Each of these reports what is wrong and returns nothing then.
[[nodiscard]] std::optional<double> read_number(const JsonNode& node, const NumberRange& range);
[[nodiscard]] std::optional<double> read_length(const JsonNode& node); ///< above 0, m
[[nodiscard]] std::optional<std::int64_t>
read_integer(const JsonNode& node, std::int64_t lower, std::int64_t upper);
[[nodiscard]] std::optional<bool> read_boolean(const JsonNode& node);
/// Text that is not empty and not longer than `longest` bytes.
[[nodiscard]] std::optional<std::string> read_text(const JsonNode& node,
                                                   std::size_t longest = 200);
/// Index of the text among `choices`.
[[nodiscard]] std::optional<std::size_t> read_choice(const JsonNode& node,
                                                     std::span<const std::string_view> choices);
/// A list of `fewest` to `most` numbers; `form` is how it looks, "[x, y, z]".
[[nodiscard]] std::optional<std::vector<double>> read_numbers(const JsonNode& node,
                                                              std::size_t fewest,
                                                              std::size_t most,
                                                              std::string_view form,
                                                              const NumberRange& range);
/// The elements of a list. @param fewest  reports a shorter list
[[nodiscard]] std::vector<JsonNode> read_list(const JsonNode& node, std::size_t fewest = 0);

/// An object whose keys are known. Reports a value that is no object, unknown and repeated
/// keys.
class JsonObject {
public:
    /// @param noun  "a room", for messages
    /// @param is_known  accepts further keys, such as "wall 7"
    JsonObject(JsonNode node,
               std::string_view noun,
               std::initializer_list<const char*> keys,
               bool (*is_known)(std::string_view key) = nullptr);

    [[nodiscard]] const JsonNode& node() const noexcept { return node_; }

    [[nodiscard]] bool is_object() const noexcept { return node_.is(JsonValue::Kind::object); }

    [[nodiscard]] bool has(std::string_view key) const noexcept;
    [[nodiscard]] std::optional<JsonNode> find(std::string_view key) const;
    /// As find; reports a missing key.
    [[nodiscard]] std::optional<JsonNode> require(std::string_view key) const;

    /// What `read` makes of the member; a missing key is reported.
    template <class Read>
    [[nodiscard]] auto require(std::string_view key, const Read& read) const
        -> decltype(read(std::declval<const JsonNode&>())) {
        if (const std::optional<JsonNode> node = require(key))
            return read(*node);
        return std::nullopt;
    }

    /// The one of `keys` that is there; reports none and more than one.
    [[nodiscard]] std::optional<std::string>
    require_one_of(std::initializer_list<const char*> keys) const;
    /// Reports every one of `keys` that is there: "aim and tilt exclude each other".
    void exclude(std::string_view key, std::initializer_list<const char*> keys) const;

    // Optional values: the fallback when the key is missing or its value wrong (and reported).
    [[nodiscard]] double
    number(std::string_view key, const NumberRange& range, double fallback) const;
    [[nodiscard]] bool boolean(std::string_view key, bool fallback) const;
    [[nodiscard]] std::string text(std::string_view key, std::string fallback) const;

private:
    JsonNode node_;
    std::string noun_;
};

/// Reports members that are there twice (JSON parsers silently keep one of them).
void check_repeated_keys(const JsonNode& object);

} // namespace isolux
