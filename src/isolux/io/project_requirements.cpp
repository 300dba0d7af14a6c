#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "isolux/io/project_reader.h"
#include "isolux/io/requirement_observers.h"
#include "isolux/io/requirement_places.h"
#include "isolux/io/standard_json.h"
#include "isolux/io/suggest.h"
#include "isolux/io/words.h"

namespace isolux {

namespace {

/// One entry of "requirements".
class RequirementReader {
public:
    /// @param own_groups  how many groups of observers the project itself names
    RequirementReader(const JsonNode& node, ProjectReader& reader, std::size_t own_groups)
        : object_(
            node,
            "a requirement",
            {"standard", "row", "room", "area", "modified", "areas", "leave_out", "observers"}),
          reader_(reader), places_(object_, reader), observers_(object_, reader, own_groups) {}

    void read(const std::vector<Standard>& standards) {
        const Standard* standard = find_standard(standards);
        const StandardRow* row = standard != nullptr ? find_wanted_row(*standard) : nullptr;
        room_ = find_room_of();
        has_failed_ |= !places_.read_own();
        has_failed_ |= !observers_.read_own();
        if (row == nullptr || has_failed_)
            return;
        const bool modified = object_.boolean("modified", false);
        const std::vector<std::string> left_out = names_in("leave_out");
        for (const Requirement& r : requirements_of(
                 *standard, *row, modified ? RowLevel::modified : RowLevel::required))
            if (std::ranges::find(left_out, to_word(r.area)) == left_out.end())
                add(r);
        observers_.check_use(row->id,
                             std::ranges::find(left_out, to_word(RequiredArea::observers))
                                 != left_out.end());
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
        for (const std::string& name : names_in("area"))
            if (const auto s = places_.find_surface(name))
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
    std::vector<std::string> names_in(const char* key) const {
        const std::optional<JsonNode> node = object_.find(key);
        return node ? read_names(*node) : std::vector<std::string>();
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
        const std::vector<std::size_t> chosen = observers_.of(asked.requirement, room_);
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

    void add_on_surfaces(ProjectRequirement asked) {
        const RequiredArea area = asked.requirement.area;
        const Places& places = places_.of(area, room_);
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

    // ---- details ----------------------------------------------------------------------------

    std::vector<CalculationSurface>& surfaces() { return reader_.project.surfaces; }

    std::vector<ObserverGroup>& groups() { return reader_.project.observers; }

    JsonObject object_;
    ProjectReader& reader_;
    RequirementPlaces places_;
    RequirementObservers observers_;
    const Room* room_ = nullptr;
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
