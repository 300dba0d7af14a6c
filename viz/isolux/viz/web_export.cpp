#include "isolux/viz/web_export.h"

#include <array>
#include <stdexcept>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "isolux/io/safe_file.h"
#include "isolux/viz/photometric_web.h"

namespace isolux {

namespace {

/// The quads of one type, appended to the arrays of all.
class WebCells {
public:
    void add(const LuminaireType& type, int number) {
        const WebMesh mesh = make_web_mesh(type);
        const vtkIdType first = points_->GetNumberOfPoints();
        for (std::size_t k = 0; k < mesh.points.size(); ++k) {
            points_->InsertNextPoint(mesh.points[k].x, mesh.points[k].y, mesh.points[k].z);
            intensity_->InsertNextValue(mesh.candela[k]);
        }
        for (std::size_t g = 0; g + 1 < mesh.rings; ++g)
            for (std::size_t s = 0; s < mesh.sectors; ++s) {
                const std::size_t next = (s + 1) % mesh.sectors;
                std::array<vtkIdType, 4> quad{};
                const std::array<std::size_t, 4> corners{g * mesh.sectors + s,
                                                         g * mesh.sectors + next,
                                                         (g + 1) * mesh.sectors + next,
                                                         (g + 1) * mesh.sectors + s};
                for (std::size_t k = 0; k < 4; ++k)
                    quad[k] = first + static_cast<vtkIdType>(corners[k]);
                quads_->InsertNextCell(4, quad.data());
                type_->InsertNextValue(number);
            }
    }

    [[nodiscard]] vtkNew<vtkPolyData> finish() {
        vtkNew<vtkPolyData> data;
        intensity_->SetName("intensity");
        type_->SetName("type");
        data->SetPoints(points_);
        data->SetPolys(quads_);
        data->GetPointData()->SetScalars(intensity_);
        data->GetCellData()->AddArray(type_);
        return data;
    }

private:
    vtkNew<vtkPoints> points_;
    vtkNew<vtkCellArray> quads_;
    vtkNew<vtkDoubleArray> intensity_;
    vtkNew<vtkIntArray> type_;
};

} // namespace

std::string to_webs_vtp(const Scene& scene) {
    WebCells cells;
    for (std::size_t t = 0; t < scene.luminaire_types.size(); ++t)
        cells.add(scene.luminaire_types[t], static_cast<int>(t));
    const vtkNew<vtkPolyData> data = cells.finish();
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOn();
    writer->SetCompressorTypeToNone();
    writer->WriteToOutputStringOn();
    if (writer->Write() != 1)
        throw std::runtime_error("VTK could not write poly data");
    return writer->GetOutputString();
}

void write_webs_vtp(const std::filesystem::path& path, const Scene& scene) {
    write_file_safely(path, to_webs_vtp(scene));
}

} // namespace isolux
