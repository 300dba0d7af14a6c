#pragma once

#include <cstddef>

#include "isolux/scene/scene_space.h"

namespace isolux {

/// Counts places on standard input where no light of a room comes: the answer there is 0, in
/// silence.
class DarkPoints {
public:
    /// @param thing  what they are called, in the plural
    /// @pre space outlives this
    DarkPoints(const SceneSpace& space, const char* thing) : space_(&space), thing_(thing) {}

    void count(const Point3& place);

    /// A line of sight from outside may look in through an opening.
    void count(const Point3& eye, const Vector3& direction);

    /// Notices on standard error, one for each kind.
    void report() const;

private:
    const SceneSpace* space_;
    const char* thing_;
    std::size_t places_ = 0;
    std::size_t outside_ = 0;
    std::size_t in_objects_ = 0;
};

} // namespace isolux
