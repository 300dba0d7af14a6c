#include "isolux/photometry/read_photometry.h"

#include <optional>
#include <utility>

#include "isolux/photometry/file_number.h"
#include "isolux/photometry/findings.h"
#include "isolux/photometry/gldf.h"
#include "isolux/photometry/ies.h"
#include "isolux/photometry/ldt.h"
#include "isolux/photometry/source_text.h"
#include "isolux/photometry/tm33.h"

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

/// The first line that is not blank begins with a tag.
bool is_xml(const SourceText& text) {
    for (std::size_t n = 1; n <= text.line_count(); ++n)
        if (const std::string_view line = trim(text.line(n)); !line.empty())
            return line.starts_with('<');
    return false;
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
    if (upper.ends_with(".XML") || upper.ends_with(".TM33"))
        return Content::xml;
    return std::nullopt;
}

Content content_of(const SourceText& text, std::optional<Content> named) {
    if (named == Content::xml && is_xml(text)) // whatever its texts look like
        return Content::xml;
    const bool may_be_lm63 = has_tilt_line(text) || looks_like_lm63(text);
    const bool may_be_eulumdat = looks_like_eulumdat(text);
    if (may_be_lm63 && may_be_eulumdat) // a text field of one that looks like the other
        return named.value_or(Content::lm63);
    if (may_be_lm63)
        return Content::lm63;
    if (may_be_eulumdat)
        return Content::eulumdat;
    return is_xml(text) ? Content::xml : Content::unknown;
}

std::string_view name_of(Content content) {
    switch (content) {
    case Content::lm63:
        return "LM-63";
    case Content::eulumdat:
        return "EULUMDAT";
    case Content::xml:
        return "TM-33";
    case Content::unknown:
        break;
    }
    return "unknown";
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
                      "numbers) nor TM-33 (no XML)",
                      "Is this a luminaire file?");
    }
    if (named && *named != found) {
        const std::string content(name_of(found));
        findings.warn(1,
                      content + " content under a " + std::string(name_of(*named))
                          + " name (read as " + content + ")",
                      "Rename the file?");
    }
    return found;
}

LuminairePhotometry parse_content(Content content,
                                  const SourceText& text,
                                  const PhotometryOptions& options,
                                  Findings& findings) {
    switch (content) {
    case Content::lm63:
        return to_photometry(parse_ies(text, findings), options, findings);
    case Content::xml:
        return to_photometry(parse_tm33(text, findings), options, findings);
    default:
        return to_photometry(parse_ldt(text, findings), options, findings);
    }
}

} // namespace

LuminairePhotometry parse_text_photometry(std::string_view bytes,
                                          const PhotometryOptions& options,
                                          Findings& findings) {
    const SourceText text(bytes, findings);
    return parse_content(decide(text, findings), text, options, findings);
}

Parsed<LuminairePhotometry> parse_photometry(std::string_view bytes,
                                             std::string_view source,
                                             const PhotometryOptions& options) {
    Findings findings(source);
    LuminairePhotometry model = bytes.starts_with("PK\x03\x04")
                                    ? parse_gldf(bytes, options, findings)
                                    : parse_text_photometry(bytes, options, findings);
    if (options.strict)
        findings.refuse_warnings();
    return {std::move(model), findings.notices()};
}

} // namespace isolux
