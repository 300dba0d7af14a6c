#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include "isolux/viz/vtk_export.h"

namespace isolux {
namespace {

/// Two triangles (paint and glass), a square opening and a point luminaire.
Scene make_scene() {
    const std::array<Point3, 3> low{{{1000.1, 0, 0}, {1001.1, 0, 0}, {1000.1, 1, 0}}};
    const std::array<Point3, 3> high{{{1000.1, 0, 1}, {1001.1, 0, 1}, {1000.1, 1, 1}}};
    const std::vector<CasterTriangle> shapes{{low}, {high, true}};
    Scene scene{{{"white \"paint\"", Opaque{{0.8, 0.7, 0.6}, 0.1}},
                 {"glass", ClearPane{1.52, 0.98}},
                 {"black", Opaque{}}},
                {{"office/floor", 0, 1, 0.5, true}, {"screen", 1, 1, 0.5, false}},
                {},
                {},
                {},
                {},
                1.0,
                RayCaster(shapes),
                {}};
    const UnitVector3 up(Vector3{0, 0, 1});
    scene.triangles = {{low, up, 0.5, MaterialId(0), SurfaceId(0)},
                       {high, up, 0.5, MaterialId(1), SurfaceId(1)}};
    scene.luminaire_types = {
        {"panel", "", LambertianSource{Lumen(1000)}, {}, BodyModel::none, 1.0, {}},
        {"bulb", "", IsotropicSource{Lumen(500)}, {}, BodyModel::none, 1.0, {}}};
    Luminaire panel;
    panel.placement.name = "panel 1";
    panel.opening.form = OpeningForm::flat;
    panel.opening.facets = {{{{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}}, -up, 1.0}};
    Luminaire bulb;
    bulb.placement.name = "bulb 1";
    bulb.placement.type = LuminaireTypeId(1);
    bulb.placement.world_from_luminaire.origin = {3, 4, 5};
    scene.luminaires = {panel, bulb};
    return scene;
}

vtkSmartPointer<vtkPolyData> read_back(const std::string& xml) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->ReadFromInputStringOn();
    reader->SetInputString(xml);
    reader->Update();
    return reader->GetOutput();
}

std::string name_of(vtkPolyData& data, const char* array, vtkIdType cell) {
    auto* names = vtkStringArray::SafeDownCast(data.GetCellData()->GetAbstractArray(array));
    return names == nullptr ? "array missing" : std::string(names->GetValue(cell));
}

TEST(RoomVtp, HoldsTheLuminaireVerticesThenTrianglesThenOpenings) {
    const auto data = read_back(to_room_vtp(make_scene()));
    ASSERT_EQ(data->GetNumberOfVerts(), 1);
    ASSERT_EQ(data->GetNumberOfPolys(), 3);
    EXPECT_EQ(name_of(*data, "surface", 0), "bulb 1");
    EXPECT_EQ(name_of(*data, "surface", 1), "office/floor");
    EXPECT_EQ(name_of(*data, "surface", 2), "screen");
    EXPECT_EQ(name_of(*data, "surface", 3), "panel 1");
    EXPECT_EQ(name_of(*data, "material", 0), "bulb");
    EXPECT_EQ(name_of(*data, "material", 1), "white \"paint\"");
    EXPECT_EQ(data->GetCell(3)->GetNumberOfPoints(), 4);
    double corner[3];
    data->GetCell(1)->GetPoints()->GetPoint(0, corner);
    EXPECT_EQ(corner[0], 1000.1);
}

TEST(RoomVtp, GivesMaterialsAsNumbers) {
    const auto data = read_back(to_room_vtp(make_scene()));
    vtkCellData& cells = *data->GetCellData();
    EXPECT_EQ(cells.GetArray("kind")->GetTuple1(0), 1);
    EXPECT_EQ(cells.GetArray("kind")->GetTuple1(1), 0);
    EXPECT_EQ(cells.GetArray("material_id")->GetTuple1(0), -1);
    EXPECT_EQ(cells.GetArray("material_id")->GetTuple1(2), 1);
    EXPECT_EQ(cells.GetArray("reflectance")->GetComponent(1, 1), 0.7);
    EXPECT_EQ(cells.GetArray("mirror_reflectance")->GetTuple1(1), 0.1);
    const SlabOptics glass = evaluate_slab({1.52, 0.98}, 1.0);
    EXPECT_EQ(cells.GetArray("transmittance")->GetTuple1(2), glass.transmittance);
    EXPECT_EQ(cells.GetArray("mirror_reflectance")->GetTuple1(2), glass.reflectance);
}

} // namespace
} // namespace isolux
