#include <algorithm>

#include <fmt/format.h>

#include "ui/draw/widgets.h"
#include "ui/overlays/overlays.h"
#include "ui/overlays/scene_shapes.h"

namespace pl::ui {
namespace {

/// The numbers of a path's vertices, at their positions.
void draw_numbers(ImDrawList& out, const diagnose::PathRecord& path, const Projection& projection) {
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
        if (path.vertices[i].is_escape) continue;
        const auto point = projection(path.vertices[i].position);
        if (!point) continue;
        const ImVec2 at{point->window.x, point->window.y};
        const std::string text = fmt::format("{}", i);
        out.AddCircleFilled(at, em(0.28f), IM_COL32(0, 0, 0, 220));
        out.AddCircleFilled(at, em(0.18f), IM_COL32_WHITE);
        const ImVec2 corner{at.x + em(0.35f), at.y - em(1.1f)};
        out.AddText({corner.x + 1.0f, corner.y + 1.0f}, IM_COL32_BLACK, text.c_str());
        out.AddText(corner, IM_COL32_WHITE, text.c_str());
    }
}

/// In short pieces: without a graphics card a line costs every pixel of the rectangle that it crosses.
void draw_stroke(ImDrawList& out, const Stroke& stroke) {
    constexpr float kPiecePixels = 24.0f;
    constexpr float kMostPieces = 256.0f;  // of a stroke that reaches far out of the window
    const Vec2f along = stroke.to - stroke.from;
    const int pieces = static_cast<int>(std::clamp(glm::length(along) / kPiecePixels, 1.0f, kMostPieces));
    const auto at = [&](int piece) {
        const float share = static_cast<float>(piece) / static_cast<float>(pieces);
        return ImVec2{stroke.from.x + share * along.x, stroke.from.y + share * along.y};
    };
    for (int piece = 0; piece < pieces; ++piece) out.AddLine(at(piece), at(piece + 1), stroke.color, stroke.width_px);
}

}  // namespace

void draw_strokes(ImDrawList& out, std::span<const PathPiece> pieces, const Projection& projection,
                  const diagnose::PathRecord* numbered) {
    for (const Stroke& stroke : strokes_of(pieces, projection, em(1.0f) / kFontPixels)) draw_stroke(out, stroke);
    if (numbered != nullptr) draw_numbers(out, *numbered, projection);
}

void draw_path_lines(ViewerModel& model, const Rect& image) {
    PathExplorer& explorer = model.paths();
    if (!explorer.is_shown() || explorer.paths() == nullptr || model.frame() == nullptr) return;
    const PublishedFrame& frame = *model.frame();
    const Snapshot& snapshot = frame.snapshot;
    const Projection projection(snapshot.camera, snapshot.width, snapshot.height, image);
    ImDrawList& out = *ImGui::GetBackgroundDrawList();
    out.PushClipRect({image.x, image.y}, {image.x + image.width, image.y + image.height});
    const auto selected = explorer.selected();
    draw_strokes(out, explorer.pieces(frame), projection, selected ? &explorer.listed()[*selected] : nullptr);
    out.PopClipRect();
}

}  // namespace pl::ui
