#include "isolux/cli/command_line.h"

#include <array>
#include <exception>
#include <filesystem>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/base/error.h"
#include "isolux/cli/console.h"
#include "isolux/cli/suggest.h"

namespace isolux {

namespace {

struct Verb {
    const char* name;
    Action (*add)(CLI::App&);
};

constexpr std::array verbs{
    Verb{"run", add_run},
    Verb{"sense", add_sense},
    Verb{"luminance", add_luminance},
    Verb{"render", add_render},
    Verb{"compare", add_compare},
    Verb{"check", add_check},
    Verb{"selftest", add_selftest},
    Verb{"reference", add_reference},
    Verb{"report", add_report},
    Verb{"experiment", add_experiment},
    Verb{"bench", add_bench},
    Verb{"schema", add_schema},
    Verb{"photometry", add_photometry},
    Verb{"standards", add_standards},
    Verb{"diff", add_diff},
    Verb{"scenes", add_scenes},
    Verb{"view", add_view},
};

constexpr const char* top_level_footer = R"(
Examples:
  isolux run projects/open-office         calculate everything in a project
  isolux check office.json                what is wrong or odd in it
  echo "2 3 0.75 0 0 1" | isolux sense office.json
  isolux photometry info desk.ies         what a luminaire file says
  isolux report results/open-office       HTML and PDF from the results
  isolux selftest                         compare the engine with known answers
  isolux run --help                       options and examples of a verb

Exit status: 0 done; 2 your files or options are wrong; 1 anything else.)";

std::vector<std::string> names_of_verbs() {
    std::vector<std::string> names;
    for (const Verb& verb : verbs)
        names.emplace_back(verb.name);
    return names;
}

/// The first word must be a verb. CLI11 would only say that something was not expected.
void check_first_word(const std::string& word) {
    if (word == "-h" || word == "--help" || word == "--version")
        return;
    if (word.starts_with('-'))
        throw InputError("isolux",
                         fmt::format("unknown option '{}'", word),
                         "The verb comes first, its options after it: `isolux run --help`");
    const std::vector<std::string> known = names_of_verbs();
    if (std::find(known.begin(), known.end(), word) != known.end())
        return;
    std::string hint = "`isolux --help` lists the verbs";
    if (const auto similar = find_similar(word, known))
        hint = fmt::format("Did you mean `isolux {}`?", *similar);
    else if (std::error_code ignored; std::filesystem::exists(word, ignored))
        hint = fmt::format("Did you mean `isolux run {}`?", word);
    throw InputError("isolux", fmt::format("'{}' is not a verb", word), hint);
}

/// A word that is none of the verb's own sub-commands, where it has some.
Message
unknown_subcommand(const CLI::App& app, const std::string& place, const std::string& word) {
    std::vector<std::string> known;
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
        known.push_back(sub->get_name());
    const auto similar = find_similar(word, known);
    return {place,
            fmt::format("'{}' is not known", word),
            similar ? fmt::format("Did you mean {}?", *similar)
                    : fmt::format("Known are {}", fmt::join(known, " and "))};
}

/// Words that the verb, or the sub-command chosen in it, could not place.
void find_left_over(const CLI::App& app,
                    const std::string& place,
                    std::vector<Message>& messages) {
    std::vector<std::string> known;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames())
            known.push_back("--" + name);
    }
    const bool has_choice = !app.get_subcommands([](const CLI::App*) { return true; }).empty();
    bool follows_unknown = false; // what follows an unknown option may be its value
    for (const std::string& word : app.remaining()) {
        const bool is_value = follows_unknown && !word.starts_with('-');
        follows_unknown = word.starts_with('-') && word.find('=') == std::string::npos;
        if (is_value)
            continue;
        if (!word.starts_with('-')) {
            if (has_choice && app.get_subcommands().empty()) {
                messages.push_back(unknown_subcommand(app, place, word));
                return; // what follows was meant for the one that is not known
            }
            messages.push_back({place, fmt::format("'{}' is one argument too many", word), ""});
            continue;
        }
        const std::string name = word.substr(0, word.find('='));
        const auto similar = find_similar(name, known);
        messages.push_back({place,
                            fmt::format("unknown option '{}'", name),
                            similar ? fmt::format("Did you mean {}?", *similar)
                                    : fmt::format("`{} --help` lists the options", place)});
    }
    for (const CLI::App* chosen : app.get_subcommands())
        find_left_over(*chosen, place + " " + chosen->get_name(), messages);
}

void check_left_over(const CLI::App& verb) {
    std::vector<Message> messages;
    find_left_over(verb, "isolux " + verb.get_name(), messages);
    if (!messages.empty())
        throw InputError(std::move(messages));
}

/// "isolux", the verb and what was chosen in it, as far as the words were understood.
std::string chosen_place(const CLI::App& app) {
    std::string place = "isolux";
    const CLI::App* at = &app;
    while (!at->get_subcommands().empty()) {
        at = at->get_subcommands().front();
        place += " " + at->get_name();
    }
    return place;
}

ExitCode parse_and_act(std::span<const std::string> arguments) {
    CLI::App app("isolux calculates what light does in a room: illuminance with its error.",
                 "isolux");
    app.require_subcommand(1);
    app.get_formatter()->label("SUBCOMMAND", "VERB");
    app.set_help_flag("-h,--help", "Print this help and exit");
    app.set_version_flag(
        "--version", "isolux " ISOLUX_VERSION, "Print the program's version and exit");
    std::vector<std::pair<CLI::App*, Action>> actions;
    for (const Verb& verb : verbs) {
        CLI::App* sub = app.add_subcommand(verb.name);
        sub->group("Verbs");
        sub->allow_extras();
        actions.emplace_back(sub, verb.add(*sub));
    }
    app.footer(top_level_footer); // only now: verbs added later would inherit it
    if (arguments.empty()) {
        print(app.help());
        return ExitCode::bad_input;
    }
    check_first_word(arguments.front());
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::CallForHelp&) {
        const auto chosen = app.get_subcommands();
        print(chosen.empty() ? app.help() : chosen.front()->help("isolux"));
        return ExitCode::success;
    } catch (const CLI::CallForVersion&) {
        print("isolux " ISOLUX_VERSION "\n");
        return ExitCode::success;
    } catch (const CLI::ParseError& e) {
        const std::string place = chosen_place(app);
        throw InputError(place, e.what(), fmt::format("See `{} --help`", place));
    }
    for (const auto& [verb, action] : actions) {
        if (!verb->parsed())
            continue;
        check_left_over(*verb);
        return action();
    }
    return ExitCode::failure;
}

} // namespace

ExitCode run_command_line(std::span<const std::string> arguments) noexcept {
    try {
        const ExitCode code = parse_and_act(arguments);
        flush_output();
        return code;
    } catch (const InputError& e) {
        for (const Message& message : e.messages())
            report_error(message);
        return ExitCode::bad_input;
    } catch (const OutputClosed&) {
        return ExitCode::success;
    } catch (const std::exception& e) {
        report_error({"", e.what(), ""});
    } catch (...) {
        report_error({"", "unknown failure", ""});
    }
    return ExitCode::failure;
}

} // namespace isolux
