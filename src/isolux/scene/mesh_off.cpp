#include <fmt/format.h>

#include "isolux/scene/mesh_text.h"

/// OFF, the Object File Format of Geomview: the word OFF (with C, N or ST before it where
/// points carry colours, normals or textures), three counts (points, faces, edges), then one
/// point a line, `x y z ...`, and one face a line, `n i1 ... in [colour]`, counted from 0.
namespace isolux {
namespace {

constexpr std::size_t shortest_point = 5; ///< bytes: "0 0 0"
constexpr std::size_t shortest_face = 7;  ///< bytes: "3 0 1 2"

void check_kind(TextCursor& text) {
    const std::string_view kind = text.words()[0];
    if (!kind.ends_with("OFF"))
        text.fail("the first word is not OFF (it announces the format)",
                  "Is this an OFF file?");
    if (kind.find('4') != kind.npos || kind.find('n') != kind.npos)
        text.fail(fmt::format("'{}' has more than three dimensions (only points in space are "
                              "supported)",
                              kind.substr(0, 40)));
    if (text.words().size() > 1 && text.words()[1] == "BINARY")
        text.fail("binary OFF is not supported (only the text form is)", "Save it as text?");
}

std::uint64_t read_count(const TextCursor& text, std::size_t word, std::size_t shortest) {
    const std::int64_t count = text.integer(word);
    if (count < 0)
        text.fail(fmt::format("a count of {} (counts are not negative)", count));
    if (static_cast<std::uint64_t>(count) > text.rest().size() / shortest + 1)
        text.fail(fmt::format("{} lines announced, but only {} bytes follow (they cannot hold "
                              "them)",
                              count,
                              text.rest().size()),
                  "Truncated file?");
    return static_cast<std::uint64_t>(count);
}

std::vector<std::uint32_t> read_face(const TextCursor& text, std::size_t points) {
    const std::int64_t corners = text.integer(0);
    if (corners < 3 || corners > most_corners)
        text.fail(
            fmt::format("a face of {} corners (3 to {} are supported)", corners, most_corners));
    std::vector<std::uint32_t> face;
    for (std::size_t i = 1; i <= static_cast<std::size_t>(corners); ++i) {
        const std::int64_t index = text.integer(i);
        if (index < 0 || static_cast<std::uint64_t>(index) >= points)
            text.fail(
                fmt::format("the face names point {}, but there are only {}, counted from "
                            "0 (no such point)",
                            index,
                            points));
        face.push_back(static_cast<std::uint32_t>(index));
    }
    return face;
}

} // namespace

RawMesh parse_off(std::string_view bytes, std::string_view source) {
    TextCursor text(bytes, source);
    if (!text.next_line())
        text.fail("the file is empty (OFF was expected)");
    check_kind(text);
    const std::size_t first = text.words().size() > 1 ? 1 : 0; // counts behind OFF, or below it
    if (first == 0 && !text.next_line())
        text.fail("the counts of points and faces are missing", "Truncated file?");
    const std::uint64_t points = read_count(text, first, shortest_point);
    const std::uint64_t faces = read_count(text, first + 1, shortest_face);

    RawMesh mesh;
    const auto advance = [&](const char* what, std::uint64_t announced, std::size_t found) {
        if (!text.next_line())
            text.fail(
                fmt::format(
                    "{} {} announced, {} found (the file ends here)", announced, what, found),
                "Truncated file?");
    };
    while (mesh.points.size() < points) {
        advance("points", points, mesh.points.size());
        mesh.points.push_back(text.point(0));
    }
    while (mesh.faces.size() < faces) {
        advance("faces", faces, mesh.faces.size());
        mesh.faces.push_back(read_face(text, mesh.points.size()));
    }
    if (mesh.faces.empty())
        text.fail("the file announces no face (nothing that light could meet)");
    return mesh;
}

} // namespace isolux
