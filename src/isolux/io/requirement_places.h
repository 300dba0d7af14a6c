#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "isolux/io/project_reader.h"

namespace isolux {

/// A name, or a list of names.
[[nodiscard]] std::vector<std::string> read_names(const JsonNode& node);

/// Where a requirement looks: surfaces of the project, and why one is missing.
struct Places {
    std::vector<std::size_t> surfaces;
    std::string reason;
};

/// The surfaces that one entry of "requirements" is judged on: those that it names, and those
/// that follow from its room and its task area, which are added to the project.
class RequirementPlaces {
public:
    RequirementPlaces(const JsonObject& entry, ProjectReader& reader)
        : entry_(entry), reader_(reader) {}

    /// Reads "area" and "areas". @return false if something is wrong (and reported)
    bool read_own();

    /// @param room  may be null @pre read_own()
    [[nodiscard]] const Places& of(RequiredArea area, const Room* room);

    [[nodiscard]] std::optional<std::size_t> find_surface(const std::string& name) const;

private:
    void name_area(RequiredArea area, const JsonNode& node);
    void check_kind(RequiredArea area, std::size_t surface, const JsonNode& node);
    [[nodiscard]] Places make_places(RequiredArea area);
    [[nodiscard]] Places make_walls();
    [[nodiscard]] Places make(const std::string& name, std::vector<JsonMember> members);
    [[nodiscard]] Places make_bands(RequiredArea area);

    [[nodiscard]] std::vector<CalculationSurface>& surfaces() const {
        return reader_.project.surfaces;
    }

    const JsonObject& entry_;
    ProjectReader& reader_;
    const Room* room_ = nullptr;
    std::map<RequiredArea, Places> places_;
    bool has_failed_ = false;
};

} // namespace isolux
