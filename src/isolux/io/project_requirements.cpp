#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "isolux/io/json_build.h"
#include "isolux/io/project_bands.h"
#include "isolux/io/project_observers.h"
#include "isolux/io/project_reader.h"
#include "isolux/io/standard_json.h"
#include "isolux/io/suggest.h"
#include "isolux/io/words.h"

namespace isolux {

namespace {

/// Where a requirement looks: surfaces of the project, and why one is missing.
struct Places {
    std::vector<std::size_t> surfaces;
    std::string reason;
};

/// What stands for the grid of observers that isolux adds.
constexpr std::string_view grid_word = "grid";

/// One entry of "requirements".
class RequirementReader {
public:
    /// @param own_groups  how many groups of observers the project itself names
    RequirementReader(const JsonNode& node, ProjectReader& reader, std::size_t own_groups)
        : object_(
            node,
            "a requirement",
            {"standard", "row", "room", "area", "modified", "areas", "leave_out", "observers"}),
          reader_(reader), own_groups_(own_groups) {}

    void read(const std::vector<Standard>& standards) {
        const Standard* standard = find_standard(standards);
        const StandardRow* row = standard != nullptr ? find_wanted_row(*standard) : nullptr;
        room_ = find_room_of();
        read_own_areas();
        read_own_observers();
        if (row == nullptr || has_failed_)
            return;
        const bool modified = object_.boolean("modified", false);
        const std::vector<std::string> left_out = read_names("leave_out");
        for (const Requirement& r : requirements_of(
                 *standard, *row, modified ? RowLevel::modified : RowLevel::required))
            if (std::ranges::find(left_out, to_word(r.area)) == left_out.end())
                add(r);
    }

private:
    // ---- what the entry says ----------------------------------------------------------------

    const Standard* find_standard(const std::vector<Standard>& standards) {
        const std::optional<JsonNode> node = object_.require("standard");
        const std::optional<std::string> name = node ? read_text(*node) : std::nullopt;
        if (!name)
            return nullptr;
        std::vector<std::string> names;
        for (const Standard& s : standards) {
            if (s.name == *name)
                return &s;
            names.push_back(s.name);
        }
        const auto begins = [&](const Standard& s) { return s.name.starts_with(*name + ":"); };
        if (std::ranges::count_if(standards, begins) == 1)
            return &*std::ranges::find_if(standards, begins); // the year may be left out
        const auto is_longer = [&](const Standard& s) { return s.name.starts_with(*name); };
        const auto longer = std::ranges::find_if(standards, is_longer);
        node->error(fmt::format("unknown standard \"{}\" (known are {})",
                                *name,
                                enumerate(names, "and")),
                    longer != standards.end() ? fmt::format(
                        "Did you mean \"{}\"?", longer->name.substr(0, longer->name.find(':')))
                                              : did_you_mean(*name, names));
        return nullptr;
    }

    const StandardRow* find_wanted_row(const Standard& standard) {
        const std::optional<JsonNode> node = object_.require("row");
        const std::optional<std::string> id = node ? read_text(*node) : std::nullopt;
        if (!id)
            return nullptr;
        if (const StandardRow* row = find_row(standard, *id))
            return row;
        std::vector<std::string> ids;
        for (const StandardRow& r : standard.rows)
            ids.push_back(r.id);
        const std::string near = did_you_mean(*id, ids);
        const std::string remedy = "`isolux standards WORD` finds rows";
        node->error(fmt::format("{} has no row \"{}\" (rows are numbered as in this edition, "
                                "\"{}\" for example)",
                                standard.name,
                                *id,
                                ids.empty() ? "" : ids.front()),
                    near.empty() ? remedy : near + " " + remedy);
        return nullptr;
    }

    /// The entry's room, the room of its task area, or the only one there is.
    const Room* find_room_of() {
        const std::vector<Room>& rooms = reader_.project.scene.rooms;
        if (object_.has("room")) {
            const Room* room = reader_.find_room(object_);
            has_failed_ |= room == nullptr;
            return room;
        }
        for (const std::string& name : read_names("area"))
            if (const auto s = find_surface(name))
                for (const Room& room : rooms)
                    if (contains(room, surfaces()[*s].receivers.front().point))
                        return &room;
        if (rooms.size() == 1 || object_.has("area"))
            return rooms.size() == 1 ? &rooms.front() : nullptr;
        has_failed_ = true;
        object_.node().error("neither \"area\" nor \"room\" is given (what must meet the "
                             "requirement?)");
        return nullptr;
    }

    /// A name, or a list of names; missing: none.
    std::vector<std::string> read_names(const char* key) const {
        const std::optional<JsonNode> node = object_.find(key);
        return node ? names_of(*node) : std::vector<std::string>();
    }

    static std::vector<std::string> names_of(const JsonNode& node) {
        std::vector<std::string> names;
        if (node.is(JsonValue::Kind::array)) {
            for (const JsonNode& item : read_list(node, 1))
                if (std::optional<std::string> name = read_text(item))
                    names.push_back(std::move(*name));
        } else if (std::optional<std::string> name = read_text(node)) {
            names.push_back(std::move(*name));
        }
        return names;
    }

    /// "area" and "areas": surfaces that the user names himself.
    void read_own_areas() {
        if (const std::optional<JsonNode> node = object_.find("area"))
            name_area(RequiredArea::task, *node);
        const std::optional<JsonNode> node = object_.find("areas");
        if (!node)
            return;
        const JsonObject areas(
            *node, "areas", {"surrounding", "background", "walls", "ceiling", "space"});
        for (const JsonMember& m : node->value().members)
            if (const auto area = find_word<RequiredArea>(m.key))
                name_area(*area, node->member(m.key, m.value));
    }

    void name_area(RequiredArea area, const JsonNode& node) {
        Places& places = places_[area];
        for (const std::string& name : names_of(node)) {
            if (const auto s = find_surface(name)) {
                places.surfaces.push_back(*s);
                check_kind(area, *s, node);
                continue;
            }
            has_failed_ = true;
            std::vector<std::string> names;
            for (const CalculationSurface& s : surfaces())
                names.push_back(s.name);
            node.error(fmt::format("unknown surface \"{}\" (surfaces has no such name)", name),
                       did_you_mean(name, names));
        }
    }

    void check_kind(RequiredArea area, std::size_t surface, const JsonNode& node) {
        const bool is_space = area == RequiredArea::space;
        if (surfaces()[surface].kind
            == (is_space ? IlluminanceKind::cylindrical : IlluminanceKind::planar))
            return;
        has_failed_ = true;
        node.error(
            fmt::format("surface \"{}\" measures another quantity ({} is judged here)",
                        surfaces()[surface].name,
                        is_space ? "cylindrical illuminance" : "illuminance on a plane"));
    }

    /// "observers": groups that the user names himself, and the grid.
    void read_own_observers() {
        const std::optional<JsonNode> node = object_.find("observers");
        if (!node)
            return;
        std::vector<std::string> names;
        for (std::size_t g = 0; g < own_groups_; ++g)
            names.push_back(groups()[g].name);
        const bool has_group_grid = std::ranges::find(names, grid_word) != names.end();
        names.emplace_back(grid_word);
        for (const std::string& name : names_of(*node)) {
            if (name == grid_word && has_group_grid) {
                node->error(
                    "\"grid\" may be the group of that name or the grid that isolux adds "
                    "(which one is meant?)",
                    "Give the group another name?");
                has_failed_ = true;
            } else if (std::ranges::find(names, name) == names.end()) {
                node->error(
                    fmt::format("unknown observers \"{}\" (neither the name of a group in "
                                "observers nor \"grid\")",
                                name),
                    did_you_mean(name, names));
                has_failed_ = true;
            }
            if (std::ranges::find(named_observers_, name) == named_observers_.end())
                named_observers_.push_back(name);
        }
    }

    // ---- surfaces that follow from it -------------------------------------------------------

    void add(const Requirement& r) {
        ProjectRequirement asked{r, {}, std::nullopt, {}};
        switch (r.area) {
        case RequiredArea::luminaires:
            asked.subject = "luminaires";
            break;
        case RequiredArea::observers:
            add_for_observers(asked);
            return;
        case RequiredArea::room:
            asked.subject = room_ != nullptr ? room_->name : "project";
            break;
        default:
            add_on_surfaces(asked);
            return;
        }
        reader_.project.requirements.push_back(std::move(asked));
    }

    /// One verdict for each group that is asked.
    void add_for_observers(ProjectRequirement asked) {
        const bool is_outdoor = asked.requirement.quantity == RequiredQuantity::glare_rating;
        const GlareScale scale = is_outdoor ? GlareScale::outdoor : GlareScale::unified;
        const std::vector<std::size_t> chosen =
            named_observers_.empty() ? find_observers(asked.requirement, scale)
                                     : observers_by_name(asked.requirement, scale);
        for (const std::size_t g : chosen) {
            asked.observers = g;
            asked.subject = groups()[g].name;
            reader_.project.requirements.push_back(asked);
        }
        if (!chosen.empty())
            return;
        asked.subject = "observers";
        asked.reason = "the project has no observers of this kind";
        reader_.project.requirements.push_back(std::move(asked));
    }

    std::vector<std::size_t> observers_by_name(const Requirement& r, GlareScale scale) {
        const JsonNode node = *object_.find("observers");
        std::vector<std::size_t> chosen;
        for (const std::string& name : named_observers_) {
            if (name == grid_word) {
                if (scale == GlareScale::outdoor || room_ == nullptr)
                    node.error(
                        scale == GlareScale::outdoor
                            ? "isolux adds no grid of observers for GR (where people look "
                              "outdoors is for the project to say)"
                            : "there is no room for a grid of observers",
                        "Name groups of your own?");
                else if (const std::optional<std::size_t> grid = make_grid())
                    chosen.push_back(*grid);
                continue;
            }
            const std::size_t g = *find_group(name);
            if (groups()[g].scale == scale)
                chosen.push_back(g);
            else
                node.error(fmt::format("the observers \"{}\" are rated by another scale ({} is "
                                       "limited by row {})",
                                       name,
                                       r.symbol,
                                       r.row));
        }
        return chosen;
    }

    /// The user's own groups in the room, and a notice that they are; indoors the grid where
    /// there is none.
    std::vector<std::size_t> find_observers(const Requirement& r, GlareScale scale) {
        const bool can_have_grid = scale == GlareScale::unified && room_ != nullptr;
        std::vector<std::size_t> own;
        std::vector<std::string> names;
        for (std::size_t g = 0; g < own_groups_; ++g)
            if (const ObserverGroup& group = groups()[g];
                group.scale == scale && (room_ == nullptr || group.room == room_->name)) {
                own.push_back(g);
                names.push_back(group.name);
            }
        if (!can_have_grid)
            return own;
        if (own.empty()) {
            const std::optional<std::size_t> grid = make_grid();
            return grid ? std::vector{*grid} : own;
        }
        if (std::ranges::find(names, grid_name()) != names.end())
            return own; // a group of the user's stands for the grid
        std::string list;
        for (const std::string& name : names)
            list += in_quotes(name) + ", ";
        object_.node().notice(fmt::format("{} of row {} is judged at your observers {} only",
                                          r.symbol,
                                          r.row,
                                          enumerate(names, "and")),
                              fmt::format("\"observers\": [{}\"{}\"] adds the grid of the room",
                                          list,
                                          grid_word));
        return own;
    }

    /// What the grid of the room is called; a group of the user's with that name is it.
    std::string grid_name() const { return room_->name + " observers"; }

    /// @pre there is a room
    std::optional<std::size_t> make_grid() {
        const std::optional<std::size_t> known = find_group(grid_name());
        if (known && groups()[*known].scale == GlareScale::unified)
            return known;
        ObserverGroup made = make_room_observers(object_.node(), *room_, reader_);
        if (made.sight_lines.empty())
            return std::nullopt;
        groups().push_back(std::move(made));
        return groups().size() - 1;
    }

    void add_on_surfaces(ProjectRequirement asked) {
        const RequiredArea area = asked.requirement.area;
        if (!places_.contains(area))
            places_[area] = make_places(area);
        const Places& places = places_[area];
        for (const std::size_t s : places.surfaces) {
            asked.surface = s;
            asked.subject = surfaces()[s].name;
            reader_.project.requirements.push_back(asked);
        }
        if (places.reason.empty())
            return;
        asked.surface.reset();
        asked.subject = std::string(to_word(area));
        asked.reason = places.reason;
        reader_.project.requirements.push_back(std::move(asked));
    }

    Places make_places(RequiredArea area) {
        if (area == RequiredArea::surrounding || area == RequiredArea::background)
            return make_bands(area);
        if (room_ == nullptr)
            return {{}, "there is no room to make this area from"};
        const std::string& room = room_->name;
        JsonValue named = json_object({{"room", json_text(room)}});
        switch (area) {
        case RequiredArea::task:
            return make(room + " work plane", {{"work_plane", std::move(named)}});
        case RequiredArea::ceiling: {
            Places ceiling = make(room + " ceiling", {{"ceiling", std::move(named)}});
            return ceiling;
        }
        case RequiredArea::space: {
            named.members.push_back({"height", json_number(seated_head_height)});
            make(room + " heads, horizontal", {{"work_plane", named}});
            return make(
                room + " heads",
                {{"work_plane", std::move(named)}, {"quantity", json_text("cylindrical")}});
        }
        default:
            return make_walls();
        }
    }

    Places make_walls() {
        Places all;
        for (std::size_t w = 0; w < room_->footprint.size(); ++w) {
            const Places one =
                make(fmt::format("{} wall {}", room_->name, w + 1),
                     {{"wall",
                       json_object({{"room", json_text(room_->name)},
                                    {"number", json_number(static_cast<double>(w + 1))}})}});
            all.surfaces.insert(all.surfaces.end(), one.surfaces.begin(), one.surfaces.end());
        }
        if (all.surfaces.empty())
            all.reason = "no wall has a point to measure";
        return all;
    }

    /// The surface of that name, or a new one as "surfaces" would describe it.
    Places make(const std::string& name, std::vector<JsonMember> members) {
        if (const auto known = find_surface(name))
            return {{*known}, {}};
        const JsonValue value = json_object(std::move(members));
        Problems own(reader_.problems.file());
        std::optional<CalculationSurface> surface =
            read_one_surface(JsonNode(value, object_.node().pointer(), own), reader_);
        if (!surface)
            return {{},
                    own.errors().empty() ? "it could not be made" : own.errors().front().what};
        surface->name = name;
        if (surface->name == room_->name + " ceiling")
            leave_out_luminaires(*surface, reader_.project.scene);
        if (surface->receivers.empty())
            return {{}, "no point is left to measure"};
        surfaces().push_back(std::move(*surface));
        return {{surfaces().size() - 1}, {}};
    }

    Places make_bands(RequiredArea area) {
        if (!places_.contains(RequiredArea::task))
            places_[RequiredArea::task] = make_places(RequiredArea::task);
        Places all;
        all.reason = places_[RequiredArea::task].reason;
        for (const std::size_t task : places_[RequiredArea::task].surfaces) {
            const std::string name = surfaces()[task].name + " " + std::string(to_word(area));
            if (const auto known = find_surface(name)) {
                all.surfaces.push_back(*known);
                continue;
            }
            std::optional<CalculationSurface> band =
                area == RequiredArea::surrounding ? make_surrounding(surfaces()[task], room_)
                                                  : make_background(surfaces()[task], room_);
            if (!band) {
                all.reason +=
                    (all.reason.empty() ? "" : "; ") + why_no_band(surfaces()[task], area);
                continue;
            }
            band->name = name;
            surfaces().push_back(std::move(*band));
            all.surfaces.push_back(surfaces().size() - 1);
        }
        if (!all.reason.empty())
            all.reason += fmt::format(": name a surface under \"areas\", or put \"{}\" into "
                                      "\"leave_out\"",
                                      to_word(area));
        return all;
    }

    static std::string why_no_band(const CalculationSurface& task, RequiredArea area) {
        if (!is_level_grid(task))
            return fmt::format("{} is no level grid, around which there would be a {}",
                               in_quotes(task.name),
                               area == RequiredArea::surrounding ? "band" : "background");
        return fmt::format(
            "{} leaves no point of the room {} (edge zones of walls do not count)",
            in_quotes(task.name),
            area == RequiredArea::surrounding
                ? fmt::format("within {} m around it", surrounding_width)
                : fmt::format("between {} m and {} m around it",
                              surrounding_width,
                              surrounding_width + background_width));
    }

    // ---- details ----------------------------------------------------------------------------

    std::vector<CalculationSurface>& surfaces() { return reader_.project.surfaces; }

    std::vector<ObserverGroup>& groups() { return reader_.project.observers; }

    std::optional<std::size_t> find_group(const std::string& name) {
        const auto found = std::ranges::find(groups(), name, &ObserverGroup::name);
        if (found == groups().end())
            return std::nullopt;
        return static_cast<std::size_t>(found - groups().begin());
    }

    std::optional<std::size_t> find_surface(const std::string& name) const {
        const std::vector<CalculationSurface>& all = reader_.project.surfaces;
        const auto found = std::ranges::find_if(
            all, [&](const CalculationSurface& s) { return s.name == name; });
        if (found == all.end())
            return std::nullopt;
        return static_cast<std::size_t>(found - all.begin());
    }

    JsonObject object_;
    ProjectReader& reader_;
    std::size_t own_groups_;
    const Room* room_ = nullptr;
    std::map<RequiredArea, Places> places_;
    std::vector<std::string> named_observers_; ///< by the user; "grid" is the room's grid
    bool has_failed_ = false;
};

std::vector<Standard> read_standards(const JsonObject& project, ProjectReader& reader) {
    std::vector<Standard> standards;
    if (const std::optional<JsonNode> list = project.find("standards"))
        for (const JsonNode& node : read_list(*list)) {
            if (!read_text(node, 4096))
                continue;
            const std::optional<std::string> text = reader.read_file(node, 16'000'000);
            if (!text)
                continue;
            try {
                standards.push_back(
                    parse_standard(*text, reader.path_of(node).generic_string()));
            } catch (const InputError& error) {
                reader.problems.add_errors(error.messages());
            }
        }
    for (Standard& s : builtin_standards())
        standards.push_back(std::move(s)); // the user's own come first
    return standards;
}

} // namespace

void read_requirements(const JsonObject& project, ProjectReader& reader) {
    if (!project.has("requirements") && !project.has("standards"))
        return;
    const std::vector<Standard> standards = read_standards(project, reader);
    if (!reader.problems.errors().empty())
        return; // areas that depend on what is wrong would only add to the noise
    const std::size_t own_groups = reader.project.observers.size();
    if (const std::optional<JsonNode> list = project.find("requirements"))
        for (const JsonNode& node : read_list(*list))
            RequirementReader(node, reader, own_groups).read(standards);
}

} // namespace isolux
