#include "isolux/cli/experiment_scenes.h"

#include <string_view>

#include "isolux/io/project_json.h"

namespace isolux {

namespace {

constexpr std::string_view box_head = R"({
  "isolux": 1, "name": "experiment", "maintenance_factor": 1,
  "materials": {"white": 0.73, "red": [0.63, 0.065, 0.05], "green": [0.14, 0.45, 0.091]},
  "rooms": [{
    "name": "box", "size": [0.5528, 0.5592], "height": 0.5488,
    "reflectances": {"floor": "white", "ceiling": "white", "walls": "white",
                     "wall 2": "green", "wall 4": "red"},
    "openings": [{"name": "front", "wall": 1, "offset": 0, "width": 0.5528,
                  "height": 0.5488, "state": "open"}]
  }],
  "objects": [
    {"name": "short block", "box": [0.165, 0.165, 0.165], "position": [0.3673, 0.1690, 0],
     "rotation": -17, "material": "white"},
    {"name": "tall block", "box": [0.165, 0.165, 0.330], "position": [0.1843, 0.3513, 0],
     "rotation": 17.3, "material": "white"}
  ],
  "luminaire_types": {"opening": {"lambertian": {"size": [0.130, 0.105], "flux": 100}}},
)";

constexpr std::string_view lit_from_above =
    R"("luminaires": [{"type": "opening", "position": [0.2748, 0.2795, 0.5478]}],)";

constexpr std::string_view lit_by_the_ceiling =
    R"("luminaires": [{"type": "opening", "position": [0.2748, 0.2795, 0.42],
                       "aim": [0.2748, 0.2795, 0.54]}],)";

constexpr std::string_view box_view =
    R"("position": [0.278, -0.8, 0.273], "target": [0.278, 0, 0.273], "field_of_view": 39.3077)";

/// The blocks from near by, without the luminaire: its edge out of focus is all noise that no
/// filter of surfaces removes.
constexpr std::string_view lens_view =
    R"("position": [0.278, -0.8, 0.273], "target": [0.33, 0, 0.12], "field_of_view": 22,
       "aperture": 40, "focus_distance": 0.95)";

constexpr std::string_view slats = R"({
  "isolux": 1, "name": "experiment", "maintenance_factor": 1,
  "rooms": [{"name": "room", "size": [4, 4], "height": 3}],
  "objects": [
    {"name": "low block", "box": [0.6, 0.6, 0.5], "position": [1.1, 1.3, 0], "rotation": 20},
    {"name": "high block", "box": [0.4, 0.4, 1.2], "position": [2.9, 2.6, 0], "rotation": -10},
    {"name": "slat 1", "box": [0.12, 1.6, 0.02], "position": [1.7, 2.0, 1.2]},
    {"name": "slat 2", "box": [0.12, 1.6, 0.02], "position": [2.0, 2.0, 1.2]},
    {"name": "slat 3", "box": [0.12, 1.6, 0.02], "position": [2.3, 2.0, 1.2]}
  ],
  "luminaire_types": {"square": {"lambertian": {"size": [0.8, 0.8], "flux": 4000}}},
  "luminaires": [{"type": "square", "position": [2, 2, 2.9]}],
  )";

constexpr std::string_view slats_view =
    R"("position": [2, 0.1, 2.4], "target": [2, 2.3, 0.4], "field_of_view": 75)";

std::string views_of(std::string_view camera, std::size_t side) {
    const std::string pixels = std::to_string(side);
    return std::string(R"("views": [{"name": "view", )") + std::string(camera)
           + R"(, "resolution": [)" + pixels + ", " + pixels + "]}]}";
}

} // namespace

Project make_experiment_project(const std::string& name, std::size_t side) {
    std::string text;
    if (name == "soft shadow") {
        text = std::string(slats) + views_of(slats_view, side);
    } else {
        const std::string camera(name == "lens" ? lens_view : box_view);
        text = std::string(box_head)
               + std::string(name == "indirect" ? lit_by_the_ceiling : lit_from_above)
               + views_of(camera, side);
    }
    return parse_project(text, name);
}

} // namespace isolux
