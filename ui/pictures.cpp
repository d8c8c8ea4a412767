#include "ui/pictures.h"

#include "ui/model/field_flowers.h"
#include "ui/model/path_explorer.h"
#include "ui/model/selection.h"
#include "ui/overlays/scene_shapes.h"
#include "ui/panels/figure_curves.h"
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

ByteImage PicturePainter::figures(const std::vector<FigurePoint>& points, int width, int height) const {
    Offscreen offscreen(width, height, font_);
    return offscreen.paint(nullptr, [&] { draw_figures(points, 0); });
}

}  // namespace pl::ui
