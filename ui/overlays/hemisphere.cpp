#include <fmt/format.h>

#include "core/kernel/geometry/intersector.h"
#include "ui/overlays/overlays.h"

namespace pl {
namespace {

constexpr float kRadiusShare = 0.04f;  ///< of the scene's diagonal
constexpr std::uint8_t kAlpha = 255;
constexpr std::uint8_t kHiddenAlpha = 80;  ///< when something stands between it and the camera

/// Does something stand between the camera and the top of the hemisphere?
bool is_hidden(const PublishedFrame& frame, const VolumeInspection& volume, float radius) {
    const Vec3f top = volume.position + radius * volume.normal;
    const Vec3f eye = frame.snapshot.camera.eye;
    return BvhIntersector{frame.scene->view()}.occluded({.origin = eye, .direction = top - eye, .t_max = 1.0f});
}

/// The direction of the hovered cell, as far as the surface that it looks at.
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

void fill_fan(ImDrawList& list, std::span<const ImVec2> center_and_border, ImU32 color) {
    const auto count = static_cast<int>(center_and_border.size());
    if (count < 3) return;
    const ImVec2 uv = ImGui::GetFontTexUvWhitePixel();
    list.PrimReserve(3 * (count - 1), count);
    const auto first = static_cast<unsigned int>(list._VtxCurrentIdx);
    for (int i = 1; i < count; ++i) {
        const int next = i + 1 < count ? i + 1 : 1;
        list.PrimWriteIdx(static_cast<ImDrawIdx>(first));
        list.PrimWriteIdx(static_cast<ImDrawIdx>(first + static_cast<unsigned int>(i)));
        list.PrimWriteIdx(static_cast<ImDrawIdx>(first + static_cast<unsigned int>(next)));
    }
    // Half a pixel larger than asked for: software renderers leave pinholes where triangles meet.
    constexpr float kOverlap = 0.5f;
    const ImVec2 center = center_and_border[0];
    for (const ImVec2& point : center_and_border) {
        const Vec2f out{point.x - center.x, point.y - center.y};
        const float length = glm::length(out);
        const float scale = length > 0.0f ? 1.0f + kOverlap / length : 1.0f;
        list.PrimWriteVtx({center.x + scale * out.x, center.y + scale * out.y}, uv, color);
    }
}

void draw_hemisphere(const ViewerModel& model, const Rect& image) {
    const VolumeInspection* volume = model.inspection();
    if (!model.window().hemisphere || volume == nullptr) return;
    const PublishedFrame& frame = *model.frame();
    const float radius = kRadiusShare * frame.diagonal;
    const std::vector<CellFan> fans = make_cell_fans(volume->side);
    const CellValues values = cell_values(*volume, model.window().quantity, model.window().scale);
    const std::uint8_t alpha = is_hidden(frame, *volume, radius) ? kHiddenAlpha : kAlpha;

    DrawList shapes;
    add_hemisphere(shapes, *volume, fans, values, radius, alpha, model.window().hovered_cell);
    if (model.window().hovered_cell >= 0 && static_cast<std::size_t>(model.window().hovered_cell) < fans.size())
        add_ray(shapes, frame, *volume, fans[static_cast<std::size_t>(model.window().hovered_cell)], radius);

    const Snapshot& snapshot = frame.snapshot;
    ImDrawList& out = *ImGui::GetBackgroundDrawList();
    out.PushClipRect({image.x, image.y}, {image.x + image.width, image.y + image.height});
    draw_shapes(out, project(shapes, Projection(snapshot.camera, snapshot.width, snapshot.height, image)));
    out.PopClipRect();
}

}  // namespace pl
