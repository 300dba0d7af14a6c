#pragma once

/// A room for the tests of the command: small, quick, with known oddities.
namespace isolux::test {

inline constexpr const char* office = R"({
  "isolux": 1,
  "name": "small office",
  "maintenance_factor": 0.8,
  "rooms": [{"name": "office", "size": [6, 4], "height": 3}],
  "luminaire_types": {
    "linear": {"lambertian": {"size": [1.2, 0.3], "flux": 4000}},
    "bulb": {"isotropic": {"flux": 500}}
  },
  "luminaires": [
    {"type": "linear", "field": {"rows": 2, "columns": 2}},
    {"type": "bulb", "position": [3, 2, 2]}
  ],
  "surfaces": [
    {"work_plane": {"height": 0.75, "edge": 0}, "grid": {"columns": 3, "rows": 2}},
    {"points": [[1, 1, 1, 0, 0, 1]], "name": "desk/1"}
  ]
})";

} // namespace isolux::test
