#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/calc/contributions.h"
#include "isolux/measure/surface_grid.h"
#include "isolux/scene/scene.h"

namespace isolux {

enum class Estimator { automatic, local_estimation, local_estimation_mis, path_tracing };

enum class Statement {
    per_point, ///< every interval holds at the stated confidence by itself
    all_points ///< all intervals of a surface hold at once (Bonferroni)
};

/// What the user may ask for. The tolerance is the one quality setting.
struct Settings {
    double tolerance = 0.01; ///< half width of the interval / value
    /// lx; a half width below this is good enough whatever the value. Beside it, a point darker
    /// than a fiftieth of its surface's mean is held to the tolerance of that fiftieth.
    double absolute_tolerance = 1e-4;
    double confidence = 0.95;
    std::optional<std::chrono::duration<double>> time_limit;
    std::uint64_t seed = 1;
    Estimator estimator = Estimator::automatic;
    Statement statement = Statement::per_point;
    bool direct_only = false;
    /// Whose light is kept apart in the results.
    SourceSplit contributions = SourceSplit::automatic;
    /// Whether the results hold the derivatives by reflectance.
    bool sensitivities = false;
    /// Exactly so many units of work instead of a tolerance, for experiments at equal work.
    std::optional<std::size_t> fixed_units;
};

/// A file that a calculation read, and its SHA-256: 64 lower-case hexadecimal digits.
struct InputFile {
    std::string file; ///< as the user or the project names it
    std::string sha256;

    friend bool operator==(const InputFile&, const InputFile&) = default;
};

/// A whole task, files read and placements expanded.
struct Project {
    std::string name;
    std::string description;
    InputFile file;                ///< the project file itself
    std::vector<InputFile> inputs; ///< every other file, in the order of reading
    SceneDescription scene;
    std::vector<CalculationSurface> surfaces;
    std::vector<std::string> length_aligned; ///< luminaire types laid along x on demand, names
    Settings settings;
    std::vector<Message> notices;
};

} // namespace isolux
