#include "ui/pictures.h"

#include "ui/model/field_flowers.h"
#include "ui/model/path_explorer.h"
#include "ui/model/selection.h"
#include "ui/overlays/scene_shapes.h"
#include "ui/panels/figure_curves.h"
#include "ui/panels/volume_discs.h"
#include "ui/window/offscreen.h"

namespace pl::ui {

PublishedFrame frame_of(Session& session, FilmSlot slot, const DisplaySettings& display) {
    PublishedFrame frame = frame_of_film(session, slot, display, false);
    frame.facts = facts_of(*frame.description);
    return frame;
}

/// `draw` gets the list of the picture and the projection into it.
template <class Draw>
ByteImage PicturePainter::over(const PublishedFrame& frame, Draw&& draw) const {
    const Snapshot& snapshot = frame.snapshot;
    const Rect image{0.0f, 0.0f, static_cast<float>(snapshot.width), static_cast<float>(snapshot.height)};
    const Projection projection(snapshot.camera, snapshot.width, snapshot.height, image);
    Offscreen offscreen(snapshot.width, snapshot.height, font_);
    return offscreen.paint(frame.picture.pixels(), [&] { draw(*ImGui::GetBackgroundDrawList(), projection); });
}

ByteImage PicturePainter::volumes(const PublishedFrame& frame,
                                  const std::vector<std::shared_ptr<const VolumeInspection>>& volumes,
                                  LobeShape shape) const {
    std::vector<ShownVolume> shown;
    std::vector<float> values;
    for (std::size_t i = 0; i < volumes.size() && i < PinnedVolumes::kColors.size(); ++i) {
        shown.push_back(
            {.volume = volumes[i], .color = volumes.size() > 1 ? PinnedVolumes::kColors[i] : 0xffffffffu});
        values.insert(values.end(), volumes[i]->radiance.begin(), volumes[i]->radiance.end());
    }
    return over(frame, [&](ImDrawList& out, const Projection& projection) {
        draw_shapes(out, frame, projection, shown,
                    {.range = range_of(values, {}), .shape = shape, .quantity = CellQuantity::Radiance});
    });
}

ByteImage PicturePainter::flowers(const PublishedFrame& frame, const FieldKeyFrame& field) const {
    const FlowerField flowers = make_flowers(field, 1, frame.facts.diagonal);
    return over(frame, [&](ImDrawList& out, const Projection& projection) {
        FlowerCounts counts;
        draw_mesh(out, flower_mesh(flowers, frame.scene->view(), projection, counts));
    });
}

ByteImage PicturePainter::paths(const PublishedFrame& frame, const diagnose::PixelPaths& paths) const {
    const std::vector<std::size_t> order = diagnose::by_light(paths.plain);
    DrawnPaths drawn{.range = light_range(paths), .escape_length = frame.facts.diagonal};
    if (!order.empty()) drawn.selected = order.front();
    const std::vector<PathPiece> pieces =
        split_by_visibility(lines_of(paths, drawn), frame.scene->view(), frame.snapshot.camera.eye);
    return over(frame, [&](ImDrawList& out, const Projection& projection) {
        draw_strokes(out, pieces, projection, drawn.selected ? &paths.plain[*drawn.selected] : nullptr);
    });
}

ByteImage PicturePainter::discs(const VolumeInspection& volume, const CameraDescription& camera,
                                const std::vector<std::string>& lines,
                                const std::vector<std::pair<ShownDisc, ValueRange>>& discs, float diameter) const {
    constexpr std::size_t kColumns = 2;
    constexpr float kMargin = 24.0f;  // pixels, as all here
    constexpr float kLine = 18.0f;
    const float column = diameter + (1.0f + kLegendEm) * kFontPixels + kMargin;
    const float row = diameter + 4.0f * kLine;
    const float top = 2.0f * kMargin + kLine * static_cast<float>(lines.size());
    const std::size_t rows = (discs.size() + kColumns - 1) / kColumns;
    Offscreen offscreen(static_cast<int>(kMargin + kColumns * column),
                        static_cast<int>(top + static_cast<float>(rows) * row), font_);
    const DiscShape shape(volume, camera);
    return offscreen.paint(nullptr, [&] {
        ImDrawList& out = *ImGui::GetBackgroundDrawList();
        for (std::size_t i = 0; i < lines.size(); ++i)
            out.AddText({kMargin, kMargin + kLine * static_cast<float>(i)}, colors::kText, lines[i].c_str());
        for (std::size_t i = 0; i < discs.size(); ++i) {
            const auto& [disc, range] = discs[i];
            const float x = kMargin + column * static_cast<float>(i % kColumns);
            const float y = top + row * static_cast<float>(i / kColumns);
            out.AddText({x, y}, colors::kText, disc.caption.c_str());
            const DiscPlace place{{x + 0.5f * diameter, y + 2.0f * kLine + 0.5f * diameter}, 0.5f * diameter};
            draw_disc(out, place, shape, positions_in(range, disc.values), -1);
            draw_legend(out, {x + diameter + kFontPixels, y + 2.0f * kLine, em(kLegendEm), diameter}, range);
        }
    });
}

ByteImage PicturePainter::gains(const PublishedFrame& frame, const TileGains& gains) const {
    const Rect image{0.0f, 0.0f, static_cast<float>(frame.snapshot.width), static_cast<float>(frame.snapshot.height)};
    return over(frame, [&](ImDrawList& out, const Projection&) { draw_gain_marks(out, gains, image, false); });
}

ByteImage PicturePainter::figures(const std::vector<FigurePoint>& points, int width, int height) const {
    Offscreen offscreen(width, height, font_);
    return offscreen.paint(nullptr, [&] { draw_figures(points, 0); });
}

}  // namespace pl::ui
