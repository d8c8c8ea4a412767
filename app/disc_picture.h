// Discs of a hemisphere drawn into a picture, in the frame and the colors of the window.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/canvas.h"
#include "core/fields/disc_frame.h"
#include "core/fields/inspect_field.h"
#include "core/inspect/guiding_figures.h"
#include "core/io/image.h"
#include "core/plot/value_scale.h"
#include "core/scene/description.h"

namespace pl {

/// Upper left corner and diameter, in pixels. Caption and legend are outside.
struct DiscSpot {
    int x;
    int y;
    int diameter;
};

class DiscPicture {
public:
    static constexpr Rgb kBackground{24, 24, 28};
    static constexpr Rgb kInk{230, 230, 230};
    static constexpr int kMargin = 24;                    ///< around discs and text, pixels
    static constexpr int kLine = Canvas::kLineHeight;     ///< height of a line of text, pixels
    static constexpr int kLegendHeight = 12 + 3 * kLine;  ///< of draw_legend(), pixels

    DiscPicture(int width, int height, const VolumeInspection& volume, const CameraDescription& camera);

    const DiscFrame& frame() const { return frame_; }
    const ByteImage& image() const { return canvas_.image(); }

    void text(int x, int y, const std::string& words) { canvas_.text(x, y, words, kInk); }
    /// One value per cell in the colors of `range`; a cross at the normal, a ring at the camera, an arrow up.
    void draw_disc(const DiscSpot& spot, const std::string& caption, std::span<const float> values,
                   const ValueRange& range);
    /// The colors below a disc, with the values at both ends and in the middle.
    void draw_legend(const DiscSpot& spot, const ValueRange& range);

private:
    void draw_marks(const DiscSpot& spot);

    Canvas canvas_;
    int side_;
    DiscFrame frame_;
    Vec3f to_camera_;
};

/// Color of a position in a range, see heat_color().
Rgb map_color_of(float position);

// The learned hemisphere of a radiance volume as a picture: equal-area discs with a legend.

/// One large disc of the learned radiance, two small ones of probability and visits, with their captions, in the DiscFrame of
/// volume and camera. Colors as in the window: each disc over its own values, logarithmic.
ByteImage draw_hemisphere(const VolumeInspection& volume, const CameraDescription& camera, const std::string& title);

/// The lines above all discs: title, volume, position, and the world directions of the disc's axes.
std::vector<std::string> hemisphere_lines(const VolumeInspection& volume, const CameraDescription& camera,
                                          const std::string& title);

// The learned hemisphere of a radiance volume beside the light that reaches it, as a picture and as text.

/// Learned beside true radiance, on one scale; below them the density that leaves no variance beside the density of
/// guided paths, on one scale, both relative to cosine sampling.
ByteImage draw_truth(const VolumeInspection& volume, const LightReport& truth, const CameraDescription& camera,
                     const std::string& title);

/// Paths, divergences and variance factor with their 95 % intervals.
std::vector<std::string> truth_lines(const LightReport& truth);

}  // namespace pl
