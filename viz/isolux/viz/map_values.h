#pragma once

#include "isolux/viz/label_layout.h"
#include "isolux/viz/map_bands.h"

namespace isolux {

/// Writes values at points and on isolux lines, nothing over anything written before.
class ValueWriter {
public:
    ValueWriter(MapPage& page,
                const SurfaceResult& result,
                const SurfaceView& view,
                const MapScale& scale,
                const ValueRange& range)
        : page_(page), result_(result), view_(view), scale_(scale), range_(range) {}

    /// Lowest and highest value, labels of the lines, then values at as many points as leave
    /// the lines visible. @pre result.surface.grid
    void write_on_bands(const PaintedBands& bands);

    /// Single points: a coloured dot each, the value above or below it where there is room.
    void write_dots();

    /// The room that is taken.
    [[nodiscard]] const LabelLayout& layout() const noexcept { return layout_; }

private:
    [[nodiscard]] Point2 place_of(std::size_t point) const;
    [[nodiscard]] Text value_text(std::size_t point, const std::string& mark) const;
    [[nodiscard]] GridCounts thinning(const GridLayout& grid) const;
    void write_value(std::size_t point, const std::vector<Polyline>& border);
    void write_extreme(std::size_t point,
                       const std::string& mark,
                       const std::vector<Polyline>& border);
    void label_line(double level, const Polyline& line, const std::vector<Polyline>& border);

    MapPage& page_;
    const SurfaceResult& result_;
    const SurfaceView& view_;
    const MapScale& scale_;
    const ValueRange& range_;
    std::vector<Polyline> frame_{page_.frame()};
    LabelLayout layout_;
};

} // namespace isolux
