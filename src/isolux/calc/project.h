#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/calc/contributions.h"
#include "isolux/measure/camera.h"
#include "isolux/measure/energy.h"
#include "isolux/measure/glare.h"
#include "isolux/measure/requirement.h"
#include "isolux/measure/surface_grid.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// How reflected light is calculated. The last three are independent implementations, for
/// comparison and study: METHODS 2.4.
enum class Estimator {
    automatic,
    local_estimation,
    local_estimation_mis,
    path_tracing,
    photometer_head, ///< means over a small disc, not values at a point
    bounded,         ///< local estimation with a bounded kernel and its compensation
    bidirectional
};

/// What estimators are called: on the command line and in the project file.
struct EstimatorName {
    Estimator estimator;
    std::string_view on_command_line;
    std::string_view in_project;
};

inline constexpr std::array estimator_names{
    EstimatorName{Estimator::automatic, "auto", "automatic"},
    EstimatorName{Estimator::local_estimation, "local", "local-estimation"},
    EstimatorName{Estimator::local_estimation_mis, "mis", "local-estimation-mis"},
    EstimatorName{Estimator::path_tracing, "path-tracing", "path-tracing"},
    EstimatorName{Estimator::photometer_head, "head", "photometer-head"},
    EstimatorName{Estimator::bounded, "bounded", "bounded"},
    EstimatorName{Estimator::bidirectional, "bidirectional", "bidirectional"},
};

enum class Statement {
    per_point, ///< every interval holds at the stated confidence by itself
    all_points ///< all intervals of a surface hold at once (Bonferroni)
};

/// When a calculation ends, METHODS "Stopping".
enum class Stopping {
    doubling,  ///< look at the intervals after 1, 2, 4, ... times the work
    two_stages ///< a pilot fixes the work, which is done once
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
    /// m; what Estimator::photometer_head averages over
    double photometer_head_radius = 0.01;
    Statement statement = Statement::per_point;
    Stopping stopping = Stopping::doubling;
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

/// A maintenance factor and the parts it was given in; each part is 1 where none is given.
struct MaintenanceFactor {
    double value = 1.0;
    bool has_parts = false;
    double lamp_flux = 1.0;     ///< LLMF
    double lamp_survival = 1.0; ///< LSF
    double luminaire = 1.0;     ///< LMF
    double room_surface = 1.0;  ///< RSMF
};

/// One luminaire type of the project and how many of it hang.
struct ScheduleEntry {
    std::string type;
    std::string file; ///< as the project names it; empty without a file
    std::string manufacturer;
    std::string product;
    std::size_t count = 0;
    double flux = 0.0; ///< lm, initial, of one luminaire
    std::optional<double> watts;
    std::optional<double> colour_rendering; ///< Ra
    MaintenanceFactor maintenance;
};

/// A requirement and what it is asked of.
struct ProjectRequirement {
    Requirement requirement;
    std::string subject;                ///< surface, observers or room, by name
    std::optional<std::size_t> surface; ///< in Project::surfaces
    std::string reason;                 ///< why nothing can be judged; empty otherwise
    std::optional<std::size_t> observers = std::nullopt; ///< in Project::observers
};

/// A named state of the luminaires.
struct LightScene {
    std::string name;
    std::vector<double> factors; ///< by luminaire: its light over that of the project as it is
};

/// A room as energy sees it.
struct EnergyZone {
    std::string room;
    double floor_area = 0.0;                 ///< m2, without columns
    std::vector<std::size_t> luminaires;     ///< those that hang in it
    std::optional<std::size_t> work_surface; ///< horizontal, for W/(m2 100 lx)
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
    std::vector<ProjectRequirement> requirements;
    std::vector<ScheduleEntry> schedule; ///< as scene.luminaire_types
    std::vector<ObserverGroup> observers;
    std::vector<EnergyZone> energy_zones;
    std::optional<EnergyUse> energy_use; ///< absent: no LENI
    std::vector<LightScene> scenes;
    std::vector<double>
        glare_factors; ///< k2 of CIE 232, as scene.luminaire_types; 1 if unknown
    std::vector<View> views;
    Settings settings;
    std::vector<Message> notices;
};

} // namespace isolux
