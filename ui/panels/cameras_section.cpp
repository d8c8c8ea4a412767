#include <algorithm>

#include <fmt/format.h>

#include "ui/draw/gui_memory.h"
#include "ui/draw/picture_textures.h"
#include "ui/draw/widgets.h"
#include "ui/input/perform_action.h"
#include "ui/model/thumbnail.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

struct BookmarkEdit {
    std::optional<std::size_t> removed;
    std::optional<std::size_t> moved;
    int places = 0;
};

void draw_picture(const CameraBookmarks::Bookmark& bookmark, std::size_t index, bool is_current, ImVec2 low,
                  ImVec2 high) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    PictureTextures* const textures = gui_memory().textures;  // null without a window
    SDL_Texture* const texture = textures != nullptr && bookmark.picture ? textures->of(bookmark.picture) : nullptr;
    if (texture != nullptr)
        list.AddImage(to_texture_id(texture), low, high);
    else
        list.AddRectFilled(low, high, colors::kBadge);
    const std::string number = fmt::format("{}", index + 1);
    const ImVec2 size = ImGui::CalcTextSize(number.c_str());
    list.AddRectFilled(low, {low.x + size.x + em(0.4f), low.y + size.y}, colors::kBadge);
    list.AddText({low.x + em(0.2f), low.y}, colors::kText, number.c_str());
    if (is_current) list.AddRect(low, high, colors::kAccent, 0.0f, 0, 2.0f);
}

void draw_menu(std::size_t index, std::size_t count, BookmarkEdit& edit) {
    if (!ImGui::BeginPopupContextItem("bookmark menu")) return;
    const auto move_item = [&](const char* label, int places, bool is_possible) {
        if (!ImGui::MenuItem(label, nullptr, false, is_possible)) return;
        edit.moved = index;
        edit.places = places;
    };
    move_item("One place earlier", -1, index > 0);
    move_item("One place later", 1, index + 1 < count);
    if (ImGui::MenuItem("Remove")) edit.removed = index;
    ImGui::EndPopup();
}

/// All bookmarks, three in a row.
void draw_bookmarks(ViewerModel& model) {
    constexpr int kColumns = 3;
    CameraBookmarks& bookmarks = model.bookmarks();
    const float gap = em(0.3f);
    const float width = std::floor((ImGui::GetContentRegionAvail().x + gap) / kColumns - gap);
    const float height = std::floor(width * kThumbnailHeight / kThumbnailWidth);
    BookmarkEdit edit;
    std::optional<std::size_t> shown;
    for (std::size_t i = 0; i < bookmarks.list().size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (i % kColumns > 0) ImGui::SameLine(0.0f, gap);
        const ImVec2 low = ImGui::GetCursorScreenPos();
        if (ImGui::InvisibleButton("bookmark", {width, height})) shown = i;
        note_place(fmt::format("bookmark {}", i + 1).c_str());
        tooltip("A click shows it, a right click moves or removes it.");
        draw_menu(i, bookmarks.list().size(), edit);
        draw_picture(bookmarks.list()[i], i, bookmarks.current() == i, low, {low.x + width, low.y + height});
        ImGui::PopID();
    }
    if (shown) bookmarks.show(*shown);
    if (edit.moved) bookmarks.move(*edit.moved, edit.places);
    if (edit.removed) bookmarks.remove(*edit.removed);
}

void draw_sequence(ViewerModel& model) {
    SequenceWriter& sequence = model.sequence();
    SequenceWriter::Options& options = sequence.options();
    if (int_row("Frames", "Pictures from the first bookmark to the last.", &options.frames, 24))
        options.frames = std::clamp(options.frames, 2, 1000000);
    if (int_row("Samples each", "Samples per pixel of a frame. 0: no limit.", &options.spp, 64, "no limit"))
        options.spp = std::clamp(options.spp, 0, 1000000000);
    double seconds = static_cast<double>(options.seconds);
    if (double_row("Seconds each", "Work for a frame; the first limit ends it. 0: no limit.", &seconds, 1.0, "%.1f",
                   "no limit"))
        options.seconds = static_cast<float>(std::max(seconds, 0.0));
    choice_row("Files", "Kind of the pictures.", &options.kind);
    const bool is_writing = sequence.progress().has_value();
    if (wide_button(
            is_writing ? "Stop writing" : "Write the path as pictures",
            "Frame by frame, in the window; learning goes on between them. Esc stops, and the frames so far stay.")) {
        if (is_writing)
            sequence.stop();
        else
            sequence.begin();
    }
    note_place("write path");
}

}  // namespace

void draw_cameras(ViewerModel& model) {
    if (!section("Bookmarks", false)) return;
    draw_bookmarks(model);
    if (wide_button("Bookmark the camera",
                    "F8; F9 and Shift+F9 step through them. They belong to this scene, and stay."))
        perform(model, ActionId::AddBookmark);
    note_place("add bookmark");
    if (model.bookmarks().list().size() < CameraPath::kFewest)
        return faint_text("Two bookmarks or more are a path to fly along.");
    float seconds = model.flight().seconds_per_camera();
    if (slider_row("Seconds", "From each bookmark to the next, when the path is played.", &seconds,
                   {0.2f, 20.0f, 2.0f, "%.1f s", ImGuiSliderFlags_Logarithmic}))
        model.flight().seconds_per_camera() = seconds;
    if (wide_button(model.flight().is_flying() ? "Stop" : "Fly along the path", "F10"))
        perform(model, ActionId::PlayPath);
    note_place("fly path");
    draw_sequence(model);
}

}  // namespace pl::ui
