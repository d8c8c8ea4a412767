// What a comparison draws, as data: which pixels where in the window, and what is written on them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/session/settings.h"
#include "ui/compare/sides.h"
#include "ui/layout.h"

namespace pl {

/// Where a tile's pixels come from.
struct TileContent {
    enum class What { Picture, Frame, Difference, ErrorMap };
    What what = What::Picture;
    std::shared_ptr<const HalfPicture> picture;
    std::shared_ptr<const HalfPicture> other;  ///< subtracted, or the reference
    FramePtr frame;

    friend bool operator==(const TileContent&, const TileContent&) = default;
};

struct CompareTile {
    TileContent content;
    Rect place;  ///< of the whole picture
    Rect clip;   ///< the part of it that is shown
    std::string label;
    std::uint32_t color = 0;  ///< of the label, opaque ARGB
    bool label_right = false;
};

struct ComparePlan {
    std::vector<CompareTile> tiles;  ///< at most two; none: the picture is shown as ever
    std::optional<float> split_x;    ///< where the line between two tiles is
    std::string hint;                ///< why the mode shows less than it could; empty if it does not
    bool has_heat = false;           ///< colors are those of error_map_legend()
    bool at_image = true;            ///< the picture is where it is without a comparison: points on it can be picked
};

/// `view` is what pictures may use of the window, `reference` that of the picture, or null.
ComparePlan plan_comparison(const CompareSides& sides, const CompareState& state, const ReferencePicture* reference,
                            const Rect& view);

}  // namespace pl
