#include "ui/gui_memory.h"

#include "ui/imgui_compat.h"

namespace pl {

GuiMemory& gui_memory() { return *static_cast<GuiMemory*>(ImGui::GetIO().UserData); }

}  // namespace pl
