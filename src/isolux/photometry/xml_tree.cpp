#include "isolux/photometry/xml_tree.h"

#include <algorithm>
#include <utility>

#include <pugixml.hpp>

namespace isolux {

namespace {

/// The text with line feeds, and where its lines begin.
struct Lines {
    std::string text;
    std::vector<std::size_t> begins;

    [[nodiscard]] std::size_t line_at(std::ptrdiff_t offset) const {
        const auto after = std::ranges::upper_bound(
            begins, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
        return std::max<std::size_t>(1, static_cast<std::size_t>(after - begins.begin()));
    }
};

Lines join(const SourceText& source) {
    Lines lines;
    for (std::size_t n = 1; n <= source.line_count(); ++n) {
        lines.begins.push_back(lines.text.size());
        lines.text += source.line(n);
        lines.text += '\n';
    }
    return lines;
}

std::string local_name(std::string_view name) {
    return std::string(name.substr(name.rfind(':') + 1)); // npos + 1 is 0
}

XmlElement to_element(const pugi::xml_node& node,
                      const Lines& lines,
                      const Findings& findings,
                      int depth) {
    XmlElement element;
    element.name = local_name(node.name());
    element.text = trim(node.text().get());
    if (const std::size_t end = element.text.find_last_not_of('\n');
        end != std::string::npos && end + 1 < element.text.size())
        element.text.resize(end + 1);
    element.line = lines.line_at(node.offset_debug());
    if (depth > deepest_xml)
        findings.fail(element.line,
                      "elements nest deeper than " + std::to_string(deepest_xml)
                          + " (no luminaire file needs that)");
    for (const pugi::xml_attribute& a : node.attributes())
        element.attributes.push_back({local_name(a.name()), a.value()});
    for (const pugi::xml_node& child : node.children())
        if (child.type() == pugi::node_element)
            element.children.push_back(to_element(child, lines, findings, depth + 1));
    return element;
}

} // namespace

const XmlElement* XmlElement::find(std::string_view child) const noexcept {
    const auto found = std::ranges::find(children, child, &XmlElement::name);
    return found == children.end() ? nullptr : &*found;
}

const XmlElement*
XmlElement::find_path(std::initializer_list<std::string_view> names) const noexcept {
    const XmlElement* at = this;
    for (const std::string_view child : names) {
        at = at->find(child);
        if (at == nullptr)
            return nullptr;
    }
    return at;
}

std::string XmlElement::text_of(std::initializer_list<std::string_view> names) const {
    const XmlElement* const element = find_path(names);
    return element != nullptr ? element->text : std::string{};
}

std::string_view XmlElement::attribute(std::string_view attribute_name) const noexcept {
    const auto found = std::ranges::find(attributes, attribute_name, &Attribute::name);
    return found == attributes.end() ? std::string_view{} : std::string_view(found->value);
}

XmlElement parse_xml(const SourceText& source, const Findings& findings) {
    const Lines lines = join(source);
    // every element opens with one of these: counted before the parser allocates anything
    const auto openings = static_cast<std::size_t>(std::ranges::count(lines.text, '<'));
    if (openings > 2 * most_xml_elements)
        findings.fail(1,
                      std::to_string(openings) + " tags (no luminaire file needs more than "
                          + std::to_string(2 * most_xml_elements) + ")");
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(
        lines.text.data(), lines.text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
        findings.fail(lines.line_at(result.offset),
                      std::string("not well-formed XML (") + result.description() + ")",
                      "Truncated file?");
    const pugi::xml_node root = document.document_element();
    return to_element(root, lines, findings, 1);
}

} // namespace isolux
