#pragma once

#include <utility>

#include "isolux/calc/plan.h"
#include "isolux/io/results_json.h"

#include "support/sample_results.h"

namespace isolux::report::examples {

/// A room with a linear luminaire that is turned, and a bulb.
inline Scene make_scene() {
    SceneDescription d;
    d.materials = {{"paint", Opaque{Rgb::grey(0.5), 0.0}, Sides::both}};
    Room room;
    room.name = "office <1>";
    room.footprint = {{0, 0}, {6, 0}, {6, 4}, {4, 4}, {4, 2.5}, {0, 2.5}};
    room.height = 2.8;
    room.walls.resize(6);
    d.rooms = {room};
    LuminaireType panel;
    panel.name = "panel & co";
    panel.source = LambertianSource{Lumen(4000.0 / 3.0)};
    panel.opening = {OpeningShape::rectangle, Metre(0.3), Metre(1.2), Metre(0)};
    LuminaireType bulb;
    bulb.name = "bulb";
    bulb.source = IsotropicSource{Lumen(800)};
    d.luminaire_types = {panel, bulb};
    LuminairePlacement a;
    a.name = "panel 1";
    a.world_from_luminaire =
        make_tilted_frame({3, 1, 2.7}, degrees(90), degrees(7), degrees(0));
    a.scale = 0.8;
    LuminairePlacement b;
    b.name = "bulb 1";
    b.type = LuminaireTypeId(1);
    b.world_from_luminaire.origin = {5, 3, 2.5};
    d.luminaires = {a, b};
    return build_scene(std::move(d));
}

inline ResultsDocument make_document() {
    Project project;
    project.name = "Büro \"4\" <draft>";
    project.description = "Two rooms & a corridor";
    project.file = {"office.json", std::string(64, 'a')};
    project.inputs = {{"a.ies", std::string(64, 'b')}, {"desk.obj", std::string(64, 'c')}};
    ResultsDocument document = make_results_document(project, {}, test::make_results());
    document.plan = make_plan(make_scene());
    const std::vector<std::string> aligned{"panel & co"};
    mark_aligned(document.plan, aligned);
    document.date = "2026-05-13T09:30:00Z";
    return document;
}

} // namespace isolux::report::examples
