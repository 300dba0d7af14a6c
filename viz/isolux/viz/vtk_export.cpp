#include "isolux/viz/vtk_export.h"

#include <array>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <variant>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "isolux/base/check.h"
#include "isolux/io/safe_file.h"

namespace isolux {

namespace {

std::string to_xml(vtkPolyData& data) {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(&data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOn();
    writer->SetCompressorTypeToNone();
    writer->SetHeaderTypeToUInt64();
    writer->WriteToOutputStringOn();
    if (writer->Write() != 1)
        throw std::runtime_error("VTK could not write poly data");
    return writer->GetOutputString();
}

/// A named cell array of doubles, filled cell by cell.
class DoubleColumn {
public:
    DoubleColumn(const char* name, int components = 1) {
        array_->SetName(name);
        array_->SetNumberOfComponents(components);
    }

    void add(double value) { array_->InsertNextValue(value); }

    void add(const Vector3& v) { array_->InsertNextTuple3(v.x, v.y, v.z); }

    void attach(vtkFieldData& to) { to.AddArray(array_); }

private:
    vtkNew<vtkDoubleArray> array_;
};

class StringColumn {
public:
    explicit StringColumn(const char* name) { array_->SetName(name); }

    void add(const std::string& value) { array_->InsertNextValue(value); }

    void attach(vtkFieldData& to) { to.AddArray(array_); }

private:
    vtkNew<vtkStringArray> array_;
};

class IntColumn {
public:
    explicit IntColumn(const char* name) { array_->SetName(name); }

    void add(int value) { array_->InsertNextValue(value); }

    void attach(vtkFieldData& to) { to.AddArray(array_); }

private:
    vtkNew<vtkIntArray> array_;
};

vtkIdType add_point(vtkPoints& points, const Point3& p) {
    return points.InsertNextPoint(p.x, p.y, p.z);
}

/// Quads of the measured cells; neighbours share their corners.
void add_grid_cells(vtkPolyData& data, const GridLayout& grid) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> quads;
    std::unordered_map<std::size_t, vtkIdType> id_of_corner;
    const std::size_t columns = grid.counts.columns;
    const auto corner = [&](std::size_t i, std::size_t j) {
        const auto [at, is_new] = id_of_corner.try_emplace(j * (columns + 1) + i);
        if (is_new) {
            const double u = grid.width * static_cast<double>(i) / static_cast<double>(columns);
            const double v =
                grid.height * static_cast<double>(j) / static_cast<double>(grid.counts.rows);
            at->second = add_point(*points, grid.frame.point_from_local({u, v, 0.0}));
        }
        return at->second;
    };
    for (const std::size_t cell : grid.cell_of_point) {
        const std::size_t i = cell % columns;
        const std::size_t j = cell / columns;
        const std::array<vtkIdType, 4> quad{
            corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
        quads->InsertNextCell(4, quad.data());
    }
    data.SetPoints(points);
    data.SetPolys(quads);
}

void add_single_points(vtkPolyData& data, const std::vector<Receiver>& receivers) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    for (const Receiver& r : receivers) {
        const vtkIdType id = add_point(*points, r.point);
        vertices->InsertNextCell(1, &id);
    }
    data.SetPoints(points);
    data.SetVerts(vertices);
}

void add_description(vtkPolyData& data, const std::string& name, double confidence) {
    StringColumn surface("surface");
    surface.add(name);
    surface.attach(*data.GetFieldData());
    StringColumn unit("unit");
    unit.add("lx");
    unit.attach(*data.GetFieldData());
    DoubleColumn level("confidence");
    level.add(confidence);
    level.attach(*data.GetFieldData());
}

/// What room.vtp knows of every cell.
struct RoomColumns {
    IntColumn kind{"kind"};
    IntColumn material_id{"material_id"};
    StringColumn material{"material"};
    StringColumn surface{"surface"};
    DoubleColumn reflectance{"reflectance", 3};
    DoubleColumn mirror{"mirror_reflectance"};
    DoubleColumn transmittance{"transmittance"};

    void add_triangle(const Scene& scene, const SceneTriangle& t) {
        const Material& m = scene.material(t.material);
        kind.add(0);
        material_id.add(static_cast<int>(t.material.index()));
        material.add(m.name);
        surface.add(scene.surfaces[t.surface.index()].name);
        if (const auto* opaque = std::get_if<Opaque>(&m.scattering)) {
            reflectance.add(Vector3{opaque->diffuse.r, opaque->diffuse.g, opaque->diffuse.b});
            mirror.add(opaque->mirror);
            transmittance.add(0.0);
        } else {
            const SlabOptics slab = evaluate_slab(std::get<ClearPane>(m.scattering), 1.0);
            reflectance.add(Vector3{});
            mirror.add(slab.reflectance);
            transmittance.add(slab.transmittance);
        }
    }

    void add_luminaire(const Scene& scene, const Luminaire& luminaire) {
        kind.add(1);
        material_id.add(-1);
        material.add(scene.type_of(luminaire).name);
        surface.add(luminaire.placement.name);
        reflectance.add(Vector3{});
        mirror.add(0.0);
        transmittance.add(0.0);
    }

    void attach(vtkFieldData& to) {
        kind.attach(to);
        material_id.attach(to);
        material.attach(to);
        surface.attach(to);
        reflectance.attach(to);
        mirror.attach(to);
        transmittance.attach(to);
    }
};

} // namespace

std::string to_surface_vtp(const SurfaceResult& result, double confidence) {
    ISOLUX_EXPECT(result.points.size() == result.surface.receivers.size());
    vtkNew<vtkPolyData> data;
    if (result.surface.grid)
        add_grid_cells(*data, *result.surface.grid);
    else
        add_single_points(*data, result.surface.receivers);

    DoubleColumn illuminance("illuminance"), error("standard_error"), lower("lower"),
        upper("upper"), direct("direct"), indirect("indirect"), normal("normal", 3);
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        const PointResult& point = result.points[p];
        const Interval interval = confidence_interval(point.total, confidence);
        illuminance.add(point.total.mean);
        error.add(point.total.standard_error);
        lower.add(interval.lower);
        upper.add(interval.upper);
        direct.add(point.direct.mean);
        indirect.add(point.indirect.mean);
        normal.add(result.surface.receivers[p].axis);
    }
    for (DoubleColumn* c : {&illuminance, &error, &lower, &upper, &direct, &indirect, &normal})
        c->attach(*data->GetCellData());
    data->GetCellData()->SetActiveScalars("illuminance");
    add_description(*data, result.surface.name, confidence);
    return to_xml(*data);
}

std::string to_room_vtp(const Scene& scene) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    vtkNew<vtkCellArray> polys;
    RoomColumns columns;
    // VTK numbers the cells of poly data vertices first.
    for (const Luminaire& luminaire : scene.luminaires)
        if (luminaire.opening.form == OpeningForm::point) {
            const Point3& place = luminaire.placement.world_from_luminaire.origin;
            const vtkIdType id = add_point(*points, place);
            vertices->InsertNextCell(1, &id);
            columns.add_luminaire(scene, luminaire);
        }
    for (const SceneTriangle& t : scene.triangles) {
        polys->InsertNextCell(3);
        for (const Point3& corner : t.corner)
            polys->InsertCellPoint(add_point(*points, corner));
        columns.add_triangle(scene, t);
    }
    for (const Luminaire& luminaire : scene.luminaires)
        for (const Facet& facet : luminaire.opening.facets) {
            polys->InsertNextCell(static_cast<int>(facet.vertices.size()));
            for (const Point3& corner : facet.vertices)
                polys->InsertCellPoint(add_point(*points, corner));
            columns.add_luminaire(scene, luminaire);
        }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetVerts(vertices);
    data->SetPolys(polys);
    columns.attach(*data->GetCellData());
    return to_xml(*data);
}

void write_surface_vtp(const std::filesystem::path& path,
                       const SurfaceResult& result,
                       double confidence) {
    write_file_safely(path, to_surface_vtp(result, confidence));
}

void write_room_vtp(const std::filesystem::path& path, const Scene& scene) {
    write_file_safely(path, to_room_vtp(scene));
}

} // namespace isolux
