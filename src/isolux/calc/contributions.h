#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isolux/measure/grid_statistics.h"
#include "isolux/scene/scene.h"

/// Illuminance told apart by who sends it: the rows of a lighting installation's dimming
/// matrix. Light adds up, so every scene of dimmed groups follows from one calculation, with
/// its errors (METHODS "Contributions").
namespace isolux {

/// What counts as one source of light.
enum class SourceSplit {
    automatic, ///< by group, as long as the table stays below most_automatic_values
    none,      ///< no table
    groups,    ///< dimming groups; luminaires without one by their type
    luminaires ///< every luminaire by itself
};

enum class SourceKind { group, type, luminaire };

/// Some luminaires that are switched together.
struct LightSource {
    std::string name; ///< of the group, the luminaire type or the luminaire; no two are equal
    SourceKind kind = SourceKind::luminaire;
    double flux = 0.0; ///< lm, all factors of the project applied; 0 for one dimmed to nothing
    std::vector<std::size_t> luminaires; ///< numbers in the scene, ascending
};

/// The scene's sources in the order in which they first appear; every luminaire belongs to
/// exactly one. A type's source takes "NAME (no group)" where a group has the type's name.
/// @param split  groups or luminaires
[[nodiscard]] std::vector<LightSource> find_light_sources(const Scene& scene,
                                                          SourceSplit split);

/// For every luminaire of a scene the number of its source.
[[nodiscard]] std::vector<std::uint32_t>
source_of_luminaires(std::span<const LightSource> sources, std::size_t luminaires);

/// Values, direct and reflected counted apart, up to which the table is kept without being
/// asked for: 64 MiB.
inline constexpr std::size_t most_automatic_values = 16U << 20U;

enum class LightPart { direct, indirect };

/// Illuminance by source, replicate and point, lx: 8 bytes for the two parts together. Points
/// stand as in the results, surface after surface. For every replicate and point the sum over
/// the sources is the total, up to the rounding of floats.
struct Contributions {
    std::vector<LightSource> sources;
    std::size_t replicates = 0;
    std::size_t points = 0;
    std::vector<float> direct; ///< [source][replicate][point]
    std::vector<float> indirect;

    [[nodiscard]] std::span<const float>
    row(LightPart part, std::size_t source, std::size_t replicate) const noexcept {
        const std::vector<float>& values = part == LightPart::direct ? direct : indirect;
        return std::span(values).subspan((source * replicates + replicate) * points, points);
    }
};

/// The sum over the sources, each times its level: illuminance of `points` points from
/// `first_point` on, replicate by replicate. summarise() and estimate_from_replicates() turn it
/// into values with errors.
/// @param levels  one a source, 1 for the light as calculated, 0 for off
/// @pre levels.size() == contributions.sources.size(), points inside the table
[[nodiscard]] ReplicateTable combine(const Contributions& contributions,
                                     std::span<const double> levels,
                                     std::size_t first_point,
                                     std::size_t points);

/// The same for one part of the light alone.
[[nodiscard]] ReplicateTable combine(const Contributions& contributions,
                                     LightPart part,
                                     std::span<const double> levels,
                                     std::size_t first_point,
                                     std::size_t points);

} // namespace isolux
