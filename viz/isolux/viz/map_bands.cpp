#include "isolux/viz/map_bands.h"

#include <utility>

#include "isolux/base/check.h"
#include "isolux/viz/contours.h"
#include "isolux/viz/label_layout.h"

namespace isolux {

namespace {

constexpr double finest_detail = 0.015; // mm, a tenth of the thinnest line

const Stroke surface_line{ink::black, 0.25, 0.0};
const Stroke isolux_line{ink::black, 0.15, 0.0};

/// The surface's border on the page: its outline, else its cells.
std::vector<Polyline> make_border(const MapPage& page,
                                  const CalculationSurface& surface,
                                  const SurfaceView& view,
                                  const CellField& field) {
    std::vector<Polyline> loops;
    if (surface.outline.size() >= 3) {
        loops.emplace_back();
        for (const Point3& p : surface.outline)
            loops.back().push_back(page.to_page(view.project(p)));
    } else {
        loops = page.to_page(view.project(outline_of_cells(field), *surface.grid));
        for (Polyline& loop : loops)
            loop = simplify(loop, finest_detail);
    }
    return loops;
}

/// Cells that lie inside the outline at least in part.
std::vector<bool> cells_inside(const std::vector<Point3>& outline, const GridLayout& grid) {
    constexpr int samples = 5; // each way
    std::vector<Polyline> loop(1);
    for (const Point3& p : outline) {
        const Vector3 local = grid.frame.point_to_local(p);
        loop.front().push_back({local.x, local.y});
    }
    const double du = grid.width / static_cast<double>(grid.counts.columns);
    const double dv = grid.height / static_cast<double>(grid.counts.rows);
    std::vector<bool> inside;
    for (std::size_t row = 0; row < grid.counts.rows; ++row)
        for (std::size_t column = 0; column < grid.counts.columns; ++column) {
            bool found = false;
            for (int k = 0; k < samples * samples && !found; ++k)
                found = is_inside(
                    loop,
                    {du * (static_cast<double>(column) + (k % samples + 0.5) / samples),
                     dv * (static_cast<double>(row) + (k / samples + 0.5) / samples)});
            inside.push_back(found);
        }
    return inside;
}

std::vector<Polyline> on_paper(const MapPage& page,
                               const SurfaceView& view,
                               const std::vector<Polyline>& grid_lines,
                               const GridLayout& grid) {
    std::vector<Polyline> lines = page.to_page(view.project(grid_lines, grid));
    for (Polyline& line : lines)
        line = simplify(line, finest_detail);
    return lines;
}

Shape area(std::vector<Polyline> loops, const Colour& fill) {
    Shape s;
    s.lines = std::move(loops);
    s.fill = fill;
    return s;
}

Shape contour(std::vector<Polyline> lines, Ends ends, const Stroke& stroke) {
    Shape s;
    s.lines = std::move(lines);
    s.ends = ends;
    s.stroke = stroke;
    return s;
}

} // namespace

PaintedBands paint_bands(MapPage& page,
                         const SurfaceResult& result,
                         const SurfaceView& view,
                         const MapScale& scale) {
    ISOLUX_EXPECT(result.surface.grid.has_value());
    const GridLayout& grid = *result.surface.grid;
    std::vector<double> values;
    for (const PointResult& p : result.points)
        values.push_back(p.total.mean);
    CellField field = make_cell_field(grid, values);
    PaintedBands painted{make_border(page, result.surface, view, field), {}};
    if (result.surface.outline.size() >= 3)
        field = fill_cells(std::move(field), cells_inside(result.surface.outline, grid));

    page.open_clip(painted.border);
    page.add(area(painted.border, scale.colours.front()));
    const std::vector<Contour> contours = make_contours(field, scale.breaks);
    for (std::size_t k = 0; k < contours.size(); ++k) {
        page.add(area(on_paper(page, view, contours[k].region, grid), scale.colours[k + 1]));
        painted.lines.push_back(
            {contours[k].level, on_paper(page, view, contours[k].lines, grid)});
    }
    for (const IsoluxLine& isolux : painted.lines)
        page.add(contour(isolux.lines, Ends::open, isolux_line));
    page.close_clip();
    page.add(contour(painted.border, Ends::closed, surface_line));
    return painted;
}

} // namespace isolux
