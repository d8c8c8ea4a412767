// Square numbers: of cells to a table, and of strata to a cell.
#pragma once

#include <cmath>
#include <cstdint>

namespace pl {

inline bool is_square(int n) {
    const std::int64_t side = std::lround(std::sqrt(static_cast<double>(n)));
    return side * side == n;
}

}  // namespace pl
