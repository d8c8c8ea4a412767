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

/// Exposure and curve as far as they apply to a view: data views such as normals are shown as they are.
DisplaySettings display_of(View view, const DisplaySettings& asked);

/// Does a view's range end at the largest value of its picture?
bool ends_at_largest(View view);
/// Fixed where what is shown has bounds (shares, entropy), else up to the largest finite value of the picture (depth and
/// the other heat maps). 0 to 1 for views that show colors. `largest` as RenderBackend::largest_value() gives it; it is
/// looked at only where ends_at_largest().
ShownRange shown_range(View view, int bins, float largest);
ShownRange shown_range(const Snapshot& snapshot);

/// How a film of this view is shown.
FrameStyle frame_style(View view, const DisplaySettings& asked, const ShownRange& range);

/// "0 to 8 bits"; empty for views that show colors.
std::string legend(View view, const ShownRange& range);
inline std::string legend(const Snapshot& snapshot) { return legend(snapshot.slot.view, shown_range(snapshot)); }

}  // namespace pl
