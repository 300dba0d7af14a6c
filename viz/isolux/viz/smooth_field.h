#pragma once

#include <cstddef>
#include <vector>

namespace isolux {

/// A table of values, row by row; NaN where there is none.
struct ValueTable {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<double> values;

    [[nodiscard]] double at(std::size_t column, std::size_t row) const noexcept {
        return values[row * columns + column];
    }
};

/// The values of cells at the nodes of a lattice with `steps` intervals to a cell: the result
/// has columns * steps + 1 by rows * steps + 1 nodes, NaN at nodes that touch no valued cell.
///
/// Exact at the cells' centres and for linear fields. Between the centres piecewise cubic,
/// without new maxima or minima along rows and columns (slopes after Steffen, A&A 239, 1990,
/// 443-450), the same for a mirrored or transposed table. From the outer centres to the border
/// (half a cell) straight on, but never beyond the smallest and largest value given.
/// @pre steps is even and at least 2
[[nodiscard]] ValueTable smooth_to_lattice(const ValueTable& cells, std::size_t steps);

} // namespace isolux
