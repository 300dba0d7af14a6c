#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/base/ids.h"
#include "isolux/io/json_node.h"
#include "isolux/scene/material.h"

namespace isolux {

/// The materials of a project while it is read: the project's own, the everyday ones, and grey
/// or coloured reflectances without a name. Each is made once, when it is first asked for.
class MaterialTable {
public:
    /// Reads every material of the file's "materials".
    void define(const JsonNode& definitions);

    /// A surface's material: a reflectance, [r, g, b], or a name. An error is reported and
    /// black returned if there is no such material.
    [[nodiscard]] MaterialId resolve(const JsonNode& finish);

    /// By name, the project's own first. Nothing if there is none.
    [[nodiscard]] std::optional<MaterialId> find(std::string_view name);

    [[nodiscard]] MaterialId grey(double reflectance);

    [[nodiscard]] const std::vector<Material>& materials() const noexcept { return materials_; }

    [[nodiscard]] bool is_pane(MaterialId id) const noexcept;

private:
    enum class State { unread, reading, read };

    struct Definition {
        JsonNode node;
        State state = State::unread;
        Material material;
        std::optional<MaterialId> id;
    };

    MaterialId add(Material material);
    [[nodiscard]] MaterialId coloured(const Rgb& diffuse);
    [[nodiscard]] std::optional<Material> material_named(const JsonNode& name);
    void read(Definition& definition, const std::string& name);
    [[nodiscard]] Material read_object(const JsonNode& node);
    [[nodiscard]] std::vector<std::string> known_names() const;

    std::map<std::string, Definition, std::less<>> definitions_;
    std::map<std::string, MaterialId, std::less<>> others_; ///< everyday ones and reflectances
    std::vector<Material> materials_;
};

} // namespace isolux
