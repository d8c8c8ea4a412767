#include <algorithm>
#include <array>
#include <cstdio>

#include "ui/draw/widgets.h"
#include "ui/overlays/dialog.h"
#include "ui/overlays/overlays.h"

namespace pl {
namespace {

/// A line that a click chooses and a double click opens.
void draw_choice(OpenDialog& dialog, const std::string& name, const std::string& shown) {
    const bool clicked =
        ImGui::Selectable(shown.c_str(), dialog.choice() == name, ImGuiSelectableFlags_AllowDoubleClick);
    note_place(("open: " + shown).c_str());
    if (!clicked) return;
    dialog.choice() = name;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) dialog.open(name);
}

void draw_scenes(OpenDialog& dialog, ImVec2 size) {
    ImGui::BeginChild("scenes", size, true);
    faint_text("Scenes");
    for (const std::string& name : dialog.scenes()) draw_choice(dialog, name, name);
    ImGui::EndChild();
}

void draw_recent(OpenDialog& dialog, const RecentFiles& recent, ImVec2 size) {
    ImGui::BeginChild("recent", size, true);
    faint_text("Recent");
    for (const std::string& name : recent.names()) {
        ImGui::PushID(name.c_str());
        draw_choice(dialog, name, std::filesystem::path(name).filename().string());
        tooltip(name.c_str());
        ImGui::PopID();
    }
    ImGui::EndChild();
}

void draw_files(OpenDialog& dialog, ImVec2 size) {
    ImGui::BeginChild("files", size, true);
    const FolderListing& listing = dialog.listing();
    faint_text(listing.folder.string().c_str());
    std::filesystem::path entered;
    if (ImGui::Selectable("../")) entered = listing.folder.parent_path();
    for (const std::string& name : listing.folders)
        if (ImGui::Selectable((name + "/").c_str())) entered = listing.folder / name;
    for (const std::string& name : listing.files) draw_choice(dialog, (listing.folder / name).string(), name);
    if (listing.files.empty()) faint_text("no .obj, .json or .field here");
    ImGui::EndChild();
    if (!entered.empty()) dialog.browse(entered);
}

/// The chosen name, which can be typed.
void draw_field(OpenDialog& dialog) {
    std::array<char, 4096> text{};
    std::snprintf(text.data(), text.size(), "%s", dialog.choice().c_str());
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - em(6.5f));
    const bool entered = ImGui::InputTextWithHint("##choice", "scene, file or folder", text.data(), text.size(),
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    note_place("open: field");
    dialog.choice() = text.data();
    ImGui::SameLine();
    if (ImGui::Button("Open", {-1.0f, 0.0f}) || entered) dialog.open(std::string(dialog.choice()));
    note_place("open: button");
}

}  // namespace

void draw_open_dialog(ViewerModel& model, const Layout& layout) {
    OpenDialog& dialog = model.open_dialog();
    if (!dialog.is_shown()) return;
    begin_dialog("Open a scene", dialog.is_shown(), layout, em(54.0f));
    const float height = std::clamp(screen_size(layout).y - em(12.0f), em(8.0f), em(27.0f));
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = ImGui::GetContentRegionAvail().x - 2.0f * gap;
    draw_scenes(dialog, {0.25f * width, height});
    ImGui::SameLine();
    draw_recent(dialog, model.scene().recent(), {0.25f * width, height});
    ImGui::SameLine();
    draw_files(dialog, {0.0f, height});
    draw_field(dialog);
    faint_text("A double click or Enter opens, Esc closes. Files can also be dropped on the window.");
    ImGui::End();
}

}  // namespace pl
