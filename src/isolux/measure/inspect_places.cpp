#include "isolux/measure/inspect_places.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace isolux {
namespace {

std::string words(const Point3& p) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z);
}

/// "16 of 45 points", "all 45 points"
std::string share(std::size_t some, std::size_t all, const char* thing) {
    if (all == 1)
        return fmt::format("its {}", thing);
    return some == all ? fmt::format("all {} {}s", all, thing)
                       : fmt::format("{} of {} {}s", some, all, thing);
}

/// "'desk 1', 'desk 2' and 4 more"
std::string enumerate_objects(const std::vector<std::size_t>& objects,
                              const SceneDescription& description) {
    constexpr std::size_t most_names = 3;
    const std::size_t named = objects.size() > most_names + 1 ? most_names : objects.size();
    std::string text;
    for (std::size_t i = 0; i < named; ++i) {
        const bool is_last = i + 1 == objects.size();
        text += fmt::format("{}'{}'",
                            i == 0    ? ""
                            : is_last ? " and "
                                      : ", ",
                            description.objects[objects[i]].name);
    }
    if (named < objects.size())
        text += fmt::format(" and {} more", objects.size() - named);
    return text;
}

class Inspection {
public:
    explicit Inspection(const SceneDescription& description)
        : description_(description), space_(description) {}

    void inspect(const CalculationSurface& surface) {
        const std::string where = fmt::format("surface '{}'", surface.name);
        std::vector<Point3> points;
        for (const Receiver& r : surface.receivers)
            points.push_back(r.point);
        inspect_outside(where, points, "point");
        inspect_inside(where, points, "point", "they get no light");
        inspect_facing(where, surface);
    }

    void inspect(const ObserverGroup& group) {
        std::vector<Point3> eyes;
        for (const SightLine& line : group.sight_lines)
            if (eyes.empty() || eyes.back() != line.eye)
                eyes.push_back(line.eye);
        const std::string where = fmt::format("observers '{}'", group.name);
        if (group.scale == GlareScale::unified)
            inspect_outside(where, eyes, "eye");
        inspect_inside(where, eyes, "eye", "no light reaches them");
    }

    void inspect(const View& view) {
        const std::string where = fmt::format("view '{}'", view.name);
        const Camera& c = view.camera;
        if (!space_.looks_through_opening(c.position, c.target - c.position))
            inspect_outside(where, {c.position}, "camera");
        inspect_inside(where, {c.position}, "camera", "it sees nothing else");
    }

    std::vector<Message> messages;

private:
    void inspect_outside(const std::string& where,
                         const std::vector<Point3>& points,
                         const char* thing) {
        std::size_t count = 0;
        Point3 first;
        for (const Point3& p : points)
            if (space_.is_outside(p) && ++count == 1)
                first = p;
        const char* why = space_.has_open_wall() ? "only light through an opening gets there"
                                                 : "no light of a room gets there";
        if (count > 0)
            messages.push_back({where,
                                fmt::format("{} {} outside every room, {}at {} ({})",
                                            share(count, points.size(), thing),
                                            count == 1 ? "lies" : "lie",
                                            count == 1 ? "" : "the first ",
                                            words(first),
                                            why),
                                extents_in_words(space_.rooms())});
    }

    void inspect_inside(const std::string& where,
                        const std::vector<Point3>& points,
                        const char* thing,
                        const char* why) {
        std::size_t count = 0;
        std::vector<std::size_t> objects;
        for (const Point3& p : points)
            if (const auto object = space_.object_around(p)) {
                ++count;
                if (std::ranges::find(objects, *object) == objects.end())
                    objects.push_back(*object);
            }
        if (count == 0)
            return;
        const bool is_surface = std::string_view(thing) == "point";
        messages.push_back({where,
                            fmt::format("{} {} inside {} ({})",
                                        share(count, points.size(), thing),
                                        count == 1 ? "lies" : "lie",
                                        enumerate_objects(objects, description_),
                                        why),
                            is_surface ? "Raise the surface, or leave the object out?"
                                       : "Move it out of the object?"});
    }

    /// Points next to a wall, floor or ceiling that look at it, not into the room.
    void inspect_facing(const std::string& where, const CalculationSurface& surface) {
        constexpr double before = 0.02; // m; closer to a wall nothing is measured on purpose
        if (surface.kind != IlluminanceKind::planar)
            return; // others have no dark side
        const auto faces_away = [&](const Receiver& r) {
            return !space_.is_outside(r.point)
                   && space_.is_outside(r.point + before * Vector3(r.axis));
        };
        const auto first = std::ranges::find_if(surface.receivers, faces_away);
        if (first == surface.receivers.end())
            return;
        const auto count =
            static_cast<std::size_t>(std::ranges::count_if(surface.receivers, faces_away));
        const auto room = std::ranges::find_if(
            space_.rooms(), [&](const Room& r) { return contains(r, first->point); });
        messages.push_back(
            {where,
             fmt::format("{} {} at the border of room \"{}\" and {} out of it, {}at {} "
                         "(no light of the room reaches that side)",
                         share(count, surface.receivers.size(), "point"),
                         count == 1 ? "lies" : "lie",
                         room->name,
                         count == 1 ? "looks" : "look",
                         count == 1 ? "" : "the first ",
                         words(first->point)),
             "Turn the normal round?"});
    }

    const SceneDescription& description_;
    SceneSpace space_;
};

} // namespace

std::vector<Message> inspect_places(const SceneDescription& description,
                                    std::span<const CalculationSurface> surfaces,
                                    std::span<const ObserverGroup> observers,
                                    std::span<const View> views) {
    Inspection inspection(description);
    for (const CalculationSurface& surface : surfaces)
        inspection.inspect(surface);
    for (const ObserverGroup& group : observers)
        inspection.inspect(group);
    for (const View& view : views)
        inspection.inspect(view);
    return std::move(inspection.messages);
}

} // namespace isolux
