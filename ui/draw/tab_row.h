// A row of tabs.
#pragma once

#include "ui/draw/imgui_draw.h"

namespace pl::ui {

/// Tabs in as many rows as their whole titles need. The one in front is remembered by the window that they are in; where it is not
/// added any more, the first is.
class TabRow {
public:
    explicit TabRow(const char* id);
    bool shows(const char* title) const { return chosen_ == ImGui::GetID(title); }
    /// Brings a tab to the front.
    void choose(const char* title) { chosen_ = ImGui::GetID(title); }
    /// The next tab; true if it is in front: then draw its content after end().
    bool add(const char* title);
    void end();

private:
    ImGuiID key_;
    ImGuiID chosen_;
    float end_;  ///< of a row, in the window
    ImGuiID first_ = 0;
    bool is_found_ = false;
};

}  // namespace pl::ui
