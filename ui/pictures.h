// The displays over the picture drawn into memory, by the code that draws them in the window: for files and tests, without a display.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/io/image.h"
#include "ui/draw/lobes.h"
#include "ui/model/light_tracing.h"
#include "ui/model/shown_volumes.h"
#include "ui/worker/field_history.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

/// A film as the window would show it. It has a pass.
PublishedFrame frame_of(Session& session, FilmSlot slot, const DisplaySettings& display);

/// Draws pictures with the window's font, see load_fonts().
class PicturePainter {
public:
    explicit PicturePainter(std::filesystem::path font) : font_(std::move(font)) {}

    /// Volumes as lobes or domes at their places, with ring and peak: at most PinnedVolumes::kMost in their colors, one alone in white.
    ByteImage volumes(const PublishedFrame& frame,
                      const std::vector<std::shared_ptr<const VolumeInspection>>& volumes, LobeShape shape) const;
    /// Lobes of every n-th volume, at most kMostFlowers.
    ByteImage flowers(const PublishedFrame& frame, const FieldKeyFrame& field) const;
    /// Paths as lines; the brightest wide, with its shadow rays and the numbers of its vertices.
    ByteImage paths(const PublishedFrame& frame, const diagnose::PixelPaths& paths) const;
    /// Lines of text, and below them discs of a volume in two columns, each with the legend of its range. `diameter` in pixels.
    ByteImage discs(const VolumeInspection& volume, const CameraDescription& camera,
                    const std::vector<std::string>& lines, const std::vector<std::pair<ShownDisc, ValueRange>>& discs,
                    float diameter) const;
    /// Marks of gains and losses, one for each tile.
    ByteImage gains(const PublishedFrame& frame, const TileGains& gains) const;
    /// Divergences and variance factor over the passes. Size in pixels.
    ByteImage figures(const std::vector<FigurePoint>& points, int width, int height) const;

private:
    template <class Draw>
    ByteImage over(const PublishedFrame& frame, Draw&& draw) const;

    std::filesystem::path font_;
};

}  // namespace pl::ui
