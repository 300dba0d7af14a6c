#include "isolux/io/requirement_observers.h"

#include <algorithm>

#include <fmt/format.h>

#include "isolux/io/project_observers.h"
#include "isolux/io/requirement_places.h"
#include "isolux/io/suggest.h"
#include "isolux/io/words.h"

namespace isolux {

namespace {

/// What stands for the grid of observers that isolux adds.
constexpr std::string_view grid_word = "grid";

} // namespace

bool RequirementObservers::read_own() {
    const std::optional<JsonNode> node = entry_.find("observers");
    if (!node)
        return true;
    bool is_right = true;
    std::vector<std::string> names;
    for (std::size_t g = 0; g < own_groups_; ++g)
        names.push_back(groups()[g].name);
    const bool has_group_grid = std::ranges::find(names, grid_word) != names.end();
    names.emplace_back(grid_word);
    for (const std::string& name : read_names(*node)) {
        if (name == grid_word && has_group_grid) {
            node->error("\"grid\" may be the group of that name or the grid that isolux adds "
                        "(which one is meant?)",
                        "Give the group another name?");
            is_right = false;
        } else if (std::ranges::find(names, name) == names.end()) {
            node->error(fmt::format("unknown observers \"{}\" (neither the name of a group in "
                                    "observers nor \"grid\")",
                                    name),
                        did_you_mean(name, names));
            is_right = false;
        }
        if (std::ranges::find(named_, name) == named_.end())
            named_.push_back(name);
    }
    return is_right;
}

std::vector<std::size_t> RequirementObservers::of(const Requirement& r, const Room* room) {
    room_ = room;
    are_asked_ = true;
    const bool is_outdoor = r.quantity == RequiredQuantity::glare_rating;
    const GlareScale scale = is_outdoor ? GlareScale::outdoor : GlareScale::unified;
    return named_.empty() ? find_observers(r, scale) : observers_by_name(r, scale);
}

void RequirementObservers::check_use(const std::string& row, bool are_left_out) const {
    if (named_.empty() || are_asked_)
        return;
    const std::string why = are_left_out ? "\"leave_out\" leaves them out"
                                         : fmt::format("row {} limits no glare", row);
    entry_.find("observers")
        ->notice(fmt::format("nobody is judged at these observers ({})", why),
                 "Leave \"observers\" out?");
}

std::vector<std::size_t> RequirementObservers::observers_by_name(const Requirement& r,
                                                                 GlareScale scale) {
    const JsonNode node = *entry_.find("observers");
    std::vector<std::size_t> chosen;
    for (const std::string& name : named_) {
        if (name == grid_word) {
            if (scale == GlareScale::outdoor || room_ == nullptr)
                node.error(scale == GlareScale::outdoor
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
std::vector<std::size_t> RequirementObservers::find_observers(const Requirement& r,
                                                              GlareScale scale) {
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
    entry_.node().notice(
        fmt::format("{} of row {} is judged at your observers {} only",
                    r.symbol,
                    r.row,
                    enumerate(names, "and")),
        fmt::format("\"observers\": [{}\"{}\"] adds the grid of the room", list, grid_word));
    return own;
}

/// What the grid of the room is called; a group of the user's with that name is it.
std::string RequirementObservers::grid_name() const { return room_->name + " observers"; }

/// @pre there is a room
std::optional<std::size_t> RequirementObservers::make_grid() {
    const std::optional<std::size_t> known = find_group(grid_name());
    if (known && groups()[*known].scale == GlareScale::unified)
        return known;
    ObserverGroup made = make_room_observers(entry_.node(), *room_, reader_);
    if (made.sight_lines.empty())
        return std::nullopt;
    groups().push_back(std::move(made));
    return groups().size() - 1;
}

std::optional<std::size_t> RequirementObservers::find_group(const std::string& name) const {
    const auto found = std::ranges::find(groups(), name, &ObserverGroup::name);
    if (found == groups().end())
        return std::nullopt;
    return static_cast<std::size_t>(found - groups().begin());
}

} // namespace isolux
