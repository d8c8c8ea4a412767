#include <algorithm>

#include "ui/draw/widgets.h"
#include "ui/input/actions.h"
#include "ui/overlays/dialog.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

constexpr float kKeysEm = 7.5f;

/// A key on a key cap, so that a comma is visible.
void draw_line(const char* keys, const char* text) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::CalcTextSize(keys).x + em(0.6f), em(1.3f));
    const float height = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y - 1.0f},
                                              {corner.x + width, corner.y + height + 1.0f}, IM_COL32(50, 57, 70, 255),
                                              em(0.2f));
    ImGui::SetCursorScreenPos({corner.x + 0.5f * (width - ImGui::CalcTextSize(keys).x), corner.y});
    ImGui::TextColored(to_vec4(colors::kAccent), "%s", keys);
    ImGui::SameLine(em(kKeysEm));
    ImGui::TextWrapped("%s", text);
    note_place(text);
}

void draw_heading(const char* text) {
    ImGui::TextColored(to_vec4(colors::kFaint), "%s", text);
    ImGui::Separator();
}

void draw_group(ActionGroup group) {
    draw_heading(name_of(group));
    for (const Action& action : all_actions())
        if (action.group == group) draw_line(action.keys.c_str(), action.text.c_str());
    ImGui::Dummy({0.0f, em(0.3f)});
}

}  // namespace

void draw_help(ViewerModel& model, const Layout& layout) {
    if (!model.window().help) return;
    ImGui::SetNextWindowFocus();
    begin_dialog("Keys", model.window().help, layout, em(56.0f));
    if (ImGui::BeginTable("columns", 2, ImGuiTableFlags_SizingStretchSame)) {
        ImGui::TableNextColumn();
        draw_group(ActionGroup::Fly);
        draw_heading("Mouse");
        for (const MouseAction& action : mouse_actions()) draw_line(action.keys, action.text);
        ImGui::Dummy({0.0f, em(0.3f)});
        draw_group(ActionGroup::Compare);
        draw_group(ActionGroup::Window);
        ImGui::TableNextColumn();
        draw_group(ActionGroup::Render);
        draw_group(ActionGroup::Method);
        draw_group(ActionGroup::View);
        draw_group(ActionGroup::Overlay);
        draw_group(ActionGroup::File);
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace pl::ui
