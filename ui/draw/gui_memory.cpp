#include "ui/draw/gui_memory.h"

#include "ui/draw/imgui_compat.h"

namespace pl::ui {

void create_gui_context(GuiMemory& memory) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.UserData = &memory;
}

GuiMemory& gui_memory() { return *static_cast<GuiMemory*>(ImGui::GetIO().UserData); }

}  // namespace pl::ui
