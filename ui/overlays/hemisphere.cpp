#include "core/kernel/geometry/intersector.h"
#include "ui/draw/widgets.h"
#include "ui/overlays/overlays.h"
#include "ui/overlays/scene_shapes.h"

namespace pl::ui {
namespace {

/// The direction of the hovered cell, up to the surface in that direction.
void draw_hovered_ray(ImDrawList& out, const PublishedFrame& frame, const Projection& projection,
                      const VolumeInspection& volume, int cell) {
    if (cell < 0 || cell >= volume.side * volume.side) return;
    const CellFan fan = make_cell_fans(volume.side)[static_cast<std::size_t>(cell)];
    const Vec3f direction = direction_of(volume, fan[0]);
    const float radius = kDomeShare * frame.facts.diagonal;
    const Vec3f start = volume.position + 0.01f * radius * volume.normal;
    const Hit hit = BvhIntersector{frame.scene->view()}.closest_hit({.origin = start, .direction = direction});
    draw_scene_line(out, projection, start, start + (hit.found() ? hit.t : 10.0f * radius) * direction,
                    IM_COL32(255, 255, 255, 220), em(0.12f));
}

}  // namespace

void draw_hemisphere(ViewerModel& model, const Rect& image) {
    if (!model.window().hemisphere || model.frame() == nullptr) return;
    const std::vector<ShownVolume> volumes = shown_volumes(model);
    if (volumes.empty()) return;
    const PublishedFrame& frame = *model.frame();
    const Snapshot& snapshot = frame.snapshot;
    const Projection projection(snapshot.camera, snapshot.width, snapshot.height, image);
    ImDrawList& out = *ImGui::GetBackgroundDrawList();
    out.PushClipRect({image.x, image.y}, {image.x + image.width, image.y + image.height});
    draw_shapes(out, frame, projection, volumes,
                {.range = shown_range(model, volumes),
                 .shape = model.window().lobe_shape,
                 .quantity = model.window().cell_display.quantity});
    for (const ShownVolume& shown : volumes)
        if (shown.is_selected)
            draw_hovered_ray(out, frame, projection, *shown.volume, model.selection().hovered_cell());
    out.PopClipRect();
}

void draw_flowers(ViewerModel& model, const Rect& image) {
    if (!model.flowers().is_shown() || model.frame() == nullptr) return;
    ImDrawList& out = *ImGui::GetBackgroundDrawList();
    out.PushClipRect({image.x, image.y}, {image.x + image.width, image.y + image.height});
    draw_mesh(out, model.flowers().mesh(*model.frame(), image));
    out.PopClipRect();
}

}  // namespace pl::ui
