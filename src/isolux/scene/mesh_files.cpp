#include "isolux/scene/mesh.h"
#include "isolux/scene/mesh_text.h"

namespace isolux {
namespace {

RawMesh parse_raw(std::string_view bytes, MeshFileFormat format, std::string_view source) {
    switch (format) {
    case MeshFileFormat::obj:
        return parse_obj(bytes, source);
    case MeshFileFormat::ply:
        return parse_ply(bytes, source);
    case MeshFileFormat::stl:
        return parse_stl(bytes, source);
    case MeshFileFormat::off:
        return parse_off(bytes, source);
    }
    return {};
}

} // namespace

Parsed<SurfaceMesh>
parse_mesh(std::string_view bytes, MeshFileFormat format, std::string_view source) {
    if (bytes.starts_with("\xEF\xBB\xBF")) // byte order mark of UTF-8
        bytes.remove_prefix(3);
    RawMesh raw = parse_raw(bytes, format, source);
    return {SurfaceMesh(raw.points, raw.faces, raw.slot_of_face, std::move(raw.slots)), {}};
}

} // namespace isolux
