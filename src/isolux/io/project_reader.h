#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/calc/project.h"
#include "isolux/io/json_node.h"
#include "isolux/io/project_materials.h"

/// The parts of the project reader; each reads one key of the project file. What is wrong goes
/// to the Problems behind the nodes; reading goes on, so that the user sees all of it at once.
namespace isolux {

/// A room of the file. A name that was read counts as known even if the room is wrong, so that
/// one mistake gives one message.
struct RoomEntry {
    std::string name;
    std::optional<std::size_t> index; ///< in SceneDescription::rooms; none if it is wrong
};

struct LuminaireTypeEntry {
    std::optional<LuminaireTypeId> id; ///< none if the type is wrong
    double scale = 1.0;                ///< maintenance factor x dimming
    bool turn_length_to_x = false;     ///< the opening is longer along y and shall not be
};

/// What the parts share while a project is read.
struct ProjectReader {
    ProjectReader(std::filesystem::path path, Problems& collected);

    std::filesystem::path folder; ///< where the project's files are
    Problems& problems;
    Project project;
    MaterialTable materials;
    std::vector<RoomEntry> rooms;
    std::map<std::string, LuminaireTypeEntry> luminaire_types;
    /// Names in entries that are wrong: no follow-on errors about these.
    std::set<std::string> lost_names;
    MaintenanceFactor maintenance;
    bool states_maintenance = false; ///< somewhere in the file

    /// The file's bytes; nothing, and an error at `node`, if it cannot be read.
    [[nodiscard]] std::optional<std::string> read_file(const JsonNode& node,
                                                       std::uintmax_t largest);
    /// Notes what was read in Project::inputs.
    void add_input(std::string file, std::string_view bytes);
    /// A file's path as messages show it.
    [[nodiscard]] std::filesystem::path path_of(const JsonNode& node) const;

    /// The room that `owner`'s key "room" names, or the only one there is. Nothing if the name
    /// is unknown or missing (reported), or if that room is wrong (reported elsewhere).
    [[nodiscard]] const Room* find_room(const JsonObject& owner) const;
    [[nodiscard]] bool has_wrong_room() const noexcept;
};

void read_settings(const JsonNode& node, Settings& settings);
void read_rooms(const JsonNode& node, ProjectReader& reader);
/// Adds a door or window to a room that has its footprint and height.
void read_opening(const JsonNode& node, ProjectReader& reader, Room& room);
/// Adds a column; its coordinates are those of the footprint, before the room is moved.
void read_column(const JsonNode& node, ProjectReader& reader, Room& room);
void read_objects(const JsonNode& node, ProjectReader& reader);
void read_luminaire_types(const JsonNode& node, ProjectReader& reader);
void read_luminaires(const JsonNode& node, ProjectReader& reader);
void read_surfaces(const JsonNode& node, ProjectReader& reader);
/// One entry of "surfaces"; nothing means the error has been reported.
[[nodiscard]] std::optional<CalculationSurface> read_one_surface(const JsonNode& node,
                                                                 ProjectReader& reader);
/// "standards" and "requirements": what the project must meet. Adds the surfaces they need to
/// the project. @pre surfaces, luminaires and rooms have been read
void read_requirements(const JsonObject& project, ProjectReader& reader);
/// Rooms as energy sees them, and how they are used.
void read_energy(const JsonObject& project, ProjectReader& reader);
/// Named states of the luminaires. @pre luminaires have been read
void read_scenes(const JsonNode& node, ProjectReader& reader);
/// A factor as a number, or as an object of LLMF, LSF, LMF, RSMF.
[[nodiscard]] std::optional<MaintenanceFactor> read_maintenance(const JsonNode& node);
void read_views(const JsonNode& node, ProjectReader& reader);
/// The work plane of every room, for a project that names no surface.
void add_default_surfaces(ProjectReader& reader);

/// Which wall of a footprint has which number, for hints.
[[nodiscard]] std::string walls_in_words(const std::vector<Point2>& footprint);
/// From 1; whether the room has so many is for the caller to see.
/// @param footprint  of the room, to tell which wall has which number; empty: not known
[[nodiscard]] std::optional<std::int64_t>
read_wall_number(const JsonNode& node, const std::vector<Point2>& footprint);

// Short forms; nothing means the error has been reported.
[[nodiscard]] std::optional<double> read_distance(const JsonNode& node); ///< 0 or more, m
[[nodiscard]] std::optional<Point3> read_point(const JsonNode& node);
[[nodiscard]] std::optional<Vector3> read_vector(const JsonNode& node);
[[nodiscard]] std::optional<Point2> read_point2(const JsonNode& node);
[[nodiscard]] std::optional<Point2> read_size2(const JsonNode& node);
/// Corners of a polygon, as written.
[[nodiscard]] std::optional<std::vector<Point2>> read_outline(const JsonNode& node);
/// Whether the corners make a simple polygon, in either direction; reports the first thing that
/// is wrong.
[[nodiscard]] bool check_outline(const JsonNode& node, const std::vector<Point2>& outline);

inline constexpr double shortest_wall = 1e-3; ///< m; the finest detail a room may have

} // namespace isolux
