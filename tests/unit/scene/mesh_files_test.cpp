#include <bit>
#include <cstring>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "isolux/scene/mesh.h"

namespace isolux {
namespace {

// One tetrahedron in every format: volume 1/6, right side out.

const std::string obj_text = "# a tetrahedron\nmtllib ignored.mtl\nv 0 0 0\nv 1 0 0\n"
                             "v 0 1 0 1.0\nv 0 0 1 0.5 0.5 0.5\nvn 0 0 1\nusemtl base\n"
                             "f 1 3 2\nusemtl sides\nf 1//1 2//1 4//1\nf -3/1 -2/2 -1/3\n"
                             "f 1 4 \\\n3\n";
const std::string off_text = "OFF\n# counts\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n"
                             "3 0 1 3\n3 1 2 3 255 0 0\n3 0 3 2\n";
const std::string ply_text =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\nproperty uchar red\nelement face 4\n"
    "property list uchar int vertex_indices\nelement edge 1\nproperty int a\nproperty int b\n"
    "end_header\n0 0 0 9\n1 0 0 9\n0 1 0 9\n0 0 1 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n0 1\n";
const int corners[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
const double places[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

std::string stl_text() {
    std::string s = "solid tetrahedron\n";
    for (const auto& face : corners) {
        s += "facet normal 0 0 0\n outer loop\n";
        for (const int i : face)
            s += "  vertex " + std::to_string(places[i][0]) + " " + std::to_string(places[i][1])
                 + " " + std::to_string(places[i][2]) + "\n";
        s += " endloop\nendfacet\n";
    }
    return s + "endsolid\n";
}

/// Bytes of a value, little- or big-endian.
template <class T> std::string bytes_of(T value, bool big = false) {
    std::string s(sizeof(T), '\0');
    std::memcpy(s.data(), &value, sizeof(T));
    if (big != (std::endian::native == std::endian::big))
        s = std::string(s.rbegin(), s.rend());
    return s;
}

std::string stl_binary() {
    std::string s = "solid, says the header, and lies";
    s.resize(80, ' ');
    s += bytes_of(std::uint32_t{4});
    for (const auto& face : corners) {
        for (int i = 0; i < 3; ++i)
            s += bytes_of(0.0F);
        for (const int i : face)
            for (const double x : places[i])
                s += bytes_of(static_cast<float>(x));
        s += bytes_of(std::uint16_t{0});
    }
    return s;
}

std::string ply_binary(bool big) {
    std::string s =
        std::string("ply\nformat binary_") + (big ? "big" : "little")
        + "_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\n"
          "property short z\nproperty list ushort char junk\nelement face 4\n"
          "property uchar flag\nproperty list uint8 uint vertex_index\nend_header\n";
    for (const auto& p : places)
        s += bytes_of(p[0], big) + bytes_of(static_cast<float>(p[1]), big)
             + bytes_of(static_cast<std::int16_t>(p[2]), big) + bytes_of(std::uint16_t{2}, big)
             + "##";
    for (const auto& face : corners) {
        s += "F" + bytes_of(std::uint8_t{3});
        for (const int i : face)
            s += bytes_of(static_cast<std::uint32_t>(i), big);
    }
    return s;
}

void expect_tetrahedron(const std::string& bytes, MeshFileFormat format) {
    const auto parsed = parse_mesh(bytes, format, "t");
    const auto triangles = parsed.value.triangles();
    ASSERT_EQ(triangles.size(), 4U);
    double volume = 0.0;
    for (const auto& t : triangles)
        volume +=
            dot(t.corner[0] - Point3{}, cross(t.corner[1] - Point3{}, t.corner[2] - Point3{}));
    EXPECT_DOUBLE_EQ(volume / 6.0, 1.0 / 6.0);
    EXPECT_TRUE(parsed.value.inspect().empty());
}

std::string with_crlf(const std::string& text) {
    std::string s;
    for (const char c : text)
        s += c == '\n' ? "\r\n" : std::string(1, c);
    return s;
}

TEST(MeshFiles, EveryFormatGivesTheSameTetrahedron) {
    expect_tetrahedron(obj_text, MeshFileFormat::obj);
    expect_tetrahedron(off_text, MeshFileFormat::off);
    expect_tetrahedron(ply_text, MeshFileFormat::ply);
    expect_tetrahedron(stl_text(), MeshFileFormat::stl);
    expect_tetrahedron(stl_binary(), MeshFileFormat::stl);
    expect_tetrahedron(ply_binary(false), MeshFileFormat::ply);
    expect_tetrahedron(ply_binary(true), MeshFileFormat::ply);
}

TEST(MeshFiles, LineEndsAndByteOrderMarksDoNotMatter) {
    expect_tetrahedron("\xEF\xBB\xBF" + with_crlf(obj_text), MeshFileFormat::obj);
    expect_tetrahedron(with_crlf(off_text), MeshFileFormat::off);
    expect_tetrahedron(with_crlf(ply_text), MeshFileFormat::ply);
    expect_tetrahedron(with_crlf(stl_text()), MeshFileFormat::stl);
}

TEST(MeshFiles, OffCountsMayStandBehindTheWord) {
    std::string s = off_text;
    s.replace(0, s.find("4 4 6"), "COFF ");
    expect_tetrahedron(s, MeshFileFormat::off);
}

TEST(MeshFiles, ObjMaterialsBecomeSlots) {
    const auto mesh = parse_mesh(obj_text, MeshFileFormat::obj, "t").value;
    EXPECT_EQ(mesh.slots(), (std::vector<std::string>{"base", "sides"}));
    std::size_t sides = 0;
    for (const auto& t : mesh.triangles())
        sides += t.slot == 1;
    EXPECT_EQ(sides, 3U);
    const auto plain =
        parse_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", MeshFileFormat::obj, "t").value;
    EXPECT_EQ(plain.slots(), std::vector<std::string>{""});
}

TEST(MeshFiles, ObjPointsMayFollowTheirFaces) {
    const auto mesh =
        parse_mesh("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", MeshFileFormat::obj, "t").value;
    EXPECT_EQ(mesh.triangles().size(), 1U);
}

TEST(MeshFiles, CoordinatesKeepDoublePrecision) {
    const auto mesh = parse_mesh("v 1000.0001234567 0 0\nv 1001 0 0\nv 1000 1 0\nf 1 2 3\n",
                                 MeshFileFormat::obj,
                                 "t")
                          .value;
    double least = 1e9;
    const MeshTriangle triangle = mesh.triangles().at(0);
    for (const auto& p : triangle.corner)
        least = std::min(least, std::abs(p.x - 1000.0001234567));
    EXPECT_EQ(least, 0.0);
}

// Messages.

void expect_message(const std::string& bytes,
                    MeshFileFormat format,
                    const std::string& expected) {
    try {
        (void)parse_mesh(bytes, format, "m");
        ADD_FAILURE() << "accepted; expected: " << expected;
    } catch (const InputError& e) {
        ASSERT_EQ(e.messages().size(), 1U);
        EXPECT_EQ(to_string(e.messages()[0]), expected);
    }
}

std::string replaced(std::string s, const std::string& what, const std::string& by) {
    return s.replace(s.find(what), what.size(), by);
}

TEST(MeshMessages, Obj) {
    const auto expect = [](const std::string& text, const std::string& message) {
        expect_message(text, MeshFileFormat::obj, message);
    };
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    expect("v 0 0 nan\n", "m:1: 'nan' is not a number (a coordinate was expected)");
    expect("v 0 0 1e999\n", "m:1: '1e999' is not a number (a coordinate was expected)");
    expect("v 0 0\n", "m:1: the line is too short (a number is missing). Truncated file?");
    expect(points + "f 1 2 x\n",
           "m:4: 'x' is not a corner of a face (a point's number was expected)");
    expect(points + "f 0 1 2\n", "m:4: the face names point 0 (points are counted from 1)");
    expect(points + "f -4 1 2\n", "m:4: the face names point -4 (points are counted from 1)");
    expect(points + "f 1 2\n", "m:4: a face of 2 corners (at least 3 make a surface)");
    expect(
        points + "f 1 2 9\n# end\n",
        "m:4: the face names point 9, but there are only 3 (no such point). Truncated file?");
    expect(points,
           "m:3: no face was found (nothing that light could meet). Is this an OBJ file?");
    std::string many = points + "f";
    for (int i = 0; i < 1001; ++i)
        many += " 1";
    expect(many,
           "m:4: a face of 1001 corners (at most 1000 are supported). Split it into smaller "
           "faces?");
}

TEST(MeshMessages, Off) {
    const auto expect = [](const std::string& text, const std::string& message) {
        expect_message(text, MeshFileFormat::off, message);
    };
    expect("", "m:0: the file is empty (OFF was expected)");
    expect("ply\n",
           "m:1: the first word is not OFF (it announces the format). Is this an OFF file?");
    expect("4OFF\n",
           "m:1: '4OFF' has more than three dimensions (only points in space are supported)");
    expect("OFF BINARY\n",
           "m:1: binary OFF is not supported (only the text form is). Save it as text?");
    expect("OFF\n", "m:1: the counts of points and faces are missing. Truncated file?");
    expect("OFF\n0 x 0\n", "m:2: 'x' is not a whole number (a count or index was expected)");
    expect("OFF\n-4 4 0\n", "m:2: a count of -4 (counts are not negative)");
    expect("OFF\n4000000000 4 0\n0 0 0\n",
           "m:2: 4000000000 lines announced, but only 6 bytes follow (they cannot hold them). "
           "Truncated file?");
    expect("OFF\n2 1 0\n0.0000 0.00000 0\n",
           "m:3: 2 points announced, 1 found (the file ends here). Truncated file?");
    expect("OFF\n1 2 0\n0 0 0\n3 0 0 0\n",
           "m:4: 2 faces announced, 1 found (the file ends here). Truncated file?");
    expect("OFF\n1 0 0\n0 0 0\n",
           "m:3: the file announces no face (nothing that light could meet)");
    expect("OFF\n1 1 0\n0 0 0\n2 0 0\n", "m:4: a face of 2 corners (3 to 1000 are supported)");
    expect("OFF\n1 1 0\n0 0 0\n3 0 0 1\n",
           "m:4: the face names point 1, but there are only 1, counted from 0 (no such point)");
}

TEST(MeshMessages, Ply) {
    const auto expect = [](const std::string& text, const std::string& message) {
        expect_message(text, MeshFileFormat::ply, message);
    };
    expect("OFF\n",
           "m:1: the first word is not 'ply' (it announces the format). Is this a PLY file?");
    expect("ply\nformat ascii 1.0\n",
           "m:2: the header does not end (end_header is missing). Truncated file?");
    expect("ply\nend_header\n", "m:2: the header names no format (ascii or binary)");
    expect(replaced(ply_text, "ascii", "EBCDIC"),
           "m:2: unknown format 'EBCDIC' (ascii, binary_little_endian or binary_big_endian)");
    expect(replaced(ply_text, "element vertex 4", "element vertex -4"),
           "m:4: an element needs a name and a count of 0 or more");
    expect("ply\nproperty float x\n", "m:2: a property before any element (whose is it?)");
    expect(replaced(ply_text, "property float y", "property y"),
           "m:6: a property needs a type and a name");
    expect(replaced(ply_text, "property float y", "property quad y"),
           "m:6: unknown type of a property (char to double, or a list of them)");
    expect(replaced(ply_text, "3 0 2 1", "2 0 2"),
           "m:19: face 1 has 2 corners (3 to 1000 are supported)");
    expect(replaced(ply_text, "3 0 2 1", "3 0 2 -1"),
           "m:19: face 1 names point -1 (points are counted from 0)");
    expect(replaced(ply_text, "3 0 2 1", "3 0 2 7"),
           "m:23: face 1 names point 7, but there are only 4, counted from 0 (no such point)");
    expect(replaced(ply_text, "vertex_indices", "strip"),
           "m:23: no face was found (nothing that light could meet). Is it a point cloud or "
           "made of triangle strips?");
    expect(
        replaced(ply_text, "element vertex 4", "element vertex 4000000000"),
        "m:14: 4000000000 items of 'vertex' announced, but only 69 bytes follow (they cannot "
        "hold them). Truncated file?");
    expect(replaced(ply_text, "element edge 1", "element edge 2"),
           "m:23: 2 items of 'edge' announced, 1 found (the file ends here). Truncated file?");
    const std::string binary = ply_binary(false);
    expect(binary.substr(0, binary.size() - 1),
           "m: the file ends inside an element. Truncated file?");
    expect(replaced(binary, "element face 4", "element face 9999"),
           "m: 9999 items of 'face' announced, but only 56 bytes follow (they cannot hold "
           "them). Truncated file?");
    expect(replaced(binary, bytes_of(1.0), bytes_of(std::bit_cast<double>(0x7ff8ULL << 48))),
           "m: vertex 2 is not a number (damaged)");
}

TEST(MeshMessages, Stl) {
    const auto expect = [](const std::string& text, const std::string& message) {
        expect_message(text, MeshFileFormat::stl, message);
    };
    expect("OFF\n",
           "m: 4 bytes (an STL file has at least 84 or starts with 'solid'). Is this an STL "
           "file?");
    expect("solid\nendsolid\n", "m: no triangle was found (nothing that light could meet)");
    expect("solid\nvertex 0 0 0\nendloop\n",
           "m:3: a facet has 1 vertices (STL holds triangles)");
    expect("solid\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n",
           "m:5: a facet has more than three vertices (STL holds triangles)");
    expect("solid\nvertex 0 0 0\n", "m:2: the file ends inside a facet. Truncated file?");
    expect("solid\nvertex 0 0 zero\n",
           "m:2: 'zero' is not a number (a coordinate was expected)");
    std::string binary = replaced(stl_binary(), "solid", "plain");
    expect(binary.substr(0, binary.size() - 1),
           "m: 4 triangles announced, 3 found (the file is too short). Truncated file?");
    binary.replace(84 + 12, 4, bytes_of(std::bit_cast<float>(0x7fc00000U)));
    expect(binary, "m: a corner of triangle 1 is not a number (damaged)");
}

TEST(MeshMessages, DamagedFilesAreRefusedOrReadButNeverCrash) {
    const std::pair<std::string, MeshFileFormat> files[] = {
        {obj_text, MeshFileFormat::obj},
        {off_text, MeshFileFormat::off},
        {ply_text, MeshFileFormat::ply},
        {ply_binary(false), MeshFileFormat::ply},
        {ply_binary(true), MeshFileFormat::ply},
        {stl_text(), MeshFileFormat::stl},
        {stl_binary(), MeshFileFormat::stl}};
    std::mt19937 engine(1);
    int refused = 0, read = 0;
    const auto feed = [&](const std::string& bytes, MeshFileFormat format) {
        try {
            const auto mesh = parse_mesh(bytes, format, "m");
            (void)mesh.value.triangles();
            (void)mesh.value.inspect();
            ++read;
        } catch (const InputError&) {
            ++refused;
        }
    };
    for (const auto& [bytes, format] : files) {
        for (std::size_t end = 0; end < bytes.size(); ++end)
            feed(bytes.substr(0, end), format);
        for (int i = 0; i < 500; ++i) {
            std::string damaged = bytes;
            for (int k = 0; k < 3; ++k)
                damaged[engine() % damaged.size()] =
                    i % 2 == 0 ? static_cast<char>(engine()) : "0123456789 -.\n"[engine() % 14];
            feed(damaged, format);
        }
    }
    EXPECT_GT(refused, 1000);
    EXPECT_GT(read, 500);
}

} // namespace
} // namespace isolux
