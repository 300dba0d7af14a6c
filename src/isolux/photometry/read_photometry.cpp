#include "isolux/photometry/read_photometry.h"

#include <optional>
#include <utility>

#include "isolux/photometry/file_number.h"
#include "isolux/photometry/findings.h"
#include "isolux/photometry/ies.h"
#include "isolux/photometry/ldt.h"
#include "isolux/photometry/source_text.h"

namespace isolux {

namespace {

enum class Content { lm63, eulumdat, xml, unknown };

bool has_tilt_line(const SourceText& text) {
    for (std::size_t n = 1; n <= text.line_count(); ++n) {
        const std::string_view line = trim(text.line(n));
        if (line.size() < 5 || to_upper(line.substr(0, 4)) != "TILT")
            continue;
        if (trim(line.substr(4)).starts_with('='))
            return true;
    }
    return false;
}

/// Lines 3, 4 and 6 (symmetry and counts) hold whole numbers in every EULUMDAT file.
bool looks_like_eulumdat(const SourceText& text) {
    constexpr std::size_t shortest = 40;
    if (text.line_count() < shortest)
        return false;
    for (const std::size_t n : {3, 4, 6}) {
        const auto value = parse_number(trim(text.line(n)));
        if (!value || !is_whole(*value))
            return false;
    }
    return true;
}

bool looks_like_lm63(const SourceText& text) {
    for (std::size_t n = 1; n <= text.line_count(); ++n) {
        const std::string line = to_upper(trim(text.line(n)));
        if (!line.empty())
            return line.starts_with("IESNA") || line.starts_with("IES:");
    }
    return false;
}

std::optional<Content> content_by_name(std::string_view source) {
    const std::string upper = to_upper(source);
    if (upper.ends_with(".IES"))
        return Content::lm63;
    if (upper.ends_with(".LDT"))
        return Content::eulumdat;
    return std::nullopt;
}

Content content_of(const SourceText& text, std::optional<Content> named) {
    const bool may_be_lm63 = has_tilt_line(text) || looks_like_lm63(text);
    const bool may_be_eulumdat = looks_like_eulumdat(text);
    if (may_be_lm63 && may_be_eulumdat) // a text field of one that looks like the other
        return named.value_or(Content::lm63);
    if (may_be_lm63)
        return Content::lm63;
    if (may_be_eulumdat)
        return Content::eulumdat;
    const bool may_be_xml = text.line_count() > 0 && trim(text.line(1)).starts_with('<');
    return may_be_xml ? Content::xml : Content::unknown;
}

/// The content decides; the name settles doubts.
Content decide(const SourceText& text, Findings& findings) {
    const auto named = content_by_name(findings.source());
    const Content found = content_of(text, named);
    if (found == Content::unknown) {
        if (named)
            return *named;
        findings.fail(1,
                      "neither LM-63 (no TILT= line) nor EULUMDAT (lines 3, 4 and 6 are no "
                      "numbers)",
                      "Is this a luminaire file?");
    }
    if (found == Content::xml)
        findings.fail(1,
                      "XML, not LM-63 or EULUMDAT (TM-33 files are not read here)",
                      "Ask the maker for an .ies or .ldt file");
    if (named && *named != found)
        findings.warn(1,
                      found == Content::lm63
                          ? "LM-63 content under a EULUMDAT name (read as LM-63)"
                          : "EULUMDAT content under a LM-63 name (read as EULUMDAT)",
                      "Rename the file?");
    return found;
}

} // namespace

Parsed<LuminairePhotometry> parse_photometry(std::string_view bytes,
                                             std::string_view source,
                                             const PhotometryOptions& options) {
    Findings findings(source);
    if (bytes.starts_with("PK\x03\x04"))
        findings.fail(1,
                      "a ZIP container, not LM-63 or EULUMDAT (GLDF files are not read here)",
                      "Unpack it and name the .ies or .ldt file inside");
    const SourceText text(bytes, findings);
    LuminairePhotometry model =
        decide(text, findings) == Content::lm63
            ? to_photometry(parse_ies(text, findings), options, findings)
            : to_photometry(parse_ldt(text, findings), options, findings);
    if (options.strict)
        findings.refuse_warnings();
    return {std::move(model), findings.notices()};
}

} // namespace isolux
