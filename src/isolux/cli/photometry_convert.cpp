#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/cli/console.h"
#include "isolux/cli/photometry_verbs.h"
#include "isolux/cli/suggest.h"
#include "isolux/io/safe_file.h"
#include "isolux/photometry/write_ies.h"
#include "isolux/photometry/write_ldt.h"

namespace isolux {

namespace {

struct Options {
    std::string in;
    std::string out;
    std::string format;
    LuminaireFileOptions reading;
};

PhotometricFormat named_format(const std::string& name) {
    if (name == "lm63-2019")
        return PhotometricFormat::lm63_2019;
    if (name == "lm63-2002")
        return PhotometricFormat::lm63_2002;
    if (name == "eulumdat")
        return PhotometricFormat::eulumdat;
    const auto similar =
        find_similar(name, std::vector<std::string>{"lm63-2019", "lm63-2002", "eulumdat"});
    throw InputError("--format",
                     fmt::format("'{}' is not a format that can be written", name),
                     similar ? fmt::format("Did you mean {}?", *similar)
                             : "Known are lm63-2019, lm63-2002 and eulumdat");
}

PhotometricFormat format_of(const Options& o) {
    if (!o.format.empty())
        return named_format(o.format);
    std::string extension = std::filesystem::path(o.out).extension().string();
    for (char& c : extension)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (extension == ".ies")
        return PhotometricFormat::lm63_2019;
    if (extension == ".ldt")
        return PhotometricFormat::eulumdat;
    throw InputError(o.out,
                     "the name does not tell the format to write (.ies or .ldt would)",
                     "Give --format lm63-2019, lm63-2002 or eulumdat");
}

Parsed<std::string> to_file_text(const LuminairePhotometry& l,
                                 PhotometricFormat format,
                                 const std::string& file_name) {
    if (format == PhotometricFormat::eulumdat)
        return write_ldt(l,
                         {.report = l.report, .file_name = file_name, .date_and_user = l.date});
    IesWriteOptions writing;
    writing.edition = format;
    if (!l.report.empty())
        writing.test = l.report;
    if (!l.laboratory.empty())
        writing.laboratory = l.laboratory;
    writing.issue_date = l.date;
    return write_ies(l, writing);
}

ExitCode convert(const Options& o) {
    const PhotometricFormat format = format_of(o);
    const auto parsed = read_luminaire_file(o.in, o.reading);
    const std::filesystem::path out(o.out);
    const Parsed<std::string> text =
        to_file_text(parsed.value, format, out.filename().string());
    write_file_safely(out, text.value);
    for (const Message& notice : parsed.notices)
        report_notice(notice);
    for (const Message& notice : text.notices)
        report_notice({o.out, notice.what, notice.hint});
    print(fmt::format("{}: {}, {:.6g} lm\n",
                      o.out,
                      to_string(format),
                      in_lumen(parsed.value.distribution.flux_trapezoid())));
    return ExitCode::success;
}

} // namespace

Action add_photometry_convert(CLI::App& verb) {
    verb.description("Write a luminaire in another format");
    verb.footer(R"(
The light stays where it is in the world: angles keep their numbers, and the body's length and
width change places between LM-63 (length along C0-C180) and EULUMDAT (along C90-C270).

Examples:
  isolux photometry convert desk.ldt desk.ies
  isolux photometry convert --format lm63-2002 desk.ldt desk.ies
  isolux photometry convert --lamp-set 2 downlight.ldt downlight-warm.ldt)");
    const auto o = std::make_shared<Options>();
    verb.add_option("IN", o->in, "The luminaire file to read")->required()->type_name("");
    verb.add_option("OUT", o->out, "The file to write: .ies or .ldt")
        ->required()
        ->type_name("");
    verb.add_option(
        "--format", o->format, "lm63-2019 (for .ies if not given), lm63-2002 or eulumdat");
    add_luminaire_file_options(verb, o->reading);
    return [o] { return convert(*o); };
}

} // namespace isolux
