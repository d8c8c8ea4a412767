#include "ui/overlays/dialogs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "ui/draw/imgui_draw.h"
#include "ui/draw/stream_texture.h"
#include "ui/draw/style.h"
#include "ui/draw/widgets.h"
#include "ui/input/actions.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {

Vec2f screen_size(const Layout& layout) {
    if (!layout.panels) return {layout.view.width, layout.view.height};
    return {layout.menu.width, layout.status.y + layout.status.height};
}

void begin_dialog(const char* name, bool& open, const Layout& layout, float width) {
    const Vec2f screen = screen_size(layout);
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(width, screen.x - em(2.0f)), 0.0f});
    ImGui::Begin(name, &open,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings);
}

namespace {

constexpr float kKeysEm = 7.5f;

/// A key on a key cap, so that a comma is visible.
void draw_line(const char* keys, const char* text) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::CalcTextSize(keys).x + em(0.6f), em(1.3f));
    const float height = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y - 1.0f},
                                              {corner.x + width, corner.y + height + 1.0f},
                                              ImGui::GetColorU32(ImGuiCol_Button), em(0.2f));
    ImGui::SetCursorScreenPos({corner.x + 0.5f * (width - ImGui::CalcTextSize(keys).x), corner.y});
    ImGui::TextColored(to_vec4(colors::kAccent), "%s", keys);
    ImGui::SameLine(em(kKeysEm));
    wrapped_text(text);
    note_place(text);
}

void draw_heading(const char* text) {
    ImGui::TextColored(to_vec4(colors::kFaint), "%s", text);
    ImGui::Separator();
}

void draw_group(ActionGroup group) {
    draw_heading(name_of(group));
    for (const Action& action : all_actions())
        if (action.group == group) draw_line(action.keys.c_str(), action.text.c_str());
    ImGui::Dummy({0.0f, em(0.3f)});
}

}  // namespace

void draw_help(ViewerModel& model, const Layout& layout) {
    if (!model.window().help) return;
    ImGui::SetNextWindowFocus();
    begin_dialog("Keys", model.window().help, layout, em(56.0f));
    const int columns = ImGui::GetContentRegionAvail().x >= em(4.0f * kKeysEm) ? 2 : 1;
    if (ImGui::BeginTable("columns", columns, ImGuiTableFlags_SizingStretchSame)) {
        ImGui::TableNextColumn();
        draw_group(ActionGroup::Fly);
        draw_heading("Mouse");
        for (const MouseAction& action : mouse_actions()) draw_line(action.keys, action.text);
        ImGui::Dummy({0.0f, em(0.3f)});
        draw_group(ActionGroup::Compare);
        draw_group(ActionGroup::Window);
        ImGui::TableNextColumn();
        draw_group(ActionGroup::Render);
        draw_group(ActionGroup::Method);
        draw_group(ActionGroup::View);
        draw_group(ActionGroup::Overlay);
        draw_group(ActionGroup::File);
        draw_group(ActionGroup::Help);
        ImGui::EndTable();
    }
    ImGui::End();
}

void draw_about(ViewerModel& model, const Layout& layout) {
    if (!model.window().about) return;
    ImGui::SetNextWindowFocus();
    begin_dialog("About pathlight", model.window().about, layout, em(32.0f));
    text_line("pathlight " PL_VERSION, colors::kAccent);
    text_line("Renders pictures while it learns from which directions light arrives, beside what happens without.",
              colors::kText);
    faint_text(
        "docs/manual.md describes the window and all options, docs/idea.md what is learned and why. LICENSE and "
        "THIRD-PARTY.md say what may be done with it.");
    ImGui::End();
}

namespace {

std::string margin_text(const SelfCheck& check) {
    if (check.tolerance <= 0.0) return "exact";
    return std::isfinite(check.used_share) ? fmt::format("{:.0f} % used", 100.0 * check.used_share) : "none";
}

void draw_check(const SelfCheck& check) {
    ImGui::TableNextRow();
    text_cell(check.passed ? "ok" : "FAILED", check.passed ? colors::kGood : colors::kError);
    text_cell(check.backend, colors::kFaint);
    text_cell(check.name);
    tooltip(check.criterion.c_str());
    text_cell(fmt::format("{:.6g}", check.expected));
    text_cell(fmt::format("{:.6g}", check.measured), check.passed ? colors::kText : colors::kError);
    text_cell(margin_text(check), colors::kFaint);
    tooltip("The deviation as a share of the tolerance; exact: no deviation is allowed.");
}

void draw_checks(const std::vector<SelfCheck>& checks, float height) {
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
    if (!ImGui::BeginTable("checks", 6, kFlags, {0.0f, height})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("");
    ImGui::TableSetupColumn("back end");
    ImGui::TableSetupColumn("check", ImGuiTableColumnFlags_WidthStretch);
    for (const char* title : {"expected", "measured", "margin"}) ImGui::TableSetupColumn(title);
    ImGui::TableHeadersRow();
    for (const SelfCheck& check : checks) draw_check(check);
    // Scrolls to new checks unless the user has scrolled up.
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1.0f);
    ImGui::EndTable();
}

ImU32 color_of(SelfTestRun::Outcome outcome) {
    switch (outcome) {
    case SelfTestRun::Outcome::Failed:
    case SelfTestRun::Outcome::Broken: return colors::kError;
    case SelfTestRun::Outcome::Passed: return colors::kGood;
    case SelfTestRun::Outcome::Stopped: return colors::kWarning;
    case SelfTestRun::Outcome::None:
    case SelfTestRun::Outcome::Running: break;
    }
    return colors::kText;
}

void draw_button(ViewerModel& model) {
    const SelfTestRun& test = model.self_test().run();
    const char* label =
        test.is_running() ? "Cancel" : (test.outcome() == SelfTestRun::Outcome::None ? "Run" : "Again");
    if (ImGui::Button(label, {em(6.0f), 0.0f})) {
        if (test.is_running())
            model.self_test().stop();
        else
            model.self_test().start();
    }
    note_place("self test");
    ImGui::SameLine();
    text_line(test.summary().c_str(), color_of(test.outcome()));
}

}  // namespace

void draw_self_test(ViewerModel& model, const Layout& layout) {
    if (!model.self_test().is_shown()) return;
    begin_dialog("Self test", model.self_test().is_shown(), layout, em(58.0f));
    faint_text("Renders small scenes with closed-form solutions on every available back end, as 'pathlight selftest' "
               "does. It "
               "takes about ten seconds per back end; rendering rests meanwhile.");
    draw_button(model);
    draw_checks(model.self_test().run().checks(), std::min(em(26.0f), screen_size(layout).y - em(14.0f)));
    ImGui::End();
}

namespace {

/// Enter on the control that arrows have reached: newer versions of Dear ImGui count it as a click themselves.
bool is_entered() {
#if IMGUI_VERSION_NUM < 18700
    return ImGui::IsItemFocused() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
#else
    return false;
#endif
}

/// After a Selectable that a click chooses, and that a double click or a key opens.
void answer_click(OpenDialog& dialog, const std::string& name, bool clicked) {
    if (!clicked && !is_entered()) return;
    dialog.choice() = name;
    const bool is_pointer =
        ImGui::IsMouseReleased(ImGuiMouseButton_Left) || ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    if (!is_pointer || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) dialog.open(std::string(name));
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
void draw_card(const std::string& name, const SceneCard* card, ImVec2 low, ImVec2 high) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 corner{high.x, high.y - ImGui::GetTextLineHeight() - em(0.2f)};
    SDL_Texture* const texture = card != nullptr ? gui_memory().textures->of(card->picture) : nullptr;
    if (texture != nullptr)
        list.AddImage(to_texture_id(texture), low, corner);
    else
        list.AddRectFilled(low, corner, colors::kBadge);
    list.AddText({low.x, corner.y + em(0.1f)}, colors::kText, name.c_str());
}

/// All known scenes, as many in a row as fit. Returns the one under the pointer, else the chosen one.
std::string draw_gallery(OpenDialog& dialog, ImVec2 size) {
    begin_part("scenes", size);
    const float gap = em(0.6f);
    const float room = ImGui::GetContentRegionAvail().x;
    const int columns = std::max(static_cast<int>((room + gap) / (em(7.0f) + gap)), 1);
    const float width = std::floor((room + gap) / static_cast<float>(columns) - gap);
    const float height = width + ImGui::GetTextLineHeight() + em(0.2f);
    std::string looked_at = dialog.choice();
    int column = 0;
    for (const std::string& name : dialog.scenes()) {
        ImGui::PushID(name.c_str());
        if (column > 0) ImGui::SameLine(0.0f, gap);
        const ImVec2 low = ImGui::GetCursorScreenPos();
        const bool clicked = ImGui::Selectable("##scene", dialog.choice() == name,
                                               ImGuiSelectableFlags_AllowDoubleClick, {width, height});
        note_place(("open: " + name).c_str());
        if (ImGui::IsItemHovered()) looked_at = name;
        draw_card(name, dialog.card(name), low, {low.x + width, low.y + height});
        answer_click(dialog, name, clicked);
        column = (column + 1) % columns;
        ImGui::PopID();
    }
    ImGui::EndChild();
    return looked_at;
}

void draw_recent(OpenDialog& dialog, const RecentFiles& recent, ImVec2 size) {
    begin_part("recent", size);
    faint_text("Opened last");
    for (const std::string& name : recent.names()) {
        draw_choice(dialog, name, std::filesystem::path(name).filename().string(), "recent: ");
        tooltip(name.c_str());
    }
    ImGui::EndChild();
}

void draw_files(OpenDialog& dialog, ImVec2 size) {
    begin_part("files", size);
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
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputTextWithHint("##choice", "scene, file or folder", text.data(), text.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    note_place("open: field");
    if (entered) ImGui::SetKeyboardFocusHere(-1);  // for the next name, if this one opens nothing
    dialog.choice() = text.data();
    ImGui::SameLine();
    if (ImGui::Button("Open", {-1.0f, 0.0f}) || entered) dialog.open(std::string(dialog.choice()));
    note_place("open: button");
}

/// Two lines high, so that no button moves.
void draw_hint(const SceneCard* card, const std::string& scene) {
    const float top = ImGui::GetCursorPosY();
    if (card != nullptr)
        faint_text((scene + ": " + card->summary).c_str());
    else
        faint_text("A double click or Enter opens, Esc closes. Files can also be dropped on the window.");
    ImGui::SetCursorPosY(top + 2.0f * ImGui::GetTextLineHeightWithSpacing());
    ImGui::Dummy({0.0f, 0.0f});
}

}  // namespace

void draw_open_dialog(ViewerModel& model, const Layout& layout) {
    OpenDialog& dialog = model.open_dialog();
    if (!dialog.is_shown()) return;
    begin_dialog("Open a scene", dialog.is_shown(), layout, em(54.0f));
    const float height = std::clamp(screen_size(layout).y - em(12.0f), em(8.0f), em(27.0f));
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = ImGui::GetContentRegionAvail().x - gap;
    const std::string looked_at = draw_gallery(dialog, {0.6f * width, height});
    ImGui::SameLine();
    ImGui::BeginGroup();
    const float part = 0.4f * (height - ImGui::GetStyle().ItemSpacing.y);
    draw_recent(dialog, model.scene().recent(), {0.4f * width, part});
    draw_files(dialog, {0.4f * width, height - part - ImGui::GetStyle().ItemSpacing.y});
    ImGui::EndGroup();
    draw_field(dialog);
    draw_hint(dialog.card(looked_at), looked_at);
    ImGui::End();
}

}  // namespace pl::ui
