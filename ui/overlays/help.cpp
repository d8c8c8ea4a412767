#include <algorithm>

#include "ui/actions.h"
#include "ui/overlays/overlays.h"

namespace pl {
namespace {

constexpr float kKeysEm = 7.5f;

/// A key as a cap, so that a comma can be seen.
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
    ImGui::TextUnformatted(text);
}

void draw_heading(const char* text) {
    ImGui::TextColored(to_vec4(colors::kFaint), "%s", text);
    ImGui::Separator();
}

void draw_group(ActionGroup group) {
    draw_heading(name_of(group));
    for (const Action& action : all_actions())
        if (action.group == group) draw_line(action.keys, action.text);
    ImGui::Dummy({0.0f, em(0.3f)});
}

}  // namespace

void draw_help(ViewerModel& model, const Layout& layout) {
    if (!model.window().help) return;
    const float screen_width = layout.panels ? layout.menu.width : layout.view.width;
    const float screen_height = layout.panels ? layout.status.y + layout.status.height : layout.view.height;
    ImGui::SetNextWindowPos({0.5f * screen_width, 0.5f * screen_height}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(em(56.0f), screen_width - em(2.0f)), 0.0f});
    ImGui::SetNextWindowFocus();
    ImGui::Begin("Keys", &model.window().help,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
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

}  // namespace pl
