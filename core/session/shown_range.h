// The numbers that a data view's darkest and lightest colors stand for, in windows and 8-bit files alike.
#pragma once

#include <string>

#include "core/session/snapshot.h"

namespace pl {

/// From 0 to `high`, which is positive and finite.
struct ShownRange {
    float high = 1.0f;
    std::string unit;  ///< may be empty

    float scale() const;  ///< brings values into [0, 1]
};

/// Does a view show radiance? Exposure and tone curve are for these: other views are shown as they are.
bool shows_radiance(View view);

/// Fixed where what is shown has bounds (shares, entropy), else up to the largest finite value of the picture (depth and
/// the other heat maps). 0 to 1 for views that show colors.
ShownRange shown_range(const Snapshot& snapshot);

/// "0 to 8 bits"; empty for views that show colors.
std::string legend(View view, const ShownRange& range);
inline std::string legend(const Snapshot& snapshot) { return legend(snapshot.slot.view, shown_range(snapshot)); }

}  // namespace pl
