// Labels over the pictures of a comparison, and the handle of their dividing line.
#include <algorithm>
#include <limits>
#include <string>

#include "ui/compare/half_image.h"
#include "ui/draw/widgets.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

constexpr float kHandlePixels = 12.0f;

ImVec2 label_padding() { return {em(0.45f), em(0.2f)}; }

std::string label_lines(const CompareTile& tile) {
    return text_in_lines(tile.label, std::max(tile.clip.width - em(1.2f) - 2.0f * label_padding().x, em(4.0f)));
}

/// In the lower left or right corner of the visible part of a tile.
Rect label_place(const CompareTile& tile) {
    const ImVec2 pad = label_padding();
    const ImVec2 size = ImGui::CalcTextSize(label_lines(tile).c_str());
    const Rect& part = tile.clip;
    const float width = size.x + 2.0f * pad.x;
    const float height = size.y + 2.0f * pad.y;
    const float x = tile.label_right ? part.x + part.width - width - em(0.6f) : part.x + em(0.6f);
    return {x, part.y + part.height - height - em(0.6f), width, height};
}

void draw_label(ImDrawList& list, const CompareTile& tile) {
    const ImVec2 pad = label_padding();
    const Rect& part = tile.clip;
    const Rect place = label_place(tile);
    list.PushClipRect({part.x, part.y}, {part.x + part.width, part.y + part.height}, true);
    list.AddRectFilled({place.x, place.y}, {place.x + place.width, place.y + place.height}, colors::kBadge, em(0.2f));
    list.AddText({place.x + pad.x, place.y + pad.y}, to_text_color(tile.color), label_lines(tile).c_str());
    list.PopClipRect();
}

/// A narrow window around the line, which takes the presses on it and no others.
void draw_handle(ViewerModel& model, const CompareTile& tile, float x) {
    const Rect& place = tile.place;
    const Rect& seen = tile.clip;
    ImGui::SetNextWindowPos({x - 0.5f * kHandlePixels, seen.y});
    ImGui::SetNextWindowSize({kHandlePixels, seen.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::Begin("split", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::InvisibleButton("line", {kHandlePixels, seen.height});
    const bool held = ImGui::IsItemActive();
    const bool lit = held || ImGui::IsItemHovered();
    if (lit) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::End();
    ImGui::PopStyleVar(2);
    if (held) model.comparison().set_split((ImGui::GetIO().MousePos.x - place.x) / place.width);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    // In the part that no card covers, and no row of badges below it.
    const float low = std::max(seen.y, gui_memory().top_card_end) + em(2.8f);
    const float high = std::min(seen.y + seen.height, gui_memory().low_card_start) - em(0.6f);
    const float middle = std::clamp(seen.y + 0.5f * seen.height, low, std::max(low, high));
    note_place("split line", {x - em(0.5f), middle - em(0.5f), em(1.0f), em(1.0f)});
    // With a rim: pictures may be as bright as the line.
    for (const auto& [rim, color] :
         {std::pair{1.0f, colors::kGround}, {0.0f, lit ? colors::kAccent : colors::kText}}) {
        list.AddRectFilled({x - 1.0f - rim, seen.y}, {x + 1.0f + rim, seen.y + seen.height}, color);
        list.AddCircleFilled({x, middle}, em(0.5f) + rim, color, 20);
    }
}

}  // namespace

float top_of_names(const ComparePlan& plan, const Rect& image) {
    float top =
        plan.tiles.empty() ? label_place({{}, image, image, "", 0, false}).y : std::numeric_limits<float>::infinity();
    for (const CompareTile& tile : plan.tiles) top = std::min(top, label_place(tile).y);
    return top;
}

void draw_comparison(ViewerModel& model, const ComparePlan& plan) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const CompareTile& tile : plan.tiles) draw_label(list, tile);
    if (plan.split_x) draw_handle(model, plan.tiles.front(), *plan.split_x);
}

}  // namespace pl::ui
