#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "isolux/cli/console.h"
#include "isolux/cli/luminaire_json.h"
#include "isolux/cli/luminaire_text.h"
#include "isolux/cli/photometry_verbs.h"

namespace isolux {

namespace {

struct Options {
    std::vector<std::string> files;
    LuminaireFileOptions reading;
    bool as_json = false;
};

ReadLuminaire read_one(const std::string& file, const LuminaireFileOptions& reading) {
    ReadLuminaire result{file, std::nullopt, {}};
    try {
        result.parsed = read_luminaire_file(file, reading);
    } catch (const InputError& error) {
        result.errors = error.messages();
    }
    return result;
}

void print_text(const std::vector<ReadLuminaire>& luminaires) {
    for (const ReadLuminaire& l : luminaires) {
        if (!l.parsed)
            continue;
        std::string text = to_info_text(l.file, l.parsed->value);
        for (const Message& notice : l.parsed->notices)
            text += "  notice: " + to_string(notice) + "\n";
        print(text);
    }
}

/// Every file is looked at, also after one that cannot be read.
ExitCode print_info(const Options& o) {
    std::vector<ReadLuminaire> luminaires;
    ExitCode code = ExitCode::success;
    for (const std::string& file : o.files) {
        luminaires.push_back(read_one(file, o.reading));
        for (const Message& error : luminaires.back().errors)
            report_error(error);
        if (!luminaires.back().parsed)
            code = ExitCode::bad_input;
    }
    if (o.as_json)
        print(to_json_text(luminaires));
    else
        print_text(luminaires);
    return code;
}

} // namespace

Action add_photometry_info(CLI::App& verb) {
    verb.description("What luminaire files say, and what follows from it");
    verb.footer(R"(
Examples:
  isolux photometry info desk.ies
  isolux photometry info --json desk.ldt | jq .flux_lm
  isolux photometry info --lamp-set 2 downlight.ldt

With --json one file gives an object, several give an array of them.
Exit status: 0 all files could be read; 2 at least one could not.)");
    const auto o = std::make_shared<Options>();
    verb.add_option("FILE", o->files, "Luminaire files")->required()->type_name("");
    verb.add_flag("--json", o->as_json, "Print JSON with all digits");
    add_luminaire_file_options(verb, o->reading);
    return [o] { return print_info(*o); };
}

} // namespace isolux
