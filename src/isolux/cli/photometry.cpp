#include <array>
#include <charconv>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/cli/photometry_verbs.h"
#include "isolux/io/photometry_file.h"

namespace isolux {

namespace {

struct SubVerb {
    const char* name;
    Action (*add)(CLI::App&);
};

constexpr std::array sub_verbs{
    SubVerb{"info", add_photometry_info},
    SubVerb{"candela", add_photometry_candela},
    SubVerb{"convert", add_photometry_convert},
    SubVerb{"plot", add_photometry_plot},
    SubVerb{"ugr-table", add_photometry_ugr_table},
    SubVerb{"validate", add_photometry_validate},
};

std::size_t parse_lamp_set(const std::string& text) {
    int set = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), set);
    if (error != std::errc{} || end != text.data() + text.size() || set < 1)
        throw InputError("--lamp-set",
                         fmt::format("'{}' is not the number of a lamp set", text),
                         "They are counted from 1");
    return static_cast<std::size_t>(set - 1);
}

} // namespace

void add_luminaire_file_options(CLI::App& verb, LuminaireFileOptions& options) {
    verb.add_flag("--strict", options.strict, "Refuse what breaks a rule of the file's format");
    verb.add_option("--lamp-set", options.lamp_set, "EULUMDAT: which of the lamp sets, from 1")
        ->capture_default_str();
    verb.add_option(
        "--variant", options.variant, "GLDF: id or number of the product's variant");
}

Parsed<LuminairePhotometry> read_luminaire_file(const std::string& file,
                                                const LuminaireFileOptions& options) {
    PhotometryOptions reading;
    reading.strict = options.strict;
    reading.variant = options.variant;
    reading.lamp_set = parse_lamp_set(options.lamp_set);
    return read_photometry(file, reading);
}

std::size_t line_of(const Message& message) noexcept {
    const std::string_view where = message.where;
    const std::size_t colon = where.rfind(':');
    std::size_t line = 0;
    if (colon != std::string_view::npos)
        std::from_chars(where.data() + colon + 1, where.data() + where.size(), line);
    return line;
}

Action add_photometry(CLI::App& verb) {
    verb.description("Look into luminaire files: LM-63 (IES), EULUMDAT, TM-33, GLDF");
    verb.formatter(std::make_shared<CLI::Formatter>()); // the program's own says VERB
    verb.get_formatter()->label("SUBCOMMAND", "WHAT");
    std::vector<std::pair<CLI::App*, Action>> actions;
    for (const SubVerb& sub_verb : sub_verbs) {
        CLI::App* const sub = verb.add_subcommand(sub_verb.name)->group("What to do");
        actions.emplace_back(sub, sub_verb.add(*sub));
    }
    verb.require_subcommand(0, 1);
    verb.footer(R"(
Examples:
  isolux photometry info desk.ies         what the file says and what follows from it
  isolux photometry candela desk.ies 0 30 90 30
  isolux photometry convert desk.ldt desk.ies
  isolux photometry plot desk.ldt -o desk.svg
  isolux photometry ugr-table desk.ldt
  isolux photometry validate --strict *.ies
  isolux photometry info --help           options and examples of a sub-verb)");
    return [actions] {
        for (const auto& [sub, action] : actions)
            if (sub->parsed())
                return action();
        throw InputError("isolux photometry",
                         "it is not said what to do",
                         "`isolux photometry --help` lists what there is");
    };
}

} // namespace isolux
