#include "isolux/photometry/ies.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "isolux/photometry/findings.h"
#include "isolux/photometry/ies_tokens.h"
#include "isolux/photometry/source_text.h"

namespace isolux {

namespace {

using enum PhotometricFormat;

struct Version {
    std::string_view tag; ///< blanks removed, upper case
    PhotometricFormat format;
    bool is_official; ///< exactly what the standard asks for
};

/// The tags of the standards, and the misspelt ones that circulate.
constexpr std::array<Version, 14> versions{{{"IESNA91", lm63_1991, true},
                                            {"IESNA:LM-63-1995", lm63_1995, true},
                                            {"IESNA:LM-63-2002", lm63_2002, true},
                                            {"IES:LM-63-2019", lm63_2019, true},
                                            {"IESNA86", lm63_1986, false},
                                            {"IESNA:LM-63-1986", lm63_1986, false},
                                            {"IESNA:LM-63-1991", lm63_1991, false},
                                            {"IESNA95", lm63_1995, false},
                                            {"IESNA:LM-63-95", lm63_1995, false},
                                            {"IESNA02", lm63_2002, false},
                                            {"IESNA:LM-63-02", lm63_2002, false},
                                            {"IESNA2002", lm63_2002, false},
                                            {"IES:LM-63-2002", lm63_2002, false},
                                            {"IESNA:LM-63-2019", lm63_2019, false}}};

/// The first line that is not blank.
std::size_t version_line(const SourceText& text) {
    std::size_t n = 1;
    while (n < text.line_count() && trim(text.line(n)).empty())
        ++n;
    return n;
}

/// Gives the number of the first label line.
std::size_t read_version(IesDocument& document, const SourceText& text, Findings& findings) {
    const std::size_t number = version_line(text);
    const std::string_view line = text.line(number);
    std::string tag = to_upper(line);
    std::erase_if(tag, [](char c) { return c == ' ' || c == '\t'; });
    const auto known = std::ranges::find(versions, std::string_view(tag), &Version::tag);
    if (known != versions.end()) {
        document.format = known->format;
        document.version_line = trim(line);
        const bool is_exact = number == 1 && known->is_official && line.starts_with(tag)
                              && trim(line).size() == tag.size();
        if (!is_exact)
            findings.warn(number,
                          "version line " + quoted(trim(line))
                              + " is not as in any edition of LM-63 (read as "
                              + to_string(known->format) + ")");
        return number + 1;
    }
    if (tag.starts_with("IESNA") || tag.starts_with("IES:"))
        findings.warn(number,
                      "unknown version " + quoted(trim(line))
                          + " (read as LM-63-1986, where both ballast factors multiply)",
                      "A newer or misspelt edition?");
    else
        findings.note(1, "no version line (read as LM-63-1986)");
    return 1;
}

/// The value of a `TILT = value` line.
std::optional<std::string_view> tilt_value(std::string_view line) {
    line = trim(line);
    if (line.size() < 5 || to_upper(line.substr(0, 4)) != "TILT")
        return std::nullopt;
    line = trim(line.substr(4));
    if (!line.starts_with('='))
        return std::nullopt;
    return trim(line.substr(1));
}

IesLabel make_label(std::string_view line, std::size_t number) {
    const std::string_view text = trim(line);
    const std::size_t bracket = text.find(']');
    if (!text.starts_with('[') || bracket == std::string_view::npos)
        return {{}, std::string(text), number};
    return {to_upper(trim(text.substr(1, bracket - 1))),
            std::string(trim(text.substr(bracket + 1))),
            number};
}

/// Labels and the TILT line; gives the first line of the data.
std::size_t read_labels(IesDocument& document,
                        const SourceText& text,
                        std::size_t first,
                        Findings& findings) {
    for (std::size_t n = first; n <= text.line_count(); ++n) {
        if (const auto value = tilt_value(text.line(n))) {
            const std::string upper = to_upper(*value);
            document.tilt_line = n;
            document.tilt = upper == "NONE" || upper == "INCLUDE" ? upper : std::string(*value);
            if (value->empty()) {
                document.tilt = "NONE";
                findings.warn(n, "TILT= without a value (read as TILT=NONE)");
            }
            return n + 1;
        }
        document.labels.push_back(make_label(text.line(n), n));
    }
    findings.fail(text.last_line(),
                  "no line begins with TILT= (it ends the labels and starts the data)",
                  "Is this a LM-63 file?");
}

void check_required_keywords(const IesDocument& document, Findings& findings) {
    std::vector<std::string_view> required;
    if (document.format == lm63_1991)
        required = {"TEST", "MANUFAC"};
    else if (document.format == lm63_2002)
        required = {"TEST", "TESTLAB", "ISSUEDATE", "MANUFAC"};
    else if (document.format == lm63_2019)
        required = {"TEST", "TESTLAB", "ISSUEDATE", "MANUFAC", "FILEGENINFO"};
    std::string missing;
    for (const std::string_view keyword : required)
        if (std::ranges::find(document.labels, keyword, &IesLabel::keyword)
            == document.labels.end())
            missing += (missing.empty() ? "[" : ", [") + std::string(keyword) + "]";
    if (!missing.empty())
        findings.note(document.tilt_line,
                      "labels without " + missing + " (required by "
                          + to_string(document.format) + "; nothing depends on it here)");
}

IesTilt read_tilt(IesTokens& tokens, const Findings& findings) {
    IesTilt tilt;
    tilt.geometry = tokens.take_number("lamp-to-luminaire geometry");
    if (const double g = tilt.geometry.value; g != 1.0 && g != 2.0 && g != 3.0)
        findings.fail(tilt.geometry.line,
                      "lamp-to-luminaire geometry " + to_text(g) + " (must be 1, 2 or 3)");
    const FileNumber pairs = tokens.take_count("number of tilt angles", 1);
    const auto count = static_cast<std::size_t>(pairs.value);
    if (count > tokens.remaining() / 2)
        findings.fail(pairs.line,
                      std::to_string(count) + " tilt angles and factors announced, only "
                          + std::to_string(tokens.remaining())
                          + " numbers follow (the tilt block is missing or cut off)");
    tilt.angles = tokens.take_numbers(count, "tilt angle");
    tokens.expect_ascending(tilt.angles, "tilt angle");
    tilt.factors = tokens.take_numbers(count, "tilt factor");
    for (const FileNumber& f : tilt.factors)
        if (f.value < 0.0)
            findings.fail(f.line,
                          "tilt factor " + to_text(f.value) + " (must not be negative)");
    return tilt;
}

struct Counts {
    FileNumber vertical;
    FileNumber horizontal;
};

Counts read_header(IesDocument& document, IesTokens& tokens) {
    document.lamps = tokens.take_number("number of lamps");
    document.lumens_per_lamp = tokens.take_number("lumens per lamp");
    document.multiplier = tokens.take_number("candela multiplier");
    const Counts counts{tokens.take_count("number of vertical angles", 2),
                        tokens.take_count("number of horizontal angles", 1)};
    document.photometric_type = tokens.take_number("photometric type");
    document.units = tokens.take_number("units type");
    document.width = tokens.take_number("width of the luminous opening");
    document.length = tokens.take_number("length of the luminous opening");
    document.height = tokens.take_number("height of the luminous opening");
    document.ballast_factor = tokens.take_number("ballast factor");
    document.second_factor = tokens.take_number("second factor (future use)");
    document.input_watts = tokens.take_number("input watts");
    return counts;
}

/// Counts are held against what is there before anything of their size is allocated.
void read_table(IesDocument& document,
                IesTokens& tokens,
                const Counts& counts,
                const Findings& findings) {
    const auto nv = static_cast<std::uint64_t>(counts.vertical.value);
    const auto nh = static_cast<std::uint64_t>(counts.horizontal.value);
    const std::uint64_t wanted = nv + nh;
    if (wanted > tokens.remaining())
        findings.fail((nv > tokens.remaining() ? counts.vertical : counts.horizontal).line,
                      std::to_string(nv) + " vertical and " + std::to_string(nh)
                          + " horizontal angles announced, "
                          + std::to_string(tokens.remaining())
                          + " numbers follow (the angles alone need more)",
                      "Truncated file?");
    // A table that cannot be there at all is the header's fault; one that is a few lines short
    // was cut off at the end, and that is where the user should look.
    if (nv * nh > 8 * static_cast<std::uint64_t>(tokens.remaining()))
        findings.fail(counts.vertical.line,
                      std::to_string(nv) + " x " + std::to_string(nh) + " angles announced, "
                          + std::to_string(tokens.remaining())
                          + " numbers follow (the table needs " + std::to_string(nv * nh)
                          + ")");
    document.vertical = tokens.take_numbers(nv, "vertical angle");
    tokens.expect_ascending(document.vertical, "vertical angle");
    document.horizontal = tokens.take_numbers(nh, "horizontal angle");
    tokens.expect_ascending(document.horizontal, "horizontal angle");
    if (nv * nh > tokens.remaining()) {
        const std::size_t found = tokens.remaining();
        document.candela = tokens.take_numbers(found, "candela value"); // bad ones come first
        findings.fail(tokens.line(),
                      std::to_string(nv * nh) + " candela values announced, "
                          + std::to_string(found) + " found (the table cannot be filled)",
                      tokens.comma_hint("Truncated file?"));
    }
    document.candela = tokens.take_numbers(nv * nh, "candela value");
}

} // namespace

IesDocument parse_ies(const SourceText& text, Findings& findings) {
    if (text.line_count() == 0)
        findings.fail(1, "the file is empty (no photometry)");
    IesDocument document;
    document.source = findings.source();
    const std::size_t first_label = read_version(document, text, findings);
    IesTokens tokens(text, read_labels(document, text, first_label, findings), findings);
    check_required_keywords(document, findings);
    if (document.tilt == "INCLUDE")
        document.tilt_data = read_tilt(tokens, findings);
    const Counts counts = read_header(document, tokens);
    read_table(document, tokens, counts, findings);
    if (tokens.remaining() > 0)
        findings.warn(tokens.line(),
                      std::to_string(tokens.remaining())
                          + " more item(s) after the table, from " + quoted(tokens.peek())
                          + " on (ignored)");
    return document;
}

Parsed<IesDocument> parse_ies(std::string_view bytes, std::string_view source) {
    Findings findings(source);
    const SourceText text(bytes, findings);
    IesDocument document = parse_ies(text, findings);
    return {std::move(document), findings.notices()};
}

IesTilt parse_tilt_file(std::string_view bytes, std::string_view source) {
    Findings findings(source);
    const SourceText text(bytes, findings);
    IesTokens tokens(text, 1, findings);
    return read_tilt(tokens, findings);
}

std::string find_text(const IesDocument& document, std::string_view keyword) {
    std::string text;
    bool is_inside = false;
    for (const IesLabel& label : document.labels) {
        is_inside = label.keyword == keyword || (is_inside && label.keyword == "MORE");
        if (is_inside && !label.text.empty())
            text += (text.empty() ? "" : " ") + label.text;
    }
    return text;
}

double tilt_factor(const IesTilt& tilt, Angle angle) noexcept {
    const double a = angle.in_degrees();
    const auto above =
        std::ranges::find_if(tilt.angles, [a](const FileNumber& n) { return n.value > a; });
    const auto i = static_cast<std::size_t>(above - tilt.angles.begin());
    if (i == 0)
        return tilt.factors.front().value;
    if (i == tilt.angles.size())
        return tilt.factors.back().value;
    const double share =
        (a - tilt.angles[i - 1].value) / (tilt.angles[i].value - tilt.angles[i - 1].value);
    return tilt.factors[i - 1].value
           + share * (tilt.factors[i].value - tilt.factors[i - 1].value);
}

} // namespace isolux
