#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/cli/console.h"
#include "isolux/cli/text_table.h"
#include "isolux/cli/verbs.h"
#include "isolux/io/standard_json.h"

namespace isolux {

namespace {

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return text;
}

/// "Em 500 lx (1000), U0 0.6, UGR 19"; raised values stand in brackets.
std::string limits_in_words(const Standard& standard, const StandardRow& row) {
    std::vector<std::string> words;
    for (const StandardColumn& c : standard.columns) {
        const auto limit = find_limit(row, c.form.symbol);
        if (!limit)
            continue;
        if (!c.raises.empty() && !words.empty()) {
            words.back() += fmt::format(" ({:g})", *limit);
            continue;
        }
        words.push_back(fmt::format("{} {:g}", c.form.symbol, *limit));
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

bool matches(const Standard& standard,
             const StandardRow& row,
             const std::vector<std::string>& words) {
    const std::string text = lower(fmt::format("{} {} {} {} {}",
                                               standard.name,
                                               row.id,
                                               row.place,
                                               row.task,
                                               fmt::join(row.also, " ")));
    return std::ranges::all_of(
        words, [&](const std::string& w) { return text.find(lower(w)) != std::string::npos; });
}

std::string overview(const std::vector<Standard>& standards) {
    TextTable table(
        {{"standard", Align::left}, {"rows", Align::right}, {"title", Align::left}});
    for (const Standard& s : standards)
        table.add_row({s.name, fmt::format("{}", s.rows.size()), s.title});
    std::string text = table.text() + "\n";
    for (const Standard& s : standards) {
        std::string place;
        text += s.name + "\n";
        for (const StandardRow& row : s.rows)
            if (row.place != place) {
                place = row.place;
                text += "  " + place + "\n";
            }
    }
    return text + "\n`isolux standards WORD` lists the rows of a place or task.\n";
}

std::string source_line(const Standard& s, const StandardRow& row) {
    for (const StandardSource& source : s.sources)
        if (source.key == row.source)
            return source.key;
    return row.source;
}

ExitCode list_rows(const std::vector<std::string>& words, const std::string& file) {
    std::vector<Standard> standards = builtin_standards();
    if (!file.empty())
        standards = {read_standard(file)};
    if (words.empty()) {
        print(overview(standards));
        return ExitCode::success;
    }
    TextTable table({{"standard", Align::left},
                     {"row", Align::left},
                     {"task", Align::left},
                     {"limits (modified)", Align::left},
                     {"source", Align::left}});
    std::size_t found = 0;
    std::string notes;
    for (const Standard& s : standards)
        for (const StandardRow& row : s.rows)
            if (matches(s, row, words)) {
                ++found;
                table.add_row({s.name,
                               row.id,
                               row.place.empty() ? row.task : row.place + ": " + row.task,
                               limits_in_words(s, row),
                               source_line(s, row)});
                if (!row.note.empty())
                    notes += fmt::format("{}: {}\n", row.id, row.note);
            }
    if (found == 0)
        throw InputError("isolux standards",
                         fmt::format("no row holds '{}'", fmt::join(words, " ")),
                         "`isolux standards` lists the places");
    print(table.text() + (notes.empty() ? "" : "\n" + notes));
    return ExitCode::success;
}

} // namespace

Action add_standards(CLI::App& verb) {
    verb.description("List and search the standards' tables of requirements");
    verb.footer(R"(
Every WORD must stand in a row's number, place or task, or among the everyday words that its
table gives for it ("also"). "recalled" marks numbers that nobody has
compared with the printed standard.

Examples:
  isolux standards                      standards and places
  isolux standards office               rows of offices
  isolux standards 34.2
  isolux standards --file mine.json all rows of a table of your own that hold "all"

Exit status: 0 something was listed; 2 no row holds the words, or the file is wrong.)");

    struct Options {
        std::vector<std::string> words;
        std::string file;
    };

    const auto options = std::make_shared<Options>();
    verb.add_option("WORD", options->words, "Words to look for")->type_name("");
    verb.add_option("--file", options->file, "A table of your own instead of those built in")
        ->type_name("FILE");
    return [options] { return list_rows(options->words, options->file); };
}

} // namespace isolux
