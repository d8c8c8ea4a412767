#include "ui/draw/widgets.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

/// A triangle up for a gain, one down for a loss, a disc for no difference, a ring where nothing is known.
void draw_mark(ImDrawList& out, ImVec2 center, float radius, Verdict verdict) {
    const ImU32 color = to_imgui_color(mark_color(verdict));
    out.AddCircleFilled(center, 1.35f * radius, IM_COL32(0, 0, 0, 170));
    const float sign = verdict == Verdict::Faster ? -1.0f : 1.0f;
    if (verdict == Verdict::Faster || verdict == Verdict::Slower)
        out.AddTriangleFilled({center.x, center.y + sign * radius},
                              {center.x - 0.87f * radius, center.y - 0.5f * sign * radius},
                              {center.x + 0.87f * radius, center.y - 0.5f * sign * radius}, color);
    else if (verdict == Verdict::NoDifference)
        out.AddCircleFilled(center, 0.7f * radius, color);
    else
        out.AddCircle(center, 0.7f * radius, color, 0, em(0.1f));
}

}  // namespace

void draw_gain_marks(const ViewerModel& model, const Rect& image) {
    const TileGains* gains = model.gain_marks().gains();
    if (gains == nullptr) return;
    ImDrawList& out = *ImGui::GetBackgroundDrawList();
    const float width = image.width / static_cast<float>(gains->columns);
    const float height = image.height / static_cast<float>(gains->rows);
    const float radius = std::min(em(0.6f), 0.2f * std::min(width, height));
    out.PushClipRect({image.x, image.y}, {image.x + image.width, image.y + image.height});
    for (std::size_t i = 0; i < gains->tiles.size(); ++i) {
        const auto columns = static_cast<std::size_t>(gains->columns);
        draw_mark(out,
                  {image.x + (static_cast<float>(i % columns) + 0.5f) * width,
                   image.y + (static_cast<float>(i / columns) + 0.5f) * height},
                  radius, verdict_of(gains->tiles[i]));
    }
    out.PopClipRect();
}

}  // namespace pl::ui
