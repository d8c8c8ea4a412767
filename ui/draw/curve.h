// A small curve over passes, as data that can be tested without a window.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ui/draw/draw_list.h"

namespace pl::ui {

struct PassPoint {
    double passes = 1.0;  ///< at least 1
    double value = 0.0;
    double low = 0.0;  ///< interval of the value
    double high = 0.0;
};

/// Logarithmic in passes, linear in values from 0 on.
struct PassScale {
    double first = 1.0;  ///< passes at the left end
    double last = 2.0;   ///< at the right end, larger than `first`
    double top = 1.0;    ///< value at the top

    Vec2f place(const Rect& rect, double passes, double value) const;
};

/// The scale that shows all points, of several curves one after the other. `least_top`: a value that is shown in any case.
PassScale scale_of(std::span<const PassPoint> points, double least_top);

}  // namespace pl::ui
