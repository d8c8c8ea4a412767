#include "ui/draw/tab_row.h"

#include "ui/draw/style.h"
#include "ui/draw/widgets.h"

namespace pl::ui {
namespace {

constexpr float kTabPaddingEm = 0.22f;  ///< beside a tab's title: all of them in one row of the standard width

}  // namespace

TabRow::TabRow(const char* id)
    : key_(ImGui::GetID(id)), chosen_(static_cast<ImGuiID>(ImGui::GetStateStorage()->GetInt(key_))),
      end_(ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x) {}

bool TabRow::add(const char* title) {
    const ImGuiID tab = ImGui::GetID(title);
    if (first_ == 0) {
        first_ = tab;
    } else {
        const float width = ImGui::CalcTextSize(title).x + 2.0f * em(kTabPaddingEm);
        const float start = ImGui::GetItemRectMax().x + em(0.25f);
        if (start + width <= end_) ImGui::SameLine(0.0f, em(0.25f));
    }
    const bool was_front = tab == chosen_;
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetColorU32(was_front ? ImGuiCol_ButtonActive : ImGuiCol_Button));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {em(kTabPaddingEm), ImGui::GetStyle().FramePadding.y});
    if (ImGui::Button(title)) chosen_ = tab;
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    note_place(title);
    is_found_ = is_found_ || tab == chosen_;
    return was_front;
}

void TabRow::end() {
    if (!is_found_) chosen_ = first_;
    ImGui::GetStateStorage()->SetInt(key_, static_cast<int>(chosen_));
    ImGui::Separator();
}

}  // namespace pl::ui
