#include <map>

#include <fmt/format.h>

#include "isolux/scene/mesh_text.h"

/// Wavefront OBJ: `v x y z` defines a point, `f a b c ...` a face by point numbers counted from
/// 1 (or backwards from -1), each perhaps followed by /texture/normal; `usemtl name` sets the
/// material of the faces that follow. A line that ends in \ goes on in the next one. Everything
/// else (normals, textures, groups, curves) means nothing to light.
namespace isolux {
namespace {

class ObjReader {
public:
    ObjReader(std::string_view bytes, std::string_view source) : text_(bytes, source) {}

    RawMesh read() {
        mesh_.slots.clear();
        while (text_.next_line())
            read_line();
        for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
            check_face(f);
        if (mesh_.faces.empty())
            text_.fail("no face was found (nothing that light could meet)",
                       "Is this an OBJ file?");
        return std::move(mesh_);
    }

private:
    void read_line();
    void read_face();
    void check_face(std::size_t f) const;
    [[nodiscard]] std::uint32_t slot_of(const std::string& material);

    TextCursor text_;
    RawMesh mesh_;
    std::string material_;
    std::vector<std::size_t> line_of_face_;
    std::map<std::string, std::uint32_t, std::less<>> slots_;
    std::vector<std::string> words_; ///< of a face, joined over continued lines
};

void ObjReader::read_line() {
    const auto words = text_.words();
    if (words[0] == "v")
        mesh_.points.push_back(text_.point(1));
    else if (words[0] == "usemtl")
        material_ = words.size() > 1 ? std::string(words[1]) : "";
    else if (words[0] == "f")
        read_face();
}

void ObjReader::read_face() {
    const std::size_t line = text_.line_number();
    words_.assign(text_.words().begin() + 1, text_.words().end());
    while (!words_.empty() && words_.back().ends_with('\\')) {
        words_.back().pop_back();
        if (words_.back().empty())
            words_.pop_back();
        if (!text_.next_line())
            break;
        words_.insert(words_.end(), text_.words().begin(), text_.words().end());
    }
    if (static_cast<std::int64_t>(words_.size()) > most_corners)
        text_.fail(fmt::format("a face of {} corners (at most {} are supported)",
                               words_.size(),
                               most_corners),
                   "Split it into smaller faces?");
    std::vector<std::uint32_t> face;
    for (const std::string& word : words_) {
        const std::string_view number = std::string_view(word).substr(0, word.find('/'));
        std::int64_t index = 0;
        if (!read_integer(number, index))
            text_.fail(fmt::format("'{:.40}' is not a corner of a face (a point's number was "
                                   "expected)",
                                   word));
        if (index < 0)
            index += static_cast<std::int64_t>(mesh_.points.size()) + 1;
        if (index < 1 || index > UINT32_MAX)
            text_.fail(
                fmt::format("the face names point {} (points are counted from 1)", number));
        face.push_back(static_cast<std::uint32_t>(index - 1));
    }
    if (face.size() < 3)
        text_.fail(
            fmt::format("a face of {} corners (at least 3 make a surface)", face.size()));
    mesh_.faces.push_back(std::move(face));
    mesh_.slot_of_face.push_back(slot_of(material_));
    line_of_face_.push_back(line);
}

/// Points may follow the faces that use them, so this is known only at the end.
void ObjReader::check_face(std::size_t f) const {
    for (const std::uint32_t i : mesh_.faces[f])
        if (i >= mesh_.points.size())
            text_.fail_at(line_of_face_[f],
                          fmt::format("the face names point {}, but there are only {} (no such "
                                      "point)",
                                      i + 1ULL,
                                      mesh_.points.size()),
                          "Truncated file?");
}

std::uint32_t ObjReader::slot_of(const std::string& material) {
    const auto [found, is_new] =
        slots_.try_emplace(material, static_cast<std::uint32_t>(mesh_.slots.size()));
    if (is_new)
        mesh_.slots.push_back(material);
    return found->second;
}

} // namespace

RawMesh parse_obj(std::string_view bytes, std::string_view source) {
    return ObjReader(bytes, source).read();
}

} // namespace isolux
