#include "isolux/io/requirement_places.h"

#include <algorithm>

#include <fmt/format.h>

#include "isolux/io/json_build.h"
#include "isolux/io/project_bands.h"
#include "isolux/io/suggest.h"
#include "isolux/io/words.h"

namespace isolux {

namespace {

std::string why_no_band(const CalculationSurface& task, RequiredArea area) {
    if (!is_level_grid(task))
        return fmt::format("{} is no level grid, around which there would be a {}",
                           in_quotes(task.name),
                           area == RequiredArea::surrounding ? "band" : "background");
    return fmt::format("{} leaves no point of the room {} (edge zones of walls do not count)",
                       in_quotes(task.name),
                       area == RequiredArea::surrounding
                           ? fmt::format("within {} m around it", surrounding_width)
                           : fmt::format("between {} m and {} m around it",
                                         surrounding_width,
                                         surrounding_width + background_width));
}

} // namespace

std::vector<std::string> read_names(const JsonNode& node) {
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

bool RequirementPlaces::read_own() {
    if (const std::optional<JsonNode> node = entry_.find("area"))
        name_area(RequiredArea::task, *node);
    const std::optional<JsonNode> node = entry_.find("areas");
    if (!node)
        return !has_failed_;
    const JsonObject areas(
        *node, "areas", {"surrounding", "background", "walls", "ceiling", "space"});
    for (const JsonMember& m : node->value().members)
        if (const auto area = find_word<RequiredArea>(m.key))
            name_area(*area, node->member(m.key, m.value));
    return !has_failed_;
}

void RequirementPlaces::name_area(RequiredArea area, const JsonNode& node) {
    Places& places = places_[area];
    for (const std::string& name : read_names(node)) {
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

void RequirementPlaces::check_kind(RequiredArea area,
                                   std::size_t surface,
                                   const JsonNode& node) {
    const bool is_space = area == RequiredArea::space;
    if (surfaces()[surface].kind
        == (is_space ? IlluminanceKind::cylindrical : IlluminanceKind::planar))
        return;
    has_failed_ = true;
    node.error(fmt::format("surface \"{}\" measures another quantity ({} is judged here)",
                           surfaces()[surface].name,
                           is_space ? "cylindrical illuminance" : "illuminance on a plane"));
}

const Places& RequirementPlaces::of(RequiredArea area, const Room* room) {
    room_ = room;
    if (!places_.contains(area))
        places_[area] = make_places(area);
    return places_[area];
}

Places RequirementPlaces::make_places(RequiredArea area) {
    if (area == RequiredArea::surrounding || area == RequiredArea::background)
        return make_bands(area);
    if (room_ == nullptr)
        return {{}, "there is no room to make this area from"};
    const std::string& room = room_->name;
    JsonValue named = json_object({{"room", json_text(room)}});
    switch (area) {
    case RequiredArea::task:
        return make(room + " work plane", {{"work_plane", std::move(named)}});
    case RequiredArea::ceiling:
        return make(room + " ceiling", {{"ceiling", std::move(named)}});
    case RequiredArea::space: {
        named.members.push_back({"height", json_number(seated_head_height)});
        static_cast<void>(make(room + " heads, horizontal", {{"work_plane", named}}));
        return make(room + " heads",
                    {{"work_plane", std::move(named)}, {"quantity", json_text("cylindrical")}});
    }
    default:
        return make_walls();
    }
}

Places RequirementPlaces::make_walls() {
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
Places RequirementPlaces::make(const std::string& name, std::vector<JsonMember> members) {
    if (const auto known = find_surface(name))
        return {{*known}, {}};
    const JsonValue value = json_object(std::move(members));
    Problems own(reader_.problems.file());
    std::optional<CalculationSurface> surface =
        read_one_surface(JsonNode(value, entry_.node().pointer(), own), reader_);
    if (!surface)
        return {{}, own.errors().empty() ? "it could not be made" : own.errors().front().what};
    surface->name = name;
    if (surface->name == room_->name + " ceiling")
        leave_out_luminaires(*surface, reader_.project.scene);
    if (surface->receivers.empty())
        return {{}, "no point is left to measure"};
    surfaces().push_back(std::move(*surface));
    return {{surfaces().size() - 1}, {}};
}

Places RequirementPlaces::make_bands(RequiredArea area) {
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
        std::optional<CalculationSurface> band = area == RequiredArea::surrounding
                                                     ? make_surrounding(surfaces()[task], room_)
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

std::optional<std::size_t> RequirementPlaces::find_surface(const std::string& name) const {
    const std::vector<CalculationSurface>& all = reader_.project.surfaces;
    const auto found =
        std::ranges::find_if(all, [&](const CalculationSurface& s) { return s.name == name; });
    if (found == all.end())
        return std::nullopt;
    return static_cast<std::size_t>(found - all.begin());
}

} // namespace isolux
