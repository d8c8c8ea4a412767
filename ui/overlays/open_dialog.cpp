#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "ui/draw/gui_memory.h"
#include "ui/draw/picture_textures.h"
#include "ui/draw/widgets.h"
#include "ui/overlays/dialog.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

/// After a Selectable that a click chooses and a double click opens.
void answer_click(OpenDialog& dialog, const std::string& name, bool clicked) {
    if (!clicked) return;
    dialog.choice() = name;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) dialog.open(name);
}

void draw_choice(OpenDialog& dialog, const std::string& name, const std::string& shown, const char* place) {
    ImGui::PushID(name.c_str());
    const bool clicked =
        ImGui::Selectable(shown.c_str(), dialog.choice() == name, ImGuiSelectableFlags_AllowDoubleClick);
    note_place((place + shown).c_str());
    answer_click(dialog, name, clicked);
    ImGui::PopID();
}

/// A picture with its name below, in the rectangle from `low` to `high`.
void draw_picture(const std::string& name, const std::shared_ptr<const ByteImage>& picture, ImVec2 low, ImVec2 high) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 corner{high.x, high.y - ImGui::GetTextLineHeight() - em(0.2f)};
    SDL_Texture* const texture = picture ? gui_memory().textures->of(picture) : nullptr;
    if (texture != nullptr)
        list.AddImage(to_texture_id(texture), low, corner);
    else
        list.AddRectFilled(low, corner, colors::kBadge);
    list.AddText({low.x, corner.y + em(0.1f)}, colors::kText, name.c_str());
}

/// All known scenes, as many in a row as fit.
void draw_gallery(OpenDialog& dialog, ImVec2 size) {
    ImGui::BeginChild("scenes", size, true);
    const float gap = em(0.6f);
    const float room = ImGui::GetContentRegionAvail().x;
    const int columns = std::max(static_cast<int>((room + gap) / (em(8.0f) + gap)), 1);
    const float width = std::floor((room + gap) / static_cast<float>(columns) - gap);
    const float height = std::floor(0.75f * width) + ImGui::GetTextLineHeight() + em(0.2f);
    int column = 0;
    for (const std::string& name : dialog.scenes()) {
        ImGui::PushID(name.c_str());
        if (column > 0) ImGui::SameLine(0.0f, gap);
        const ImVec2 low = ImGui::GetCursorScreenPos();
        const bool clicked = ImGui::Selectable("##scene", dialog.choice() == name,
                                               ImGuiSelectableFlags_AllowDoubleClick, {width, height});
        note_place(("open: " + name).c_str());
        draw_picture(name, dialog.gallery().picture(name), low, {low.x + width, low.y + height});
        answer_click(dialog, name, clicked);
        column = (column + 1) % columns;
        ImGui::PopID();
    }
    ImGui::EndChild();
}

void draw_recent(OpenDialog& dialog, const RecentFiles& recent, ImVec2 size) {
    ImGui::BeginChild("recent", size, true);
    faint_text("Opened last");
    for (const std::string& name : recent.names()) {
        draw_choice(dialog, name, std::filesystem::path(name).filename().string(), "recent: ");
        tooltip(name.c_str());
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
    for (const std::string& name : listing.files)
        draw_choice(dialog, (listing.folder / name).string(), name, "file: ");
    if (listing.files.empty()) faint_text("no .obj, .gltf, .glb, .xml, .json or .field here");
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

void draw_hint(const OpenDialog& dialog) {
    if (dialog.gallery().is_working())
        faint_text(
            fmt::format("Rendering pictures of the scenes, {} of {}; the picture in the window rests meanwhile.",
                        dialog.gallery().size(), dialog.scenes().size())
                .c_str());
    else
        faint_text("A double click or Enter opens, Esc closes. Files can also be dropped on the window.");
}

}  // namespace

void draw_open_dialog(ViewerModel& model, const Layout& layout) {
    OpenDialog& dialog = model.open_dialog();
    if (!dialog.is_shown()) return;
    begin_dialog("Open a scene", dialog.is_shown(), layout, em(54.0f));
    const float height = std::clamp(screen_size(layout).y - em(12.0f), em(8.0f), em(27.0f));
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = ImGui::GetContentRegionAvail().x - gap;
    draw_gallery(dialog, {0.6f * width, height});
    ImGui::SameLine();
    ImGui::BeginGroup();
    const float part = 0.4f * (height - ImGui::GetStyle().ItemSpacing.y);
    draw_recent(dialog, model.scene().recent(), {0.4f * width, part});
    draw_files(dialog, {0.4f * width, height - part - ImGui::GetStyle().ItemSpacing.y});
    ImGui::EndGroup();
    draw_field(dialog);
    draw_hint(dialog);
    ImGui::End();
}

}  // namespace pl::ui
