#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "isolux/base/receiver.h"
#include "isolux/scene/scene.h"
#include "isolux/transport/emission.h"
#include "isolux/transport/point_randomness.h"

/// Rays from an eye through panes and mirrors to what they show.
namespace isolux {

/// Panes and half-mirrors at which an eye's ray is followed both ways; behind them one way is
/// chosen, METHODS eq. (86).
inline constexpr std::size_t certain_splits = 2;

/// A diffuse surface that an eye sees, maybe behind panes and in mirrors.
struct SeenSurface {
    Point3 at;               ///< moved off the surface towards the eye
    UnitVector3 normal;      ///< towards the eye
    Rgb diffuse;             ///< reflectance
    double throughput = 1.0; ///< of the panes and mirrors on the way, over their probability
    double travelled = 0.0;  ///< m from the eye, along all pieces of the ray
    std::uint32_t reflections = 0; ///< mirrors on the way
    TriangleId triangle;
};

/// What one ray shows.
struct EyePath {
    Rgb luminaires; ///< cd/m2 of openings seen straight, through panes and in mirrors
    std::vector<SeenSurface> surfaces;
    bool is_certain = true; ///< no random number was drawn: every replicate sees the same
};

/// Follows the ray of an eye. A luminaire counts with the luminance of its opening, METHODS eq.
/// (87); one without extent cannot be seen. Panes and mirrors up to `certain_splits` deep send
/// the ray both ways with both weights; deeper ones choose by their shares, and roulette ends
/// the chain.
/// @param path  is overwritten; its memory is used again
/// @param first  what the ray meets first, if that is known
void follow_eye(const Scene& scene,
                const Emission& emission,
                const SightLine& line,
                NumberSequence& numbers,
                EyePath& path,
                std::uint64_t& rays,
                const std::optional<SurfaceHit>* first = nullptr);

} // namespace isolux
