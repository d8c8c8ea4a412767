#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include <fmt/format.h>

#include "core/session/backend.h"
#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/input/perform_action.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

constexpr const char* kMore = "More";  ///< the menu of menus for which a bar has no room

void draw_recent_menu(ViewerModel& model) {
    if (!ImGui::BeginMenu("Open recent")) return;
    const std::vector<std::string> names = model.scene().recent().names();
    for (const std::string& name : names)
        if (ImGui::MenuItem(name.c_str())) model.scene().open(name);
    ImGui::EndMenu();
}

/// True if it was chosen. Scripts find it by its name, and by another one while it is marked.
bool menu_item(const std::string& label, const std::string& keys, bool is_marked, bool is_enabled,
               const std::string& name) {
    const bool is_chosen = ImGui::MenuItem(label.c_str(), keys.c_str(), is_marked, is_enabled);
    note_place(name.c_str());
    if (is_marked) note_place(("marked: " + name).c_str());
    return is_chosen;
}

void draw_views_menu(ViewerModel& model) {
    ImGui::Separator();
    for (const ViewInfo& view : all_views())
        if (menu_item(std::string(view.label), "", view.id == model.render().settings().view, true,
                      fmt::format("view: {}", view.label)))
            model.render().set_view(view.id);
}

/// Of undo and redo what they would do; empty if there is nothing to do. Other actions are what they are.
std::string menu_text(const ViewerModel& model, const Action& action) {
    const auto named = [](const char* verb, const std::string& change) {
        return change.empty() ? "" : verb + change;
    };
    if (action.id == ActionId::Undo) return named("undo ", model.history().undone_next());
    if (action.id == ActionId::Redo) return named("redo ", model.history().redone_next());
    return action.text;
}

/// One menu per group of the key table, without the held keys.
void draw_group(ViewerModel& model, ActionGroup group) {
    const bool is_open = ImGui::BeginMenu(name_of(group));
    note_place(fmt::format("menu {}", name_of(group)).c_str());
    if (!is_open) return;
    for (const Action& action : all_actions()) {
        if (action.group != group || action.is_held) continue;
        const std::string text = menu_text(model, action);
        std::string label = text.empty() ? action.text : text;
        label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
        if (action.id == ActionId::Quit) ImGui::Separator();
        if (menu_item(label, action.keys, is_on(model, action), !text.empty(), action.text)) perform(model, action);
        if (action.id == ActionId::Open) draw_recent_menu(model);
    }
    if (group == ActionGroup::View) draw_views_menu(model);
    ImGui::EndMenu();
}

/// How many of the menus fit into the bar, with room for one that holds the rest.
std::size_t fitting_menus(std::span<const ActionGroup> groups) {
    const auto width = [](const char* name) { return ImGui::CalcTextSize(name).x + ImGui::GetStyle().ItemSpacing.x; };
    const float room = ImGui::GetContentRegionAvail().x;
    float sum = 0.0f;
    std::size_t fit = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        sum += width(name_of(groups[i]));
        if (sum + width(kMore) <= room) fit = i + 1;
    }
    return sum <= room ? groups.size() : fit;
}

}  // namespace

void draw_menu_bar(ViewerModel& model, const Layout& layout) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em(0.4f), 0.0f});
    begin_fixed_window("menu", layout.menu, ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoScrollbar);
    ImGui::PopStyleVar();
    if (ImGui::BeginMenuBar()) {
        using enum ActionGroup;
        constexpr std::array kGroups{File, View, Render, Method, Overlay, Compare, Fly, Window, Help};
        const std::span groups(kGroups);
        const std::size_t fit = fitting_menus(groups);
        for (const ActionGroup group : groups.first(fit)) draw_group(model, group);
        const bool is_open = fit < groups.size() && ImGui::BeginMenu(kMore);
        if (fit < groups.size()) note_place("menu More");
        if (is_open) {
            for (const ActionGroup group : groups.subspan(fit)) draw_group(model, group);
            ImGui::EndMenu();
        }
        ImGui::EndMenuBar();
    }
    ImGui::End();
}

namespace {

/// Items in one line with bars between them.
class StatusLine {
public:
    /// True if it was clicked.
    bool add(const std::string& text, const char* tip, ImU32 color = colors::kText) {
        if (is_full_) return false;
        if (!first_) {
            const float needed = ImGui::CalcTextSize(text.c_str()).x + em(1.6f);
            is_full_ = ImGui::GetItemRectMax().x + needed > ImGui::GetWindowPos().x + ImGui::GetWindowWidth();
            if (is_full_) return false;
            ImGui::SameLine(0.0f, em(0.5f));
            ImGui::TextDisabled("|");
            ImGui::SameLine(0.0f, em(0.5f));
        }
        first_ = false;
        ImGui::BeginGroup();
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopStyleColor();
        // As wide as it ever was: numbers that grow move nothing at their right. The room behind a shorter text is clicked, too.
        float* const widest = ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID(tip));
        const float width = ImGui::GetItemRectSize().x;
        *widest = std::max(*widest, width);
        if (*widest > width) {
            ImGui::SameLine(0.0f, 0.0f);
            ImGui::Dummy({*widest - width, 0.0f});
        }
        ImGui::EndGroup();
        const bool is_clicked = ImGui::IsItemClicked();
        tooltip(tip);
        return is_clicked;
    }

    bool is_full() const { return is_full_; }

private:
    bool first_ = true;
    bool is_full_ = false;  ///< what has no room is left out: nothing is cut
};

void draw_counts(StatusLine& line, const ViewerModel& model) {
    if (model.frame() == nullptr) return;
    if (const auto& field = model.status().field)
        line.add(passes_text(field->passes) + " learned",
                 "Passes whose training samples the field has learned from. Camera moves keep the field.");
}

/// Counts of invalid samples, lost paths, lookup misses and clamped training samples; a click marks their pixels.
void draw_diagnostics(StatusLine& line, ViewerModel& model) {
    if (model.frame() == nullptr) return;
    const diagnose::DiagnosticCounts counts = diagnose::counted_diagnostics(model.frame()->snapshot);
    bool is_clicked = false;
    bool is_valid = true;
    for (const diagnose::DiagnosticInfo& diagnostics : diagnose::all_diagnostics()) {
        const std::uint64_t count = counts[static_cast<std::size_t>(diagnostics.id)];
        if (count == 0) continue;
        is_valid = false;
        const std::string tip = fmt::format("{}\nClick to mark the pixels (T).", diagnostics.meaning);
        is_clicked |= line.add(fmt::format("{} {}", short_number(static_cast<double>(count)), diagnostics.label),
                               tip.c_str(), colors::kWarning);
        note_place(std::string(diagnostics.label).c_str());
    }
    if (is_valid) {
        is_clicked |=
            line.add("all samples valid",
                     "No invalid sample, no path lost from a closed scene, no failed lookup of a radiance volume, no "
                     "clamped training sample.",
                     colors::kFaint);
        note_place("all samples valid");
    }
    if (is_clicked) model.diagnostics().toggle();
}

/// Place and value of the pixel under the pointer.
void draw_pointed(StatusLine& line, ViewerModel& model) {
    const std::optional<PointedPixel>& pointed = model.window().pointed;
    if (!pointed) return;
    model.window().values_shown = true;
    std::string text = fmt::format("{},{}", pointed->at.x, pointed->at.y);
    const bool is_number = is_heat_map(model.frame()->snapshot.slot.view);
    if (const auto& value = pointed->value)
        text += is_number ? ":  " + short_value(value->x)
                          : fmt::format(":  {}  {}  {}", short_value(value->x), short_value(value->y),
                                        short_value(value->z));
    line.add(text, "Pixel under the pointer, from the top left, and its linear red, green and blue, or its number.");
    if (!line.is_full()) note_place("pointed pixel");
}

std::string samples_text(const ViewerModel& model) {
    const SampleLimits& limits = model.render().limits();
    std::string text = limits.spp > 0 ? fmt::format("{}/{} spp", model.status().passes, limits.spp)
                                      : fmt::format("{} spp", model.status().passes);
    text += limits.seconds > 0.0 ? fmt::format(" | {:.1f}/{:g} s", model.status().seconds, limits.seconds)
                                 : fmt::format(" | {:.1f} s", model.status().seconds);
    return text;
}

}  // namespace

void draw_status_bar(ViewerModel& model, const Layout& layout) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em(0.6f), em(0.35f)});
    begin_fixed_window("status", layout.status, ImGuiWindowFlags_NoScrollbar);
    ImGui::PopStyleVar();
    StatusLine line;
    const WorkerState state = model.status().state;
    line.add(name_of(state), "State of the rendering.",
             state == WorkerState::Failed ? colors::kError
                                          : (state == WorkerState::Rendering ? colors::kGood : colors::kWarning));
    draw_diagnostics(line, model);
    line.add(method_text(model.render().settings(), model.render().method()),
             fmt::format("The method; keys {}.", method_keys()).c_str());
    line.add(light_samples_text(model.render().settings().next_event),
             "Key L: whether each path vertex samples a point on a light.");
    if (model.frame() != nullptr)
        line.add(back_end_label(model.status().backend), device_text(model.frame()->backend).c_str());
    line.add(fmt::format("{}x{}", model.render().settings().width, model.render().settings().height),
             "Size of the picture.");
    line.add(samples_text(model),
             "Samples per pixel, and their time: placement, precomputation, learning and rendering.");
    line.add(fmt::format("{:.2f} Mpaths/s", model.link().throughput().mpaths_per_second()),
             "Camera paths per second of rendering.");
    draw_counts(line, model);
    draw_pointed(line, model);
    ImGui::End();
}

}  // namespace pl::ui
