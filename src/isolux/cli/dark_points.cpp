#include "isolux/cli/dark_points.h"

#include <fmt/format.h>

#include "isolux/cli/console.h"

namespace isolux {

void DarkPoints::count(const Point3& place) {
    ++places_;
    if (space_->is_outside(place))
        ++outside_;
    else if (space_->object_around(place))
        ++in_objects_;
}

void DarkPoints::count(const Point3& eye, const Vector3& direction) {
    if (space_->looks_through_opening(eye, direction))
        ++places_;
    else
        count(eye);
}

void DarkPoints::report() const {
    if (outside_ > 0)
        report_notice({"stdin",
                       fmt::format("{} of {} {} outside every room (no light of a room "
                                   "gets there)",
                                   outside_,
                                   places_,
                                   thing_),
                       extents_in_words(space_->rooms())});
    if (in_objects_ > 0)
        report_notice({"stdin",
                       fmt::format("{} of {} {} inside an object (they get no light)",
                                   in_objects_,
                                   places_,
                                   thing_),
                       ""});
}

} // namespace isolux
