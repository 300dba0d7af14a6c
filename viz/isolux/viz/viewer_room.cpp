#include <algorithm>
#include <array>
#include <cmath>

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkDataArray.h>
#include <vtkFeatureEdges.h>
#include <vtkIdTypeArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkThreshold.h>
#include <vtkXMLPolyDataReader.h>

#include "isolux/base/error.h"
#include "isolux/viz/viewer_parts.h"

namespace isolux {

namespace {

/// @param what  in words, for the message
vtkNew<vtkPolyData>
read_poly_data(const std::filesystem::path& file, const char* what, const char* array) {
    const std::string name = file.string();
    vtkNew<vtkXMLPolyDataReader> reader;
    vtkNew<vtkPolyData> data;
    if (std::filesystem::exists(file) && reader->CanReadFile(name.c_str()) != 0) {
        reader->SetFileName(name.c_str());
        reader->Update();
        data->ShallowCopy(reader->GetOutput());
    }
    if (data->GetCellData()->GetArray(array) == nullptr)
        throw InputError(name,
                         std::string("there are no ") + what + " in it",
                         "Calculate the project again with `isolux run`");
    return data;
}

/// The cells of `data` whose integer array has a value, as poly data of their own.
vtkNew<vtkPolyData> select_cells(vtkPolyData& data, const char* array, int value) {
    vtkNew<vtkPolyData> part;
    part->SetPoints(data.GetPoints());
    part->GetPointData()->ShallowCopy(data.GetPointData());
    vtkNew<vtkCellArray> polys;
    vtkDataArray* values = data.GetCellData()->GetArray(array);
    vtkNew<vtkIdList> corners;
    for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c) {
        if (static_cast<int>(values->GetComponent(c, 0)) != value)
            continue;
        data.GetCellPoints(c, corners);
        if (corners->GetNumberOfIds() >= 3)
            polys->InsertNextCell(corners);
    }
    part->SetPolys(polys);
    return part;
}

vtkActor* add_actor(vtkRenderer& renderer, vtkPolyData& data, const Colour& colour) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(&data);
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
    renderer.AddActor(actor);
    return actor;
}

vtkActor* add_edges(vtkRenderer& renderer, vtkPolyData& data) {
    vtkNew<vtkCleanPolyData> joined; // triangles do not share their corners in the file
    joined->SetInputData(&data);
    vtkNew<vtkFeatureEdges> edges;
    edges->SetInputConnection(joined->GetOutputPort());
    edges->ColoringOff();
    edges->SetFeatureAngle(20.0);
    edges->Update();
    vtkActor* actor = add_actor(renderer, *edges->GetOutput(), {70, 75, 85});
    actor->GetProperty()->LightingOff();
    actor->PickableOff();
    return actor;
}

void place(vtkActor& actor, const Frame& f, double scale) {
    const Vector3 x(f.x), y(f.y), z(f.z);
    vtkNew<vtkMatrix4x4> m;
    const std::array<double, 16> elements{scale * x.x,
                                          scale * y.x,
                                          scale * z.x,
                                          f.origin.x, //
                                          scale * x.y,
                                          scale * y.y,
                                          scale * z.y,
                                          f.origin.y, //
                                          scale * x.z,
                                          scale * y.z,
                                          scale * z.z,
                                          f.origin.z, //
                                          0.0,
                                          0.0,
                                          0.0,
                                          1.0};
    m->DeepCopy(elements.data());
    actor.SetUserMatrix(m);
}

/// A body to scale as a box; one without size becomes a small cube.
vtkNew<vtkPolyData> make_body(const LuminousOpening& body) {
    const auto half = [](Metre side) { return std::max(0.5 * in_metre(side), 0.015); };
    const double x = half(body.extent_x), y = half(body.extent_y), z = half(body.extent_z);
    vtkNew<vtkPoints> points;
    for (int k = 0; k < 8; ++k)
        points->InsertNextPoint(k & 1 ? x : -x, k & 2 ? y : -y, k & 4 ? z : -z);
    constexpr std::array<std::array<vtkIdType, 4>, 6> faces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    vtkNew<vtkCellArray> quads;
    for (const auto& face : faces)
        quads->InsertNextCell(4, face.data());
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(quads);
    return data;
}

double longest_side(const LuminousOpening& o) {
    return std::max({in_metre(o.extent_x), in_metre(o.extent_y), in_metre(o.extent_z)});
}

} // namespace

Props add_room(vtkRenderer& renderer, const std::filesystem::path& room_vtp) {
    const vtkNew<vtkPolyData> all = read_poly_data(room_vtp, "faces of a room", "kind");
    const vtkNew<vtkPolyData> faces = select_cells(*all, "kind", 0);
    vtkActor* walls = add_actor(renderer, *faces, {222, 222, 216});
    walls->GetProperty()->BackfaceCullingOn(); // look into the room from outside
    walls->GetProperty()->SetAmbient(0.55);
    walls->GetProperty()->SetDiffuse(0.45);
    // Calculation surfaces lie on walls: these step back.
    walls->GetMapper()->SetResolveCoincidentTopologyToPolygonOffset();
    walls->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 8.0);
    const vtkNew<vtkPolyData> openings = select_cells(*all, "kind", 1);
    vtkActor* lit = add_actor(renderer, *openings, {255, 240, 190});
    lit->GetProperty()->LightingOff();
    return {walls, add_edges(renderer, *faces), lit};
}

Props add_luminaires(vtkRenderer& renderer, const Plan& plan) {
    Props props;
    for (const PlanLuminaire& l : plan.luminaires) {
        const LuminousOpening& body = plan.types[l.type].body;
        vtkActor* box = add_actor(renderer, *make_body(body), {120, 130, 145});
        place(*box, l.frame, 1.0);
        vtkNew<vtkArrowSource> source; // from the origin along x: C0
        source->Update();
        vtkActor* arrow = add_actor(renderer, *source->GetOutput(), {190, 30, 30});
        place(*arrow, l.frame, std::max(0.4, 0.8 * longest_side(body)));
        props.push_back(box);
        props.push_back(arrow);
    }
    return props;
}

Props add_webs(vtkRenderer& renderer,
               const std::filesystem::path& webs_vtp,
               const Plan& plan,
               double reach) {
    const vtkNew<vtkPolyData> all = read_poly_data(webs_vtp, "photometric webs", "type");
    double brightest = 0.0;
    for (const PlanLuminaire& l : plan.luminaires)
        brightest = std::max(brightest, l.scale * plan.types[l.type].maximum);
    Props props;
    if (!(brightest > 0.0))
        return props;
    std::vector<vtkSmartPointer<vtkPolyData>> webs;
    for (std::size_t t = 0; t < plan.types.size(); ++t)
        webs.emplace_back(select_cells(*all, "type", static_cast<int>(t)).Get());
    for (const PlanLuminaire& l : plan.luminaires) {
        vtkActor* web = add_actor(renderer, *webs[l.type], {245, 200, 80});
        place(*web, l.frame, reach * l.scale * plan.types[l.type].maximum / brightest);
        web->GetProperty()->SetOpacity(0.35);
        web->GetProperty()->SetAmbient(0.4);
        web->PickableOff();
        props.push_back(web);
    }
    return props;
}

} // namespace isolux
