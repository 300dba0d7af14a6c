#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include "isolux/measure/surface_grid.h"
#include "isolux/viz/vtk_export.h"

namespace isolux {
namespace {

/// What VTK's own reader makes of a file's text.
vtkSmartPointer<vtkPolyData> read_back(const std::string& xml) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->ReadFromInputStringOn();
    reader->SetInputString(xml);
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), 0u);
    return reader->GetOutput();
}

vtkDoubleArray& doubles(vtkPolyData& data, const char* name) {
    auto* array = vtkDoubleArray::SafeDownCast(data.GetCellData()->GetArray(name));
    EXPECT_NE(array, nullptr) << name;
    return *array;
}

PointResult make_point(double total) {
    PointResult p;
    p.total = {total, 0.01 * total, 16};
    p.direct = {0.75 * total, 0.0, 16};
    p.indirect = {0.25 * total, 0.01 * total, 16};
    return p;
}

/// An L: 3 x 2 cells of 0.5 m, the upper right one missing, turned about z, a kilometre away.
SurfaceResult make_l_shape() {
    GridLayout grid;
    grid.frame.origin = {1000.1, 2000.2, 0.75};
    grid.frame = rotate(grid.frame, UnitVector3(Vector3{0, 0, 1}), degrees(30));
    grid.width = 1.5;
    grid.height = 1.0;
    grid.counts = {3, 2};
    grid.cell_of_point = {0, 1, 2, 3, 4};
    SurfaceResult result;
    result.surface.name = "Büro <1> & \"desk\"";
    for (std::size_t p = 0; p < 5; ++p) {
        const double u = 0.25 + 0.5 * static_cast<double>(p % 3);
        const double v = 0.25 + 0.5 * static_cast<double>(p / 3);
        result.surface.receivers.push_back(
            {grid.frame.point_from_local({u, v, 0}), grid.frame.z});
        result.points.push_back(make_point(100.0 / 3.0 + static_cast<double>(p)));
    }
    result.surface.grid = grid;
    return result;
}

TEST(SurfaceVtp, GivesOneQuadForEveryMeasuredCell) {
    const SurfaceResult result = make_l_shape();
    const auto data = read_back(to_surface_vtp(result, 0.95));
    ASSERT_EQ(data->GetNumberOfPolys(), 5);
    EXPECT_EQ(data->GetNumberOfVerts(), 0);
    EXPECT_EQ(data->GetNumberOfPoints(), 11); // 4 x 3 corners less the one nobody uses
    for (vtkIdType c = 0; c < 5; ++c) {
        vtkNew<vtkIdList> corners;
        data->GetCellPoints(c, corners);
        ASSERT_EQ(corners->GetNumberOfIds(), 4);
        Vector3 sum;
        for (vtkIdType k = 0; k < 4; ++k) {
            const double* x = data->GetPoint(corners->GetId(k));
            sum = sum + 0.25 * Vector3{x[0], x[1], x[2]};
        }
        const Point3& centre = result.surface.receivers[static_cast<std::size_t>(c)].point;
        EXPECT_LT(distance(centre, {sum.x, sum.y, sum.z}), 1e-12 * 2000 * 4);
    }
}

TEST(SurfaceVtp, KeepsEveryBitOfTheValues) {
    const SurfaceResult result = make_l_shape();
    const auto data = read_back(to_surface_vtp(result, 0.9));
    for (std::size_t p = 0; p < 5; ++p) {
        const PointResult& point = result.points[p];
        const Interval interval = confidence_interval(point.total, 0.9);
        const auto c = static_cast<vtkIdType>(p);
        EXPECT_EQ(doubles(*data, "illuminance").GetValue(c), point.total.mean);
        EXPECT_EQ(doubles(*data, "standard_error").GetValue(c), point.total.standard_error);
        EXPECT_EQ(doubles(*data, "lower").GetValue(c), interval.lower);
        EXPECT_EQ(doubles(*data, "upper").GetValue(c), interval.upper);
        EXPECT_EQ(doubles(*data, "direct").GetValue(c), point.direct.mean);
        EXPECT_EQ(doubles(*data, "indirect").GetValue(c), point.indirect.mean);
        EXPECT_EQ(doubles(*data, "normal").GetComponent(c, 2), 1.0);
    }
    auto* name =
        vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("surface"));
    ASSERT_NE(name, nullptr);
    EXPECT_EQ(name->GetValue(0), result.surface.name);
    EXPECT_EQ(data->GetFieldData()->GetArray("confidence")->GetTuple1(0), 0.9);
}

TEST(SurfaceVtp, GivesSinglePointsAsVertices) {
    SurfaceResult result;
    result.surface.name = "points";
    result.surface.receivers = {{{1, 2, 3}, UnitVector3(Vector3{0, 0, 1})},
                                {{4, 5, 6.5}, UnitVector3(Vector3{1, 0, 0})}};
    result.points = {make_point(10), make_point(20)};
    const auto data = read_back(to_surface_vtp(result, 0.95));
    ASSERT_EQ(data->GetNumberOfVerts(), 2);
    EXPECT_EQ(data->GetNumberOfPolys(), 0);
    EXPECT_EQ(data->GetPoint(1)[2], 6.5);
    EXPECT_EQ(doubles(*data, "illuminance").GetValue(1), 20.0);
}

TEST(SurfaceVtp, IsNotCompressedAndEqualForEqualInput) {
    const std::string xml = to_surface_vtp(make_l_shape(), 0.95);
    EXPECT_EQ(xml.find("compressor"), std::string::npos);
    EXPECT_NE(xml.find("encoding=\"base64\""), std::string::npos);
    EXPECT_EQ(xml, to_surface_vtp(make_l_shape(), 0.95));
}

TEST(SurfaceVtp, WritesAFileAndLeavesNothingElse) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "isolux_surface_vtp";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    write_surface_vtp(folder / "desk.vtp", make_l_shape(), 0.95);
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder))
        ++files;
    EXPECT_EQ(files, 1u);
    std::ifstream in(folder / "desk.vtp", std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    EXPECT_EQ(text.str(), to_surface_vtp(make_l_shape(), 0.95));
}

} // namespace
} // namespace isolux
