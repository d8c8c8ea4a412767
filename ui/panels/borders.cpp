#include <algorithm>
#include <cmath>
#include <span>

#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

constexpr float kArrowEm = 3.0f;  ///< length of the part that folds

/// One of the borders as it is drawn. Labels are those by which scripts point at it.
struct BorderLook {
    Border border;
    Rect place;
    bool drags;  ///< its panel is open
    const char* label;

    bool is_upright() const { return border != Border::Accuracy; }
};

/// A part of a border that folds or opens one panel.
struct FoldLook {
    const char* label;
    const char* tip;
    ImGuiDir direction;
};

void draw_arrow(ImDrawList& list, const Rect& place, ImGuiDir direction, ImU32 color) {
    const Vec2f c = place.center();
    const float r = 0.4f * std::min(place.width, place.height);
    switch (direction) {
    case ImGuiDir_Left:
        list.AddTriangleFilled({c.x - r, c.y}, {c.x + r, c.y - 2 * r}, {c.x + r, c.y + 2 * r}, color);
        break;
    case ImGuiDir_Right:
        list.AddTriangleFilled({c.x + r, c.y}, {c.x - r, c.y + 2 * r}, {c.x - r, c.y - 2 * r}, color);
        break;
    case ImGuiDir_Up:
        list.AddTriangleFilled({c.x, c.y - r}, {c.x + 2 * r, c.y + r}, {c.x - 2 * r, c.y + r}, color);
        break;
    default: list.AddTriangleFilled({c.x, c.y + r}, {c.x - 2 * r, c.y - r}, {c.x + 2 * r, c.y - r}, color); break;
    }
}

/// The part of a border from `start` on, along it.
Rect part_of(const BorderLook& look, float start, float length) {
    if (look.is_upright()) return {look.place.x, look.place.y + start, look.place.width, length};
    return {look.place.x + start, look.place.y, length, look.place.height};
}

/// Puts an invisible control there. Returns whether it is pressed.
bool put_control(const char* id, const Rect& place) {
    ImGui::SetCursorScreenPos({place.x, place.y});
    return ImGui::InvisibleButton(id, {std::max(place.width, 1.0f), std::max(place.height, 1.0f)});
}

void draw_drag_part(ViewerModel& model, const Layout& layout, const BorderLook& look, const Rect& place,
                    const char* id) {
    put_control(id, place);
    note_place(look.label);
    if (!ImGui::IsItemHovered() && !ImGui::IsItemActive()) return;
    ImGui::SetMouseCursor(look.is_upright() ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddRectFilled({look.place.x, look.place.y},
                                              {look.place.x + look.place.width, look.place.y + look.place.height},
                                              ImGui::GetColorU32(ImGuiCol_SliderGrab));
    tooltip("Drag: size of the panel. Double click: automatic size.");
    PanelChoice& choice = model.window().panels;
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    constexpr float kDragPixels = 2.0f;  // a click moves nothing
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        choice = free_border(choice, look.border);
    else if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, kDragPixels))
        choice = drag_border(choice, look.border, {pointer.x, pointer.y}, layout, em(1.0f));
}

bool draw_fold_part(const Rect& place, const FoldLook& fold) {
    const bool is_pressed = put_control(fold.label, place);
    note_place(fold.label);
    const bool is_hovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({place.x, place.y}, {place.x + place.width, place.y + place.height},
                       ImGui::GetColorU32(is_hovered ? ImGuiCol_ButtonHovered : ImGuiCol_Button));
    draw_arrow(list, place, fold.direction, is_hovered ? colors::kText : colors::kFaint);
    tooltip(fold.tip);
    return is_pressed;
}

/// The arrows lie in the middle of the border, and parts to drag at both sides of them. Returns the pressed arrow, -1
/// without one.
int draw_border(ViewerModel& model, const Layout& layout, const BorderLook& look, std::span<const FoldLook> folds) {
    const float length = look.is_upright() ? look.place.height : look.place.width;
    if (length <= 0.0f) return -1;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetColorU32(ImGuiCol_MenuBarBg));
    begin_fixed_window(look.label, look.place, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    const float arrow = std::min(em(kArrowEm), length / static_cast<float>(folds.size() + 1));
    const float arrows = arrow * static_cast<float>(folds.size());
    const float first = std::round(0.5f * (length - arrows));
    if (look.drags) {
        draw_drag_part(model, layout, look, part_of(look, first + arrows, length - first - arrows), "second part");
        draw_drag_part(model, layout, look, part_of(look, 0.0f, first), "first part");
    }
    int pressed = -1;
    for (std::size_t i = 0; i < folds.size(); ++i)
        if (draw_fold_part(part_of(look, first + arrow * static_cast<float>(i), arrow), folds[i]))
            pressed = static_cast<int>(i);
    ImGui::End();
    return pressed;
}

void draw_accuracy_border(ViewerModel& model, const Layout& layout) {
    PanelChoice& choice = model.window().panels;
    const BorderLook look{Border::Accuracy, layout.accuracy_border,
                          layout.right.height > 0.0f && layout.accuracy.height > 0.0f,
                          "border of the accuracy panel"};
    // Without the tabs the only way is down, without the accuracy panel the only one is up.
    if (!choice.accuracy) {
        const FoldLook open{"open the accuracy panel", "Opens the accuracy panel (P).", ImGuiDir_Up};
        if (draw_border(model, layout, look, {&open, 1}) == 0) choice.accuracy = true;
    } else if (!choice.tabs) {
        const FoldLook open{"open the tabs", "Opens the tabs.", ImGuiDir_Down};
        if (draw_border(model, layout, look, {&open, 1}) == 0) choice.tabs = true;
    } else {
        const FoldLook folds[] = {{"fold the tabs", "Folds the tabs above.", ImGuiDir_Up},
                                  {"fold the accuracy panel", "Folds the accuracy panel (P).", ImGuiDir_Down}};
        const int pressed = draw_border(model, layout, look, folds);
        if (pressed == 0) choice.tabs = false;
        if (pressed == 1) choice.accuracy = false;
    }
}

}  // namespace

void draw_borders(ViewerModel& model, const Layout& layout) {
    PanelChoice& choice = model.window().panels;
    const bool had_settings = choice.shows_settings(layout.one_side);
    const bool had_right = choice.shows_right(layout.one_side);
    const FoldLook settings{had_settings ? "fold the settings" : "open the settings",
                            had_settings ? "Folds the settings (F6)." : "Opens the settings (F6).",
                            had_settings ? ImGuiDir_Left : ImGuiDir_Right};
    const FoldLook right{had_right ? "fold the right side" : "open the right side",
                         had_right ? "Folds tabs and accuracy panel (F7)." : "Opens tabs and accuracy panel (F7).",
                         had_right ? ImGuiDir_Right : ImGuiDir_Left};
    const BorderLook at_left{Border::Settings, layout.settings_border, had_settings, "border of the settings"};
    const BorderLook at_right{Border::Right, layout.right_border, had_right, "border of the right side"};
    if (draw_border(model, layout, at_left, {&settings, 1}) == 0) choice.toggle_settings(layout.one_side);
    if (draw_border(model, layout, at_right, {&right, 1}) == 0) choice.toggle_right(layout.one_side);
    draw_accuracy_border(model, layout);
}

}  // namespace pl::ui
