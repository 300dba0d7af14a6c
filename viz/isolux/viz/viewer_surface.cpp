#include <algorithm>
#include <string>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include "isolux/viz/colour_scale.h"
#include "isolux/viz/contours.h"
#include "isolux/viz/map_text.h"
#include "isolux/viz/viewer_parts.h"

namespace isolux {

namespace {

vtkIdType add_point(vtkPoints& points, const Point3& p) {
    return points.InsertNextPoint(p.x, p.y, p.z);
}

/// Cell colours in the order of the cells.
class Colours {
public:
    Colours() {
        array_->SetNumberOfComponents(3);
        array_->SetName("colour");
    }

    void add(const Colour& c) {
        array_->InsertNextTypedTuple(std::array<unsigned char, 3>{c.r, c.g, c.b}.data());
    }

    void attach(vtkPolyData& to) { to.GetCellData()->SetScalars(array_); }

private:
    vtkNew<vtkUnsignedCharArray> array_;
};

CellField field_of(const SurfaceResult& result) {
    std::vector<double> values;
    for (const PointResult& p : result.points)
        values.push_back(p.total.mean);
    return make_cell_field(*result.surface.grid, values);
}

vtkNew<vtkPolyData> make_bands(const SurfaceResult& result, const MapScale& scale) {
    const Bands bands = cut_into_bands(field_of(result), scale.breaks);
    vtkNew<vtkPoints> points;
    for (const Point2& p : bands.points)
        add_point(*points, result.surface.grid->frame.point_from_local({p.x, p.y, 0.0}));
    vtkNew<vtkCellArray> polys;
    Colours colours;
    for (std::size_t k = 0; k < bands.polygons.size(); ++k) {
        const std::span<const std::uint32_t> corners = bands.corners_of(k);
        polys->InsertNextCell(static_cast<int>(corners.size()));
        for (const std::uint32_t corner : corners)
            polys->InsertCellPoint(corner);
        colours.add(scale.colours[bands.polygons[k].band]);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(polys);
    colours.attach(*data);
    return data;
}

vtkNew<vtkPolyData> make_dots(const SurfaceResult& result, const MapScale& scale) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> vertices;
    Colours colours;
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        const vtkIdType id = add_point(*points, result.surface.receivers[p].point);
        vertices->InsertNextCell(1, &id);
        colours.add(scale.colour_of(result.points[p].total.mean));
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetVerts(vertices);
    colours.attach(*data);
    return data;
}

vtkNew<vtkPolyData> make_isolux_lines(const SurfaceResult& result, const MapScale& scale) {
    constexpr double lift = 0.004; // m, off the colours
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> lines;
    for (const Contour& contour : make_contours(field_of(result), scale.breaks))
        for (const Polyline& line : contour.lines) {
            lines->InsertNextCell(static_cast<int>(line.size()));
            for (const Point2& p : line)
                lines->InsertCellPoint(add_point(
                    *points, result.surface.grid->frame.point_from_local({p.x, p.y, lift})));
        }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetLines(lines);
    return data;
}

vtkActor* add_unlit(vtkRenderer& renderer, vtkPolyData& data) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(&data);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff(); // the colours are the legend's
    renderer.AddActor(actor);
    return actor;
}

/// A box on the window, shares of its width and height.
vtkProp*
add_box(vtkRenderer& renderer, const Colour& fill, double x, double y, double w, double h) {
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(x, y, 0.0);
    points->InsertNextPoint(x + w, y, 0.0);
    points->InsertNextPoint(x + w, y + h, 0.0);
    points->InsertNextPoint(x, y + h, 0.0);
    vtkNew<vtkCellArray> quad;
    quad->InsertNextCell({0, 1, 2, 3});
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(quad);
    vtkNew<vtkCoordinate> shares;
    shares->SetCoordinateSystemToNormalizedViewport();
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(data);
    mapper->SetTransformCoordinate(shares);
    vtkNew<vtkActor2D> box;
    box->SetMapper(mapper);
    box->GetProperty()->SetColor(fill.r / 255.0, fill.g / 255.0, fill.b / 255.0);
    renderer.AddActor2D(box);
    return box;
}

vtkProp* add_words(vtkRenderer& renderer, const std::string& words, double x, double y) {
    vtkNew<vtkTextActor> text;
    text->SetInput(words.c_str());
    text->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
    text->GetTextProperty()->SetFontSize(15);
    text->GetTextProperty()->SetVerticalJustificationToCentered();
    text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    text->SetPosition(x, y);
    renderer.AddActor2D(text);
    return text;
}

} // namespace

SurfaceProps add_surface(vtkRenderer& renderer,
                         const SurfaceResult& result,
                         const MapScale& scale,
                         std::size_t layer) {
    SurfaceProps props;
    if (!result.surface.grid) {
        props.colours = add_unlit(renderer, *make_dots(result, scale));
        props.colours->GetProperty()->SetPointSize(11.0F);
        props.colours->GetProperty()->RenderPointsAsSpheresOn();
        return props;
    }
    props.colours = add_unlit(renderer, *make_bands(result, scale));
    props.colours->GetProperty()->BackfaceCullingOn();
    vtkMapper* mapper = props.colours->GetMapper();
    mapper->SetResolveCoincidentTopologyToPolygonOffset();
    mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(
        0.0, -2.0 * static_cast<double>(layer));
    props.lines = add_unlit(renderer, *make_isolux_lines(result, scale));
    props.lines->GetProperty()->SetColor(0.05, 0.05, 0.05);
    props.lines->PickableOff();
    return props;
}

MapScale make_common_scale(const Results& results) {
    double low = HUGE_VAL, high = 0.0, step = 0.0;
    for (const SurfaceResult& s : results.surfaces) {
        if (s.points.empty())
            continue;
        const ValueRange range = find_range(s.points);
        low = std::min(low, std::max(0.0, range.minimum));
        high = std::max(high, range.maximum);
        step = std::max(step, typical_half_width(s, results.confidence));
    }
    MapScale scale;
    if (high > low)
        scale.breaks = choose_breaks(low, high, step);
    scale.colours = band_colours(scale.breaks.size() + 1);
    return scale;
}

Props add_legend(vtkRenderer& renderer, const MapScale& scale) {
    constexpr double x = 0.925, width = 0.022, foot = 0.2, height = 0.6;
    Props props;
    const double box = height / static_cast<double>(scale.colours.size());
    for (std::size_t k = 0; k < scale.colours.size(); ++k)
        props.push_back(add_box(
            renderer, scale.colours[k], x, foot + box * static_cast<double>(k), width, box));
    for (std::size_t k = 0; k < scale.breaks.size(); ++k)
        props.push_back(add_words(renderer,
                                  format_break(scale.breaks[k]),
                                  x + width + 0.006,
                                  foot + box * static_cast<double>(k + 1)));
    props.push_back(add_words(renderer, "lx", x, foot + height + 0.03));
    return props;
}

} // namespace isolux
