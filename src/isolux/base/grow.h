#pragma once

#include <cstddef>
#include <vector>

namespace isolux {

/// Makes room for n values in working memory that is kept for the next time.
template <class T> void grow(std::vector<T>& v, std::size_t n) {
    if (v.size() < n)
        v.resize(n);
}

} // namespace isolux
