#include "ui/draw/gui_memory.h"
#include "ui/draw/widgets.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {

void draw_show_panels(ViewerModel& model) {
    constexpr float kShownSeconds = 2.0f;
    if (gui_memory().pointer_rest_seconds > kShownSeconds) return;
    ImGui::SetNextWindowPos({em(0.6f), em(0.6f)});
    ImGui::SetNextWindowBgAlpha(0.8f);
    ImGui::Begin("show panels", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
    if (ImGui::Button("Show the panels (Tab)")) model.window().panels.shown = true;
    note_place("show the panels");
    ImGui::End();
}

}  // namespace pl::ui
