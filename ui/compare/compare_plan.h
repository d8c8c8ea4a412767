// The drawing of a comparison as data: its pictures, their rectangles in the window and their labels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/session/settings.h"
#include "ui/compare/sides.h"
#include "ui/draw/picture_zoom.h"

namespace pl::ui {

/// The source of a tile's pixels.
struct TileContent {
    enum class What { Picture, Frame, Difference, ErrorMap };
    What what = What::Picture;
    std::shared_ptr<const HalfPicture> picture;
    std::shared_ptr<const HalfPicture> other;  ///< subtracted, or the reference
    FramePtr frame;
    bool is_display = false;  ///< of `picture`: OpenedPicture::is_display

    friend bool operator==(const TileContent&, const TileContent&) = default;
};

struct CompareTile {
    TileContent content;
    Rect place;  ///< of the whole picture
    Rect clip;   ///< the visible part of it
    std::string label;
    std::uint32_t color = 0;  ///< of the label, opaque ARGB
    bool label_right = false;
};

struct ComparePlan {
    std::vector<CompareTile> tiles;  ///< at most two; none: the picture is shown without a comparison
    std::optional<float> split_x;    ///< the line between two tiles
    std::string hint;                ///< the missing input of the mode; empty if it has all
    bool has_heat = false;           ///< colors are those of error_map_legend()
    bool is_zoomed = false;          ///< tiles show a part of their pictures, pixel by pixel
};

/// The place of a whole picture in the window, and the part of it that is seen.
struct PicturePlace {
    Rect place;
    Rect clip;
};
/// Of all pictures of the plan; without any, of the one at `image` in `view`. All show the same scene from the same camera: overlays
/// and clicks belong to each of them. Two that share a place are one. Without those of other proportions, which were opened from files.
std::vector<PicturePlace> picture_places(const ComparePlan& plan, const Rect& image, const Rect& view);
/// Of the picture under the pointer; empty without one.
Rect place_under(const std::vector<PicturePlace>& places, Vec2f pointer);

/// `view` is the part of the window for pictures, `reference` that of the picture, or null. Pictures side by side show the same
/// part of both.
ComparePlan plan_comparison(const CompareSides& sides, const CompareState& state, const ReferencePicture* reference,
                            const Rect& view, const PictureZoom& zoom = {});

/// Value of a tile's pixel, linear: of a difference the difference, of an error map the relative error in every channel. Empty if
/// its picture has no values.
std::optional<Vec3f> value_of(const TileContent& content, PixelPosition pixel);
/// Of a frame; empty if it has no values.
std::optional<Vec3f> value_of(const PublishedFrame& frame, PixelPosition pixel);

// The pixel under the pointer: of one of the compared pictures, or of the picture.

/// Empty if the pointer is over no picture. `image` is the rectangle of the frame's picture.
std::optional<PointedPixel> pointed_pixel(const ComparePlan& plan, const PublishedFrame& frame, const Rect& image,
                                          Vec2f pointer);

/// The magnifier there, in the same way.
std::optional<Magnifier> magnifier_at(const ComparePlan& plan, const PublishedFrame& frame, const Rect& image,
                                      Vec2f pointer, const Rect& view, float em);

}  // namespace pl::ui
