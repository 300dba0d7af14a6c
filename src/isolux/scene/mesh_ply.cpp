#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "isolux/scene/mesh_text.h"

/// PLY, the Polygon File Format: a text header that names elements (`element vertex 8`) and
/// their properties (`property float x`, `property list uchar int vertex_indices`), then the
/// elements one after another, as text or as little- or big-endian bytes.
namespace isolux {
namespace {

enum class Encoding { text, little_endian, big_endian };

struct Scalar {
    std::size_t size = 0; ///< bytes
    char kind = 'i';      ///< i signed, u unsigned, f floating point
};

std::optional<Scalar> find_scalar(std::string_view name) {
    constexpr std::pair<std::string_view, Scalar> known[] = {{"char", {1, 'i'}},
                                                             {"int8", {1, 'i'}},
                                                             {"uchar", {1, 'u'}},
                                                             {"uint8", {1, 'u'}},
                                                             {"short", {2, 'i'}},
                                                             {"int16", {2, 'i'}},
                                                             {"ushort", {2, 'u'}},
                                                             {"uint16", {2, 'u'}},
                                                             {"int", {4, 'i'}},
                                                             {"int32", {4, 'i'}},
                                                             {"uint", {4, 'u'}},
                                                             {"uint32", {4, 'u'}},
                                                             {"float", {4, 'f'}},
                                                             {"float32", {4, 'f'}},
                                                             {"double", {8, 'f'}},
                                                             {"float64", {8, 'f'}}};
    for (const auto& [key, scalar] : known)
        if (key == name)
            return scalar;
    return std::nullopt;
}

struct Property {
    std::string name;
    Scalar scalar;
    std::optional<Scalar> list_count; ///< lists only: the type of their length
};

struct Element {
    std::string name;
    std::int64_t count = 0;
    std::vector<Property> properties;
};

class PlyReader {
public:
    PlyReader(std::string_view bytes, std::string_view source)
        : text_(bytes, source), source_(source) {}

    RawMesh read() {
        read_header();
        body_ = text_.rest();
        for (const Element& element : elements_)
            read_element(element);
        check_faces();
        return std::move(mesh_);
    }

private:
    void read_header();
    void read_format();
    void read_property();
    void read_element(const Element& element);
    void read_item(const Element& element, std::int64_t index);
    [[nodiscard]] double next(const Scalar& scalar);
    [[nodiscard]] double next_binary(const Scalar& scalar);
    void check_faces() const;
    [[noreturn]] void fail(std::string what, std::string hint = {}) const;

    TextCursor text_;
    std::string_view source_;
    std::string_view body_; ///< binary: what is left of it
    Encoding encoding_ = Encoding::text;
    std::vector<Element> elements_;
    std::size_t word_ = 0; ///< text: the next word of the line
    RawMesh mesh_;
};

void PlyReader::read_header() {
    if (!text_.next_line() || text_.words()[0] != "ply")
        text_.fail("the first word is not 'ply' (it announces the format)",
                   "Is this a PLY file?");
    bool has_format = false;
    while (text_.next_line()) {
        const auto words = text_.words();
        if (words[0] == "end_header") {
            if (!has_format)
                text_.fail("the header names no format (ascii or binary)");
            return;
        }
        if (words[0] == "format") {
            read_format();
            has_format = true;
        } else if (words[0] == "element") {
            if (words.size() < 3 || text_.integer(2) < 0)
                text_.fail("an element needs a name and a count of 0 or more");
            elements_.push_back({std::string(words[1]), text_.integer(2), {}});
        } else if (words[0] == "property") {
            read_property();
        }
    }
    text_.fail("the header does not end (end_header is missing)", "Truncated file?");
}

void PlyReader::read_format() {
    const std::string_view format = text_.words().size() > 1 ? text_.words()[1] : "";
    if (format == "ascii")
        encoding_ = Encoding::text;
    else if (format == "binary_little_endian")
        encoding_ = Encoding::little_endian;
    else if (format == "binary_big_endian")
        encoding_ = Encoding::big_endian;
    else
        text_.fail(fmt::format("unknown format '{:.40}' (ascii, binary_little_endian or "
                               "binary_big_endian)",
                               format));
}

void PlyReader::read_property() {
    const auto words = text_.words();
    if (elements_.empty())
        text_.fail("a property before any element (whose is it?)");
    const bool is_list = words.size() > 1 && words[1] == "list";
    if (words.size() < (is_list ? 5U : 3U))
        text_.fail("a property needs a type and a name");
    const auto type = find_scalar(words[is_list ? 3 : 1]);
    const auto count = is_list ? find_scalar(words[2]) : std::nullopt;
    if (!type || (is_list && (!count || count->kind == 'f')))
        text_.fail("unknown type of a property (char to double, or a list of them)");
    elements_.back().properties.push_back({std::string(words[is_list ? 4 : 2]), *type, count});
}

void PlyReader::read_element(const Element& element) {
    std::size_t smallest = encoding_ == Encoding::text ? 1 : 0; // bytes an item takes
    for (const Property& p : element.properties)
        smallest += encoding_ == Encoding::text ? 0
                    : p.list_count              ? p.list_count->size
                                                : p.scalar.size;
    if (element.properties.empty())
        return;
    const std::size_t left =
        encoding_ == Encoding::text ? text_.rest().size() + 1 : body_.size();
    if (static_cast<std::uint64_t>(element.count) > left / smallest)
        fail(
            fmt::format("{} items of '{:.40}' announced, but only {} bytes follow (they cannot "
                        "hold them)",
                        element.count,
                        element.name,
                        left),
            "Truncated file?");
    for (std::int64_t i = 0; i < element.count; ++i)
        read_item(element, i);
}

void PlyReader::read_item(const Element& element, std::int64_t index) {
    word_ = 0;
    if (encoding_ == Encoding::text && !text_.next_line())
        fail(fmt::format("{} items of '{:.40}' announced, {} found (the file ends here)",
                         element.count,
                         element.name,
                         index),
             "Truncated file?");
    std::array<double, 3> place{};
    for (const Property& p : element.properties) {
        if (!p.list_count) {
            const double value = next(p.scalar);
            if (element.name == "vertex" && p.name.size() == 1 && p.name[0] >= 'x'
                && p.name[0] <= 'z')
                place[static_cast<std::size_t>(p.name[0] - 'x')] = value;
            continue;
        }
        const double length = next(*p.list_count);
        const bool is_face =
            element.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
        if (length < 0.0 || (is_face && (length < 3.0 || length > most_corners)))
            fail(fmt::format("{} {} has {} corners (3 to {} are supported)",
                             element.name.substr(0, 40),
                             index + 1,
                             length,
                             most_corners));
        std::vector<std::uint32_t> face;
        for (double i = 0.0; i < length; ++i) {
            const double value = next(p.scalar);
            if (!is_face)
                continue;
            if (value < 0.0 || value > UINT32_MAX)
                fail(fmt::format(
                    "face {} names point {} (points are counted from 0)", index + 1, value));
            face.push_back(static_cast<std::uint32_t>(value));
        }
        if (is_face)
            mesh_.faces.push_back(std::move(face));
    }
    if (element.name == "vertex") {
        if (!std::isfinite(place[0] + place[1] + place[2]))
            fail(fmt::format("vertex {} is not a number (damaged)", index + 1));
        mesh_.points.push_back({place[0], place[1], place[2]});
    }
}

double PlyReader::next(const Scalar& scalar) {
    if (encoding_ != Encoding::text)
        return next_binary(scalar);
    return scalar.kind == 'f' ? text_.number(word_++)
                              : static_cast<double>(text_.integer(word_++));
}

double PlyReader::next_binary(const Scalar& scalar) {
    if (body_.size() < scalar.size)
        fail("the file ends inside an element", "Truncated file?");
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < scalar.size; ++i) {
        const std::size_t at = encoding_ == Encoding::big_endian ? i : scalar.size - 1 - i;
        bits = bits << 8 | static_cast<unsigned char>(body_[at]);
    }
    body_.remove_prefix(scalar.size);
    if (scalar.kind == 'f')
        return scalar.size == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                                : std::bit_cast<double>(bits);
    if (scalar.kind == 'u')
        return static_cast<double>(bits);
    const unsigned unused = 64U - 8U * static_cast<unsigned>(scalar.size);
    return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
}

void PlyReader::check_faces() const {
    if (mesh_.faces.empty())
        fail("no face was found (nothing that light could meet)",
             "Is it a point cloud or made of triangle strips?");
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
        for (const std::uint32_t i : mesh_.faces[f])
            if (i >= mesh_.points.size())
                fail(
                    fmt::format("face {} names point {}, but there are only {}, counted from 0 "
                                "(no such point)",
                                f + 1,
                                i,
                                mesh_.points.size()));
}

void PlyReader::fail(std::string what, std::string hint) const {
    if (encoding_ == Encoding::text)
        text_.fail(std::move(what), std::move(hint));
    throw InputError(std::string(source_), std::move(what), std::move(hint));
}

} // namespace

RawMesh parse_ply(std::string_view bytes, std::string_view source) {
    return PlyReader(bytes, source).read();
}

} // namespace isolux
