#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "isolux/scene/mesh_text.h"

/// STL: triangles with no order among them. Text form: `facet ... outer loop`, three lines
/// `vertex x y z`, `endloop endfacet`. Binary form: 80 bytes of anything, the count (uint32),
/// then 50 bytes a triangle: normal and three corners as float32, two bytes unused;
/// little-endian. Many binary files start with the text form's "solid", so the size decides.
namespace isolux {
namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t triangle_size = 50;

std::uint32_t read_u32(const char* bytes) noexcept {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

double read_float(const char* bytes) noexcept { return std::bit_cast<float>(read_u32(bytes)); }

void add_corner(RawMesh& mesh, const Point3& p) {
    if (mesh.faces.empty() || mesh.faces.back().size() == 3)
        mesh.faces.emplace_back();
    mesh.faces.back().push_back(static_cast<std::uint32_t>(mesh.points.size()));
    mesh.points.push_back(p);
}

RawMesh parse_binary(std::string_view bytes, std::string_view source) {
    const std::uint64_t announced = read_u32(bytes.data() + 80);
    const std::uint64_t found = (bytes.size() - header_size) / triangle_size;
    if (announced > found)
        throw InputError(std::string(source),
                         fmt::format("{} triangles announced, {} found (the file is too short)",
                                     announced,
                                     found),
                         "Truncated file?");
    RawMesh mesh;
    for (std::uint64_t t = 0; t < announced; ++t)
        for (int corner = 0; corner < 3; ++corner) {
            const char* at = bytes.data() + header_size + t * triangle_size + 12 + 12 * corner;
            const Point3 p{read_float(at), read_float(at + 4), read_float(at + 8)};
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                throw InputError(
                    std::string(source),
                    fmt::format("a corner of triangle {} is not a number (damaged)", t + 1));
            add_corner(mesh, p);
        }
    return mesh;
}

RawMesh parse_text(std::string_view bytes, std::string_view source) {
    TextCursor text(bytes, source);
    RawMesh mesh;
    std::size_t corners = 0;
    while (text.next_line()) {
        const std::string_view keyword = text.words()[0];
        if (keyword == "vertex") {
            if (++corners > 3)
                text.fail("a facet has more than three vertices (STL holds triangles)");
            add_corner(mesh, text.point(1));
        } else if (keyword == "endloop") {
            if (corners != 3)
                text.fail(
                    fmt::format("a facet has {} vertices (STL holds triangles)", corners));
            corners = 0;
        }
    }
    if (corners != 0)
        text.fail("the file ends inside a facet", "Truncated file?");
    return mesh;
}

bool is_text(std::string_view bytes) {
    if (bytes.size() >= header_size
        && bytes.size() == header_size + std::uint64_t{triangle_size} * read_u32(&bytes[80]))
        return false;
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    return first != bytes.npos && bytes.substr(first, 5) == "solid";
}

} // namespace

RawMesh parse_stl(std::string_view bytes, std::string_view source) {
    const bool text = is_text(bytes);
    if (!text && bytes.size() < header_size)
        throw InputError(std::string(source),
                         fmt::format("{} bytes (an STL file has at least {} or starts with "
                                     "'solid')",
                                     bytes.size(),
                                     header_size),
                         "Is this an STL file?");
    RawMesh mesh = text ? parse_text(bytes, source) : parse_binary(bytes, source);
    if (mesh.faces.empty())
        throw InputError(std::string(source),
                         "no triangle was found (nothing that light could meet)");
    return mesh;
}

} // namespace isolux
