#include "ui/draw/gui_memory.h"

#include "ui/draw/imgui_compat.h"

namespace pl {

GuiMemory& gui_memory() { return *static_cast<GuiMemory*>(ImGui::GetIO().UserData); }

}  // namespace pl
