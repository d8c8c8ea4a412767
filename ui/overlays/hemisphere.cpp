#include <fmt/format.h>

#include "core/kernel/geometry/intersector.h"
#include "ui/draw/widgets.h"
#include "ui/overlays/overlays.h"

namespace pl {
namespace {

constexpr float kRadiusShare = 0.04f;  ///< of the scene's diagonal
constexpr std::uint8_t kAlpha = 255;
constexpr std::uint8_t kHiddenAlpha = 80;  ///< if the scene hides it from the camera

/// Whether the scene hides the top of the hemisphere from the camera.
bool is_hidden(const PublishedFrame& frame, const VolumeInspection& volume, float radius) {
    const Vec3f top = volume.position + radius * volume.normal;
    const Vec3f eye = frame.snapshot.camera.eye;
    return BvhIntersector{frame.scene->view()}.occluded({.origin = eye, .direction = top - eye, .t_max = 1.0f});
}

/// The direction of the hovered cell, up to the surface in that direction.
void add_ray(DrawList& list, const PublishedFrame& frame, const VolumeInspection& volume, const CellFan& fan,
             float radius) {
    const Vec3f direction = direction_of(volume, fan[0]);
    const Vec3f start = volume.position + 0.01f * radius * volume.normal;
    const Hit hit = BvhIntersector{frame.scene->view()}.closest_hit({.origin = start, .direction = direction});
    const float length = hit.found() ? hit.t : 10.0f * radius;
    list.add_line(start, start + length * direction, IM_COL32(255, 255, 255, 220), 2.0f);
}

void draw_shapes(ImDrawList& out, const ProjectedShapes& projected) {
    std::vector<ImVec2> points;
    for (const DrawList::Shape& shape : projected.shapes) {
        points.clear();
        for (std::uint32_t i = 0; i < shape.count; ++i) {
            const Vec2f p = projected.points[shape.first + i];
            points.push_back({p.x, p.y});
        }
        if (shape.kind == DrawList::Shape::Kind::Fan)
            fill_fan(out, points, shape.color);
        else
            out.AddLine(points[0], points[1], shape.color, shape.width_px);
    }
}

}  // namespace

void draw_hemisphere(const ViewerModel& model, const Rect& image) {
    const VolumeInspection* volume = model.selection().inspection();
    if (!model.window().hemisphere || volume == nullptr) return;
    const PublishedFrame& frame = *model.frame();
    const float radius = kRadiusShare * frame.facts.diagonal;
    const std::vector<CellFan> fans = make_cell_fans(volume->side);
    const CellDisplay& display = model.window().cell_display;
    const std::vector<float> values = cell_values(*volume, display.quantity);
    const std::vector<float> positions = positions_in(range_of(values, display.range), values);
    const std::uint8_t alpha = is_hidden(frame, *volume, radius) ? kHiddenAlpha : kAlpha;

    DrawList shapes;
    add_hemisphere(shapes, *volume, fans, positions, {radius, alpha, model.selection().hovered_cell()});
    if (model.selection().hovered_cell() >= 0 &&
        static_cast<std::size_t>(model.selection().hovered_cell()) < fans.size())
        add_ray(shapes, frame, *volume, fans[static_cast<std::size_t>(model.selection().hovered_cell())], radius);

    const Snapshot& snapshot = frame.snapshot;
    ImDrawList& out = *ImGui::GetBackgroundDrawList();
    out.PushClipRect({image.x, image.y}, {image.x + image.width, image.y + image.height});
    draw_shapes(out, project(shapes, Projection(snapshot.camera, snapshot.width, snapshot.height, image)));
    out.PopClipRect();
}

}  // namespace pl
