// The range of values of the colors of a data view, in windows and 8-bit files alike.
#pragma once

#include <string>

#include "core/session/snapshot.h"

namespace pl {

/// From 0 to `high`, which is positive and finite.
struct ShownRange {
    float high = 1.0f;
    std::string unit;  ///< may be empty

    float scale() const;  ///< factor from values to [0, 1]
};

/// Whether a view shows radiance: exposure and tone curve apply to no other.
bool shows_radiance(View view);

/// Exposure and curve as far as they apply to a view: data views such as normals have neither.
DisplaySettings display_of(View view, const DisplaySettings& asked);

/// Whether a view's range ends at the largest value of its picture.
bool ends_at_largest(View view);
/// Fixed for bounded values (shares, entropy), else up to the largest finite value of the picture (depth and the other heat
/// maps). 0 to 1 for views that show colors. `largest` is RenderBackend::largest_value(), used only if ends_at_largest().
ShownRange shown_range(View view, int bins, float largest);
ShownRange shown_range(const Snapshot& snapshot);

/// Scale, curve and colors of a film of this view.
FrameStyle frame_style(View view, const DisplaySettings& asked, const ShownRange& range);

/// "0 to 8 bits"; empty for views that show colors.
std::string legend(View view, const ShownRange& range);
inline std::string legend(const Snapshot& snapshot) { return legend(snapshot.slot.view, shown_range(snapshot)); }

}  // namespace pl
