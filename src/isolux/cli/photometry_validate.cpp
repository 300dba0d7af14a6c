#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "isolux/cli/console.h"
#include "isolux/cli/photometry_verbs.h"

namespace isolux {

namespace {

struct Options {
    std::vector<std::string> files;
    LuminaireFileOptions reading;
};

/// Prints what there is to say about a file, a line a finding. False if it is refused.
bool validate(const std::string& file, const LuminaireFileOptions& reading) {
    std::vector<Message> findings;
    bool is_accepted = true;
    try {
        LuminaireFileOptions lenient = reading;
        lenient.strict = false;
        findings = read_luminaire_file(file, lenient).notices;
        if (reading.strict)
            static_cast<void>(read_luminaire_file(file, reading));
    } catch (const InputError& error) {
        is_accepted = false;
        if (findings.empty()) // strict refuses what the lenient reader has told already
            findings = error.messages();
    }
    std::string text;
    for (const Message& finding : findings)
        text += to_string(finding) + "\n";
    print(text);
    return is_accepted;
}

} // namespace

Action add_photometry_validate(CLI::App& verb) {
    verb.description("List what is wrong or odd in luminaire files");
    verb.footer(R"(
A line a finding: `file:line: problem (why). Suggestion?`; none for a file without fault.

Examples:
  isolux photometry validate *.ies *.ldt
  isolux photometry validate --strict desk.ies && echo by the book

Exit status: 0 all files can be used; 2 at least one cannot. With --strict a file that breaks a
rule of its format counts as one that cannot; mere notes do not count.)");
    const auto o = std::make_shared<Options>();
    verb.add_option("FILE", o->files, "Luminaire files")->required()->type_name("");
    add_luminaire_file_options(verb, o->reading);
    return [o] {
        bool are_all_accepted = true;
        for (const std::string& file : o->files)
            are_all_accepted = validate(file, o->reading) && are_all_accepted;
        return are_all_accepted ? ExitCode::success : ExitCode::bad_input;
    };
}

} // namespace isolux
