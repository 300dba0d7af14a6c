#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/photometry/findings.h"
#include "isolux/photometry/source_text.h"

namespace isolux {

/// An element of an XML file with the line it begins on. Names come without namespace prefix.
struct XmlElement {
    struct Attribute {
        std::string name;
        std::string value;
    };

    std::string name;
    std::string text; ///< its own text, blanks trimmed
    std::size_t line = 1;
    std::vector<Attribute> attributes;
    std::vector<XmlElement> children;

    /// The first child of that name; null if there is none.
    [[nodiscard]] const XmlElement* find(std::string_view child) const noexcept;

    /// Follows names from child to child: find_path({"Header", "Manufacturer"}).
    [[nodiscard]] const XmlElement*
    find_path(std::initializer_list<std::string_view> names) const noexcept;

    /// Text of that descendant; empty if there is none.
    [[nodiscard]] std::string text_of(std::initializer_list<std::string_view> names) const;

    /// Value of an attribute; empty if there is none.
    [[nodiscard]] std::string_view attribute(std::string_view attribute_name) const noexcept;
};

/// Limits that no luminaire file comes near; beyond them a file is refused.
inline constexpr std::size_t most_xml_elements = 1'000'000;
inline constexpr int deepest_xml = 64;

/// The root element. Entities of the document's own, which could grow without bound, and
/// external ones are not expanded.
/// @throws InputError  no well-formed XML, too many or too deep elements
[[nodiscard]] XmlElement parse_xml(const SourceText& text, const Findings& findings);

} // namespace isolux
