#include <algorithm>

#include <fmt/format.h>

#include "ui/draw/style.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

ImU32 stripe_of(MessageLevel level) {
    switch (level) {
    case MessageLevel::Info: return colors::kAccent;
    case MessageLevel::Warning: return colors::kWarning;
    case MessageLevel::Error: return colors::kError;
    }
    return colors::kAccent;
}

/// One message with its lower left corner at `corner`; returns its height.
float draw_toast(ImDrawList& list, ImVec2 corner, float max_width, MessageLevel level, const std::string& text) {
    const ImVec2 pad{em(0.7f), em(0.5f)};
    const float wrap = max_width - 2.0f * pad.x;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const float height = size.y + 2.0f * pad.y;
    const ImVec2 low{corner.x, corner.y - height};
    const ImVec2 high{corner.x + size.x + 2.0f * pad.x, corner.y};
    list.AddRectFilled(low, high, IM_COL32(28, 31, 38, 240), em(0.2f));
    list.AddRectFilled(low, {low.x + em(0.25f), high.y}, stripe_of(level));
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + pad.x, low.y + pad.y}, colors::kText, text.c_str(),
                 nullptr, wrap);
    return height;
}

}  // namespace

void draw_toasts(const ViewerModel& model, const Layout& layout, const ComparePlan& plan) {
    const Rect& view = layout.clear;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    ImVec2 corner{view.x + em(0.6f), view.y + view.height - em(0.6f)};
    corner.y = std::min(corner.y, top_of_names(plan) - em(0.6f));
    const float width = std::min(view.width - em(1.2f), em(34.0f));
    for (auto toast = model.messages().toasts().rbegin(); toast != model.messages().toasts().rend(); ++toast)
        corner.y -= draw_toast(list, corner, width, toast->level, toast->text) + em(0.35f);

    if (!model.camera().is_speed_shown()) return;
    const std::string text = fmt::format("speed {:.4g} units/s", model.camera().speed());
    const float text_width = ImGui::CalcTextSize(text.c_str()).x;
    draw_toast(list, {view.center().x - 0.5f * text_width - em(0.7f), view.y + 0.2f * view.height}, em(30.0f),
               MessageLevel::Info, text);
}

}  // namespace pl::ui
