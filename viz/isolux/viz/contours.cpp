#include "isolux/viz/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include <vtkBandedPolyDataContourFilter.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "isolux/viz/smooth_field.h"

namespace isolux {

namespace {

/// Intervals to a cell: fine enough that curves look round, coarse enough that large grids stay
/// quick.
std::size_t choose_steps(const CellField& field) {
    constexpr double triangles_wanted = 40000.0;
    constexpr double triangles_per_cell = 8.0;
    const double cells = static_cast<double>(field.counts.columns * field.counts.rows);
    const double halves = std::sqrt(triangles_wanted / (triangles_per_cell * cells));
    return 2 * static_cast<std::size_t>(std::clamp(halves, 1.0, 16.0));
}

/// The nodes that smooth_to_lattice finds values for, row by row.
struct Lattice {
    explicit Lattice(const CellField& field)
        : steps(choose_steps(field)), columns(field.counts.columns * steps + 1),
          rows(field.counts.rows * steps + 1), width(field.width), height(field.height) {}

    [[nodiscard]] Point2 place_of(std::size_t node) const noexcept {
        const double u = static_cast<double>(node % columns) / static_cast<double>(columns - 1);
        const double v = static_cast<double>(node / columns) / static_cast<double>(rows - 1);
        return {width * u, height * v};
    }

    std::size_t steps;
    std::size_t columns;
    std::size_t rows;
    double width;
    double height;
};

void fill_cell(vtkCellArray& triangles,
               std::size_t column,
               std::size_t row,
               std::size_t steps,
               std::size_t nodes_u,
               const std::vector<vtkIdType>& ids) {
    for (std::size_t b = 0; b < steps; ++b)
        for (std::size_t a = 0; a < steps; ++a) {
            const std::size_t n = (row * steps + b) * nodes_u + column * steps + a;
            const std::array<vtkIdType, 4> q{
                ids[n], ids[n + 1], ids[n + nodes_u + 1], ids[n + nodes_u]};
            // Diagonals point to the cell's centre: a mirrored field has mirrored contours.
            const std::size_t k = (2 * a < steps) == (2 * b < steps) ? 0 : 1;
            for (const auto& t : {std::array{q[k], q[k + 1], q[k + 2]},
                                  std::array{q[k], q[k + 2], q[(k + 3) % 4]}})
                triangles.InsertNextCell(3, t.data());
        }
}

vtkNew<vtkPolyData> make_triangles(const CellField& field) {
    const Lattice lattice(field);
    const std::size_t steps = lattice.steps;
    const ValueTable nodes =
        smooth_to_lattice({field.counts.columns, field.counts.rows, field.values}, steps);
    const auto most_points = static_cast<vtkIdType>(nodes.values.size());
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->Allocate(most_points);
    vtkNew<vtkDoubleArray> values;
    values->Allocate(most_points);
    std::vector<vtkIdType> ids(nodes.values.size(), -1);
    for (std::size_t n = 0; n < nodes.values.size(); ++n) {
        if (std::isnan(nodes.values[n]))
            continue;
        const Point2 place = lattice.place_of(n);
        ids[n] = points->InsertNextPoint(place.x, place.y, 0.0);
        values->InsertNextValue(nodes.values[n]);
    }
    const auto most_triangles = static_cast<vtkIdType>(2 * steps * steps * field.values.size());
    vtkNew<vtkCellArray> triangles;
    triangles->AllocateExact(most_triangles, 3 * most_triangles);
    for (std::size_t row = 0; row < field.counts.rows; ++row)
        for (std::size_t column = 0; column < field.counts.columns; ++column)
            if (!std::isnan(field.values[row * field.counts.columns + column]))
                fill_cell(*triangles, column, row, steps, lattice.columns, ids);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(triangles);
    data->GetPointData()->SetScalars(values);
    return data;
}

vtkSmartPointer<vtkPolyData> cut_triangles(const CellField& field,
                                           std::span<const double> levels) {
    vtkNew<vtkPolyData> triangles = make_triangles(field);
    if (levels.empty() || triangles->GetNumberOfPolys() == 0)
        return triangles;
    vtkNew<vtkBandedPolyDataContourFilter> filter;
    filter->SetInputData(triangles);
    filter->SetNumberOfContours(static_cast<int>(levels.size()));
    for (std::size_t k = 0; k < levels.size(); ++k)
        filter->SetValue(static_cast<int>(k), levels[k]);
    filter->SetScalarModeToValue();
    filter->SetClipTolerance(1e-12);
    filter->Update();
    return filter->GetOutput();
}

} // namespace

Bands cut_into_bands(const CellField& field, std::span<const double> levels) {
    const vtkSmartPointer<vtkPolyData> cut = cut_triangles(field, levels);
    Bands bands;
    bands.points.reserve(static_cast<std::size_t>(cut->GetNumberOfPoints()));
    bands.corners.reserve(
        static_cast<std::size_t>(cut->GetPolys()->GetNumberOfConnectivityIds()));
    bands.polygons.reserve(static_cast<std::size_t>(cut->GetNumberOfPolys()));
    for (vtkIdType p = 0; p < cut->GetNumberOfPoints(); ++p) {
        const double* x = cut->GetPoint(p);
        bands.points.push_back({x[0], x[1]});
    }
    vtkDataArray* values = cut->GetPointData()->GetScalars();
    vtkNew<vtkIdList> corners;
    cut->GetPolys()->InitTraversal();
    while (cut->GetPolys()->GetNextCell(corners) != 0) {
        double sum = 0.0;
        for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k) {
            bands.corners.push_back(static_cast<std::uint32_t>(corners->GetId(k)));
            sum += values->GetTuple1(corners->GetId(k));
        }
        const double mean = sum / static_cast<double>(corners->GetNumberOfIds());
        const auto above = std::upper_bound(levels.begin(), levels.end(), mean);
        bands.polygons.push_back({static_cast<std::uint32_t>(bands.corners.size()),
                                  static_cast<std::uint32_t>(above - levels.begin())});
    }
    return bands;
}

namespace {

/// A border between bands, or between a band and the outside.
struct BorderEdge {
    std::size_t from = 0;
    std::size_t to = 0;
    std::optional<std::size_t> left;  ///< band on the left of from -> to
    std::optional<std::size_t> right; ///< on the right
};

/// A side of a polygon, seen from the lower of its two points.
struct Side {
    std::uint32_t high;
    std::uint32_t band : 31;
    std::uint32_t ascends : 1; ///< the polygon lies on the left of low -> high

    friend bool operator<(const Side& x, const Side& y) noexcept {
        return std::tuple(x.high, +x.ascends, +x.band)
               < std::tuple(y.high, +y.ascends, +y.band);
    }
};

/// The sides of all polygons by their lower points: there are millions, but few at a point.
struct Sides {
    std::vector<std::size_t> begin; ///< by point, and the end of all
    std::vector<Side> sides;
};

/// Calls `visit` with the two ends of every side, counter-clockwise, and its band.
template <class Visit> void visit_sides(const Bands& bands, const Visit& visit) {
    for (std::size_t c = 0; c < bands.polygons.size(); ++c) {
        const std::span<const std::uint32_t> polygon = bands.corners_of(c);
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const std::uint32_t a = polygon[k];
            const std::uint32_t b = polygon[(k + 1) % polygon.size()];
            if (a != b)
                visit(a, b, bands.polygons[c].band);
        }
    }
}

Sides sort_sides(const Bands& bands) {
    Sides s;
    s.begin.assign(bands.points.size() + 1, 0);
    visit_sides(bands, [&](std::uint32_t a, std::uint32_t b, std::uint32_t) {
        ++s.begin[std::min(a, b)];
    });
    std::size_t sum = 0;
    for (std::size_t& b : s.begin)
        b = sum += b;
    s.sides.resize(sum);
    // Filled from behind, what was the end of a point's sides becomes their begin.
    visit_sides(bands, [&](std::uint32_t a, std::uint32_t b, std::uint32_t band) {
        s.sides[--s.begin[std::min(a, b)]] = {std::max(a, b), band, a < b ? 1U : 0U};
    });
    return s;
}

std::vector<BorderEdge> find_borders(const Bands& bands) {
    Sides s = sort_sides(bands);
    std::vector<BorderEdge> borders;
    for (std::size_t low = 0; low + 1 < s.begin.size(); ++low) {
        const std::span sides =
            std::span(s.sides).subspan(s.begin[low], s.begin[low + 1] - s.begin[low]);
        std::sort(sides.begin(), sides.end());
        for (std::size_t k = 0; k < sides.size();) {
            BorderEdge e{low, sides[k].high, {}, {}};
            for (; k < sides.size() && sides[k].high == e.to; ++k)
                (sides[k].ascends != 0 ? e.left : e.right) = sides[k].band;
            if (e.left != e.right)
                borders.push_back(e);
        }
    }
    return borders;
}

struct DirectedEdge {
    std::size_t from = 0;
    std::size_t to = 0;
};

/// Joins edges end to end: open chains from where they begin, then rings.
/// @param place_of  Point2 of a point's number
template <class PlaceOf>
std::vector<Polyline> chain(const std::vector<DirectedEdge>& edges, const PlaceOf& place_of) {
    std::multimap<std::size_t, std::size_t> leaving;
    std::map<std::size_t, int> balance;
    for (const DirectedEdge& e : edges) {
        leaving.emplace(e.from, e.to);
        ++balance[e.from];
        --balance[e.to];
    }
    std::vector<Polyline> lines;
    const auto follow = [&](std::size_t start) {
        Polyline line{place_of(start)};
        std::size_t at = start;
        for (auto next = leaving.find(at); next != leaving.end(); next = leaving.find(at)) {
            at = next->second;
            leaving.erase(next);
            line.push_back(place_of(at));
            if (at == start)
                break;
        }
        lines.push_back(std::move(line));
    };
    for (auto& [vertex, surplus] : balance)
        for (; surplus > 0; --surplus)
            follow(vertex);
    while (!leaving.empty())
        follow(leaving.begin()->first);
    return lines;
}

/// Edges around the places whose band is at least `lowest`, those places on the left.
std::vector<DirectedEdge>
edges_around(const std::vector<BorderEdge>& borders, std::size_t lowest, bool inner_only) {
    std::vector<DirectedEdge> edges;
    for (const BorderEdge& e : borders) {
        const bool left = e.left && *e.left >= lowest;
        const bool right = e.right && *e.right >= lowest;
        if (left == right || (inner_only && !(e.left && e.right)))
            continue;
        edges.push_back(left ? DirectedEdge{e.from, e.to} : DirectedEdge{e.to, e.from});
    }
    return edges;
}

/// Mean of what the neighbours of a cell lead to, each followed in a straight line; NaN if
/// none has a value.
template <class Value>
double continue_outwards(const Value& value, std::ptrdiff_t column, std::ptrdiff_t row) {
    double sum = 0.0;
    double count = 0.0;
    for (std::ptrdiff_t dr = -1; dr <= 1; ++dr)
        for (std::ptrdiff_t dc = -1; dc <= 1; ++dc) {
            const double near = value(column + dc, row + dr);
            const double far = value(column + 2 * dc, row + 2 * dr);
            if (std::isnan(near))
                continue;
            // No further than to zero or to twice the near value.
            sum += std::isnan(far) ? near : std::clamp(2.0 * near - far, 0.0, 2.0 * near);
            count += 1.0;
        }
    return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

CellField make_cell_field(const GridLayout& grid, std::span<const double> values) {
    CellField field{grid.counts, grid.width, grid.height, {}};
    field.values.assign(grid.counts.columns * grid.counts.rows,
                        std::numeric_limits<double>::quiet_NaN());
    for (std::size_t p = 0; p < values.size(); ++p)
        field.values[grid.cell_of_point[p]] = values[p];
    return field;
}

CellField fill_cells(CellField field, const std::vector<bool>& wanted) {
    const auto columns = static_cast<std::ptrdiff_t>(field.counts.columns);
    const auto rows = static_cast<std::ptrdiff_t>(field.counts.rows);
    for (bool has_grown = true; has_grown;) {
        has_grown = false;
        const CellField before = field;
        const auto value = [&](std::ptrdiff_t c, std::ptrdiff_t r) {
            const bool is_outside = c < 0 || r < 0 || c >= columns || r >= rows;
            return is_outside ? std::numeric_limits<double>::quiet_NaN()
                              : before.values[static_cast<std::size_t>(r * columns + c)];
        };
        for (std::ptrdiff_t r = 0; r < rows; ++r)
            for (std::ptrdiff_t c = 0; c < columns; ++c) {
                const auto cell = static_cast<std::size_t>(r * columns + c);
                if (!wanted[cell] || !std::isnan(before.values[cell]))
                    continue;
                if (const double v = continue_outwards(value, c, r); !std::isnan(v)) {
                    field.values[cell] = v;
                    has_grown = true;
                }
            }
    }
    return field;
}

std::vector<Contour> make_contours(const CellField& field, std::span<const double> levels) {
    const Bands bands = cut_into_bands(field, levels);
    const std::vector<BorderEdge> borders = find_borders(bands);
    const auto place_of = [&](std::size_t point) { return bands.points[point]; };
    std::vector<Contour> contours;
    for (std::size_t k = 0; k < levels.size(); ++k)
        contours.push_back({levels[k],
                            chain(edges_around(borders, k + 1, false), place_of),
                            chain(edges_around(borders, k + 1, true), place_of)});
    return contours;
}

std::vector<Polyline> outline_of_cells(const CellField& field) {
    const Lattice lattice(field);
    const auto has_value = [&](std::size_t column, std::size_t row) { // beyond 0 is far beyond
        return column < field.counts.columns && row < field.counts.rows
               && !std::isnan(field.values[row * field.counts.columns + column]);
    };
    std::vector<DirectedEdge> edges; // nodes, the valued cells on the left
    const auto add_side = [&](std::size_t from, std::ptrdiff_t stride) {
        for (std::size_t k = 0; k < lattice.steps; ++k, from = edges.back().to)
            edges.push_back({from, from + static_cast<std::size_t>(stride)});
    };
    const std::size_t across = lattice.steps;
    const std::size_t up = lattice.steps * lattice.columns;
    const auto row_stride = static_cast<std::ptrdiff_t>(lattice.columns);
    for (std::size_t row = 0; row < field.counts.rows; ++row)
        for (std::size_t column = 0; column < field.counts.columns; ++column) {
            if (!has_value(column, row))
                continue;
            const std::size_t corner = row * up + column * across;
            if (!has_value(column, row - 1))
                add_side(corner, 1);
            if (!has_value(column + 1, row))
                add_side(corner + across, row_stride);
            if (!has_value(column, row + 1))
                add_side(corner + across + up, -1);
            if (!has_value(column - 1, row))
                add_side(corner + up, -row_stride);
        }
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& x, const DirectedEdge& y) {
        return std::minmax(x.from, x.to) < std::minmax(y.from, y.to);
    });
    return chain(edges, [&](std::size_t node) { return lattice.place_of(node); });
}

} // namespace isolux
