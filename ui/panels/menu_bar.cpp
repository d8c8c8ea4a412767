#include <cctype>

#include <fmt/format.h>

#include "ui/draw/widgets.h"
#include "ui/input/perform_action.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

void draw_recent_menu(ViewerModel& model) {
    if (!ImGui::BeginMenu("Open recent")) return;
    const std::vector<std::string> names = model.scene().recent().names();
    for (const std::string& name : names)
        if (ImGui::MenuItem(name.c_str())) model.scene().open(name);
    ImGui::EndMenu();
}

/// One menu per group of the key table, without the held keys.
void draw_group(ViewerModel& model, ActionGroup group) {
    const bool is_open = ImGui::BeginMenu(name_of(group));
    note_place(fmt::format("menu {}", name_of(group)).c_str());
    if (!is_open) return;
    for (const Action& action : all_actions()) {
        if (action.group != group || action.is_held) continue;
        std::string label = action.text;
        label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
        if (ImGui::MenuItem(label.c_str(), action.keys.c_str())) perform(model, action);
        note_place(action.text.c_str());
    }
    if (group == ActionGroup::File) draw_recent_menu(model);
    ImGui::EndMenu();
}

}  // namespace

void draw_menu_bar(ViewerModel& model, const Layout& layout) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em(0.4f), 0.0f});
    begin_fixed_window("menu", layout.menu, ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoScrollbar);
    ImGui::PopStyleVar();
    if (ImGui::BeginMenuBar()) {
        draw_group(model, ActionGroup::File);
        draw_group(model, ActionGroup::Render);
        draw_group(model, ActionGroup::Method);
        draw_group(model, ActionGroup::View);
        draw_group(model, ActionGroup::Overlay);
        draw_group(model, ActionGroup::Compare);
        draw_group(model, ActionGroup::Fly);
        draw_group(model, ActionGroup::Window);
        const std::string title = model.title();
        const float start = ImGui::GetWindowWidth() - ImGui::CalcTextSize(title.c_str()).x - em(1.0f);
        if (start > ImGui::GetCursorPosX()) {  // a narrow window has it in its title bar only
            ImGui::SameLine(start);
            ImGui::TextDisabled("%s", title.c_str());
        }
        ImGui::EndMenuBar();
    }
    ImGui::End();
}

}  // namespace pl::ui
