#include "isolux/io/standard_json.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "isolux/io/json_lines.h"
#include "isolux/io/json_node.h"
#include "isolux/io/schema.h"
#include "isolux/io/suggest.h"
#include "isolux/io/text_file.h"

namespace isolux {

std::string_view standard_en_12464_1() noexcept; // embedded texts of standards/
std::string_view standard_en_12464_2() noexcept;
std::string_view standard_en_1838() noexcept;

namespace {

constexpr std::size_t longest_text = 2000;
constexpr NumberRange any_limit{0.0, 1e9};

/// The enumerator of type Word that a required member names.
template <class Word> Word read_word(const JsonObject& object, const char* key) {
    const std::optional<JsonNode> node = object.require(key);
    const std::optional<std::string> text = node ? read_text(*node) : std::nullopt;
    if (!text)
        return {};
    if (const std::optional<Word> word = find_word<Word>(*text))
        return *word;
    std::vector<std::string> known;
    for (int i = 0; !to_word(static_cast<Word>(i)).empty(); ++i)
        known.emplace_back(to_word(static_cast<Word>(i)));
    node->error(fmt::format("unknown {} \"{}\" (nothing like it can be judged)", key, *text),
                did_you_mean(*text, known));
    return {};
}

std::string require_text(const JsonObject& object, const char* key) {
    const std::optional<JsonNode> node = object.require(key);
    return node ? read_text(*node, longest_text).value_or("") : std::string();
}

/// A symbol or key that must be one of `known`.
void check_name(const JsonNode& node,
                const char* what,
                const std::string& name,
                const std::vector<std::string>& known) {
    if (!name.empty() && std::ranges::find(known, name) == known.end())
        node.error(fmt::format("unknown {} \"{}\" (the file has no such one)", what, name),
                   did_you_mean(name, known));
}

StandardColumn read_column_of(const JsonNode& node) {
    const JsonObject object(node,
                            "a column",
                            {"symbol",
                             "quantity",
                             "light",
                             "area",
                             "statistic",
                             "sense",
                             "unit",
                             "clause",
                             "name",
                             "raises",
                             "with",
                             "limit",
                             "recommendation",
                             "source"});
    StandardColumn c;
    c.form.symbol = require_text(object, "symbol");
    c.form.quantity = read_word<RequiredQuantity>(object, "quantity");
    if (object.has("light"))
        c.form.light = read_word<LightShare>(object, "light");
    c.form.area = read_word<RequiredArea>(object, "area");
    c.form.statistic = read_word<Statistic>(object, "statistic");
    c.form.sense = read_word<Sense>(object, "sense");
    c.form.unit = require_text(object, "unit");
    c.form.clause = require_text(object, "clause");
    c.form.name = require_text(object, "name");
    c.form.is_recommendation = object.boolean("recommendation", false);
    if (object.has("raises"))
        c.raises = object.text("raises", {});
    if (object.has("with"))
        c.with = object.text("with", {});
    if (object.has("source"))
        c.source = object.text("source", {});
    if (const std::optional<JsonNode> limit = object.find("limit"))
        c.limit = read_number(*limit, any_limit);
    if (c.limit.has_value() == c.with.empty())
        object.node().error("\"with\" and \"limit\" go together (the limit that comes with "
                            "another column)");
    return c;
}

StandardRow read_row_of(const JsonNode& node) {
    const JsonObject object(
        node,
        "a row",
        {"id", "clause", "place", "task", "limits", "source", "sources", "note", "also"});
    StandardRow row;
    row.id = require_text(object, "id");
    row.clause = require_text(object, "clause");
    row.task = require_text(object, "task");
    row.source = require_text(object, "source");
    row.place = object.has("place") ? object.text("place", {}) : std::string();
    row.note = object.has("note") ? object.text("note", {}) : std::string();
    if (const std::optional<JsonNode> also = object.find("also"))
        for (const JsonNode& n : read_list(*also, 1))
            if (const auto word = read_text(n))
                row.also.push_back(*word);
    if (const std::optional<JsonNode> limits = object.require("limits"))
        for (const JsonMember& m : limits->value().members)
            if (const auto limit = read_number(limits->member(m.key, m.value), any_limit))
                row.limits.emplace_back(m.key, *limit);
    if (const std::optional<JsonNode> sources = object.find("sources"))
        for (const JsonMember& m : sources->value().members)
            if (const auto key = read_text(sources->member(m.key, m.value)))
                row.sources.emplace_back(m.key, *key);
    return row;
}

/// Symbols and sources that are named exist; no row stands twice.
void check_names(const JsonObject& object, const Standard& s) {
    std::vector<std::string> symbols;
    std::vector<std::string> keys;
    for (const StandardColumn& c : s.columns)
        symbols.push_back(c.form.symbol);
    for (const StandardSource& source : s.sources)
        keys.push_back(source.key);
    for (std::size_t i = 0; i < s.columns.size(); ++i) {
        const JsonNode node = object.find("columns")->item(i);
        check_name(node, "column", s.columns[i].raises, symbols);
        check_name(node, "column", s.columns[i].with, symbols);
        check_name(node, "source", s.columns[i].source, keys);
    }
    std::set<std::string> ids;
    for (std::size_t i = 0; i < s.rows.size(); ++i) {
        const JsonNode node = object.find("rows")->item(i);
        const StandardRow& row = s.rows[i];
        if (!ids.insert(row.id).second)
            node.error(
                fmt::format("the row \"{}\" stands twice (which one is meant?)", row.id));
        for (const auto& [symbol, limit] : row.limits)
            check_name(node, "column", symbol, symbols);
        check_name(node, "source", row.source, keys);
        for (const auto& [symbol, key] : row.sources) {
            check_name(node, "column", symbol, symbols);
            check_name(node, "source", key, keys);
        }
    }
}

Standard read_standard_of(const JsonObject& object) {
    Standard s;
    s.name = require_text(object, "name");
    s.title = object.has("title") ? object.text("title", {}) : std::string();
    if (const std::optional<JsonNode> notes = object.find("notes"))
        for (const JsonNode& n : read_list(*notes))
            s.notes.push_back(read_text(n, longest_text).value_or(""));
    if (const std::optional<JsonNode> sources = object.require("sources"))
        for (const JsonNode& n : read_list(*sources, 1)) {
            const JsonObject source(n, "a source", {"key", "text"});
            s.sources.push_back({require_text(source, "key"), require_text(source, "text")});
        }
    if (const std::optional<JsonNode> columns = object.require("columns"))
        for (const JsonNode& n : read_list(*columns, 1))
            s.columns.push_back(read_column_of(n));
    if (const std::optional<JsonNode> rows = object.require("rows"))
        for (const JsonNode& n : read_list(*rows, 1))
            s.rows.push_back(read_row_of(n));
    return s;
}

} // namespace

Standard parse_standard(std::string_view text, std::string_view source) {
    const JsonValue document = parse_json(text, source);
    Problems problems{std::string(source)};
    const JsonObject object(
        JsonNode(document, "", problems),
        "a standard",
        {"$schema", "isolux_standard", "name", "title", "notes", "sources", "columns", "rows"});
    Standard s;
    if (object.is_object()) {
        const std::optional<JsonNode> version = object.require("isolux_standard");
        if (version
            && !(version->is(JsonValue::Kind::number) && version->value().number == 1.0))
            version->error("this version of the format is not known (the only one is 1)",
                           "Is a newer isolux needed?");
        s = read_standard_of(object);
        if (problems.errors().empty())
            check_names(object, s);
    }
    if (!problems.errors().empty()) {
        std::vector<Message> messages = problems.errors();
        add_lines(messages, problems.file(), text);
        throw InputError(std::move(messages));
    }
    return s;
}

Standard read_standard(const std::filesystem::path& path) {
    return parse_standard(read_file_bytes(path, FileLimits::project), path.generic_string());
}

std::vector<Standard> builtin_standards() {
    return {parse_standard(standard_en_12464_1(), "EN 12464-1"),
            parse_standard(standard_en_12464_2(), "EN 12464-2"),
            parse_standard(standard_en_1838(), "EN 1838")};
}

} // namespace isolux
