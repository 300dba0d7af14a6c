#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include "isolux/io/safe_file.h"
#include "isolux/viz/photometric_web.h"
#include "isolux/viz/web_export.h"

#include "support/temporary_folder.h"

namespace isolux {
namespace {

constexpr double pi = 3.14159265358979323846;

/// A panel of 1000 lm (1000/pi cd downwards) and a bulb of 4 pi x 100 lm (100 cd everywhere).
Scene make_scene() {
    const std::array<Point3, 3> corners{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    const std::array<CasterTriangle, 1> shapes{{{corners}}};
    Scene scene{{}, {}, {}, {}, {}, {}, 1.0, RayCaster(shapes), {}};
    scene.luminaire_types = {
        {"panel", "", LambertianSource{Lumen(1000)}, {}, BodyModel::none, 1.0, {}},
        {"bulb", "", IsotropicSource{Lumen(400 * pi)}, {}, BodyModel::none, 1.0, {}}};
    return scene;
}

vtkSmartPointer<vtkPolyData> read_back(const std::string& xml) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->ReadFromInputStringOn();
    reader->SetInputString(xml);
    reader->Update();
    return reader->GetOutput();
}

double radius(vtkPolyData& data, vtkIdType point) {
    double p[3];
    data.GetPoint(point, p);
    return std::hypot(p[0], p[1], p[2]);
}

TEST(WebsVtp, HoldTheMeshOfEveryType) {
    const Scene scene = make_scene();
    const auto data = read_back(to_webs_vtp(scene));
    std::size_t points = 0;
    std::size_t quads = 0;
    for (const LuminaireType& type : scene.luminaire_types) {
        const WebMesh mesh = make_web_mesh(type);
        points += mesh.points.size();
        quads += mesh.sectors * (mesh.rings - 1);
    }
    EXPECT_EQ(data->GetNumberOfPoints(), static_cast<vtkIdType>(points));
    EXPECT_EQ(data->GetNumberOfPolys(), static_cast<vtkIdType>(quads));
    ASSERT_NE(vtkDoubleArray::SafeDownCast(data->GetPointData()->GetArray("intensity")),
              nullptr);
    ASSERT_NE(vtkIntArray::SafeDownCast(data->GetCellData()->GetArray("type")), nullptr);
}

TEST(WebsVtp, PutEveryPointAsFarAsItsIntensityIsOfTheTypesLargest) {
    const Scene scene = make_scene();
    const auto data = read_back(to_webs_vtp(scene));
    vtkDataArray& candela = *data->GetPointData()->GetArray("intensity");
    const auto first_of_bulb =
        static_cast<vtkIdType>(make_web_mesh(scene.luminaire_types[0]).points.size());
    double largest = 0.0;
    for (vtkIdType k = 0; k < first_of_bulb; ++k) {
        EXPECT_NEAR(radius(*data, k), candela.GetTuple1(k) * pi / 1000.0, 1e-6);
        largest = std::max(largest, candela.GetTuple1(k));
    }
    EXPECT_NEAR(largest, 1000.0 / pi, 1e-6);
    for (vtkIdType k = first_of_bulb; k < data->GetNumberOfPoints(); ++k) {
        EXPECT_NEAR(radius(*data, k), 1.0, 1e-6);
        EXPECT_NEAR(candela.GetTuple1(k), 100.0, 1e-9);
    }
}

TEST(WebsVtp, PointTheNadirDown) {
    const auto data = read_back(to_webs_vtp(make_scene()));
    double nadir[3];
    data->GetPoint(0, nadir); // rings begin there
    EXPECT_NEAR(nadir[0], 0.0, 1e-9);
    EXPECT_NEAR(nadir[1], 0.0, 1e-9);
    EXPECT_NEAR(nadir[2], -1.0, 1e-6);
}

TEST(WebsVtp, NumberTheTypesAndJoinOnlyPointsOfOne) {
    const Scene scene = make_scene();
    const auto data = read_back(to_webs_vtp(scene));
    vtkDataArray& type = *data->GetCellData()->GetArray("type");
    const auto first_of_bulb =
        static_cast<vtkIdType>(make_web_mesh(scene.luminaire_types[0]).points.size());
    ASSERT_GT(data->GetNumberOfCells(), 0);
    for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
        vtkNew<vtkIdList> corners;
        data->GetCellPoints(c, corners);
        ASSERT_EQ(corners->GetNumberOfIds(), 4);
        for (vtkIdType k = 0; k < 4; ++k)
            EXPECT_EQ(corners->GetId(k) < first_of_bulb ? 0 : 1, type.GetTuple1(c));
    }
    EXPECT_EQ(type.GetTuple1(0), 0);
    EXPECT_EQ(type.GetTuple1(data->GetNumberOfCells() - 1), 1);
}

TEST(WebsVtp, CloseTheSolidAroundTheAxis) {
    Scene scene = make_scene();
    scene.luminaire_types.erase(scene.luminaire_types.begin());
    const auto data = read_back(to_webs_vtp(scene));
    const WebMesh mesh = make_web_mesh(scene.luminaire_types[0]);
    vtkNew<vtkIdList> last;
    data->GetCellPoints(static_cast<vtkIdType>(mesh.sectors) - 1, last);
    EXPECT_EQ(last->GetId(0), static_cast<vtkIdType>(mesh.sectors) - 1);
    EXPECT_EQ(last->GetId(1), 0); // back at C0
    EXPECT_EQ(last->GetId(2), static_cast<vtkIdType>(mesh.sectors));
}

TEST(WebsVtp, AreEmptyWithoutTypes) {
    Scene scene = make_scene();
    scene.luminaire_types.clear();
    EXPECT_EQ(read_back(to_webs_vtp(scene))->GetNumberOfPoints(), 0);
}

TEST(WebsVtp, AreWrittenAsOneFile) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / (std::string(webs_stem) + ".vtp");
    write_webs_vtp(path, make_scene());
    EXPECT_EQ(test::read_bytes(path), to_webs_vtp(make_scene()));
    EXPECT_THROW(write_webs_vtp(folder.path() / "none" / "webs.vtp", make_scene()), WriteError);
}

} // namespace
} // namespace isolux
