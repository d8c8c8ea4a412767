#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "ui/draw/imgui_draw.h"
#include "ui/draw/widgets.h"
#include "ui/input/perform_action.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

using Phase = GuidedTour::Phase;

/// The part of the window that the step is about; empty if it is not visible.
Rect place_of(const TourStep& step, const Rect& image) {
    if (step.place == TourStep::kPicture) return image;
    const auto& places = gui_memory().places;
    const auto place = places.find(step.place);
    return place != places.end() ? place->second : Rect{};
}

/// A frame around it that swells gently.
void draw_frame(ImDrawList& list, const Rect& place) {
    if (place.width <= 0.0f || place.height <= 0.0f) return;
    const float phase = 0.5f + 0.5f * std::sin(4.0f * static_cast<float>(ImGui::GetTime()));
    const float margin = em(0.15f + 0.15f * phase);
    list.AddRect({place.x - margin, place.y - margin},
                 {place.x + place.width + margin, place.y + place.height + margin}, colors::kWarning, em(0.25f), 0,
                 em(0.15f));
}

bool button(const char* label, const char* place) {
    const bool is_pressed = ImGui::Button(label);
    note_place(place);
    return is_pressed;
}

void large_text(const std::string& text, ImU32 color) {
    ImGui::PushFont(large_font());
    text_line(text.c_str(), color);
    ImGui::PopFont();
}

/// Two runs in turns, in one sentence that is true now. Where there is little room it is all, in smaller type.
void draw_headline(const ViewerModel& model, const TurnsHeadline& headline) {
    const bool next_event = model.render().settings().next_event;
    const bool is_old = headline.row != nullptr && model.comparison().accuracy().is_old(*headline.row);
    const bool is_narrow = ImGui::GetContentRegionAvail().x < em(24.0f);
    const ImU32 color = is_old ? colors::kFaint : colors::kText;
    if (is_narrow)
        text_line(headline.text.c_str(), color);
    else
        large_text(headline.text, color);
    const std::string about = headline.detail.empty() || is_narrow ? "" : headline.detail + " ";
    faint_text(fmt::format("{}{}: {} turns them {}.", about,
                           next_event ? "With light samples" : "Without light samples",
                           info_of(ActionId::NextEvent).keys, next_event ? "off" : "on")
                   .c_str());
}

void draw_offer(ViewerModel& model) {
    if (model.link().turns())
        text_line("Drag the line between the halves, or see in six short steps how it works.", colors::kWarning);
    else
        text_line("New here? Six short steps show how light transport is learned while the picture is rendered.",
                  colors::kText);
    if (button("Take the tour (F4)", "tour: take")) model.tour().begin(model);
    ImGui::SameLine();
    if (button("No, thanks", "tour: decline")) model.tour().leave();
}

void draw_step(ViewerModel& model) {
    GuidedTour& tour = model.tour();
    // Above the text, whose lines change with what was measured: they keep their place through all steps.
    ImGui::BeginDisabled(tour.step() == 0);
    if (button("Back", "tour: back")) tour.last_step(model);
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (button("Next", "tour: next")) tour.next_step(model);
    ImGui::SameLine();
    if (button("Leave the tour", "tour: leave")) tour.leave();
    tooltip("F4 continues it here.");
    if (tour.phase() != Phase::Running) return;
    const std::span<const TourStep> steps = tour_steps();
    const TourStep& step = steps[static_cast<std::size_t>(tour.step())];
    text_line(fmt::format("{} of {}   {}", tour.step() + 1, steps.size(), step.title).c_str(), colors::kAccent);
    text_line(step.text, colors::kText);
    if (tour.is_seen())
        text_line(seen_text(model, tour.step()).c_str(), colors::kGood);
    else
        text_line(step.task, colors::kWarning);
    if (!model.comparison().in_turns())
        text_line("The turns have ended: X lets both halves go on.", colors::kWarning);
}

void draw_end(ViewerModel& model) {
    if (button("Close", "tour: close")) model.tour().leave();
    text_line("This was the tour.", colors::kAccent);
    text_line(lesson_text(model).c_str(), colors::kText);
    text_line("F1 lists all keys, F3 shows all settings, Ctrl+O opens other scenes, F4 begins the tour again.",
              colors::kFaint);
}

void draw_card(ViewerModel& model, Phase phase) {
    if (phase == Phase::Opening) text_line("opening the scene 'door'", colors::kFaint);
    if (phase == Phase::Running) draw_step(model);
    if (phase == Phase::Finished) draw_end(model);
}

/// A window as wide as text reads well, with an upper or lower edge at `y`. End it with ImGui::End().
void begin_card(const char* name, const Rect& view, float y, bool is_lower_edge, ImGuiWindowFlags flags = 0) {
    const float width = std::min(view.width - em(1.2f), em(34.0f));
    ImGui::SetNextWindowPos({view.x + 0.5f * view.width, y}, ImGuiCond_Always, {0.5f, is_lower_edge ? 1.0f : 0.0f});
    ImGui::SetNextWindowSize({width, 0.0f});
    ImGui::SetNextWindowBgAlpha(0.94f);
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing | flags);
}

/// Below compared pictures that leave room there, else above their names, as far as the card stays below the menus. The same before
/// there are pictures: the buttons of the card keep their place.
float low_card_edge(const Rect& view, const Rect& image, const ComparePlan& plan) {
    const float height = gui_memory().low_card_height;
    const float end = view.y + view.height - em(0.6f);
    const Rect& picture = plan.tiles.empty() ? image : plan.tiles[0].clip;
    if (picture.y + picture.height + height < end) return end;
    return std::min(end, std::max(top_of_names(plan, image) - em(0.6f), view.y + height));
}

/// Ends the window, and returns its place.
Rect end_card(const char* place) {
    const ImVec2 corner = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    ImGui::End();
    note_place(place, {corner.x, corner.y, size.x, size.y});
    return {corner.x, corner.y, size.x, size.y};
}

}  // namespace

void draw_tour(ViewerModel& model, const Layout& layout, const Rect& image, const ComparePlan& plan) {
    const Phase phase = model.tour().phase();
    GuiMemory& memory = gui_memory();
    memory.top_card_end = 0.0f;
    memory.low_card_start = std::numeric_limits<float>::infinity();
    const Rect& view = layout.clear;
    if (phase == Phase::Off || phase == Phase::Offered) {
        if (!model.link().turns() && phase == Phase::Off) return;
        // Without buttons clicks go through it to the picture.
        begin_card("headline", view, low_card_edge(view, image, plan), true,
                   phase == Phase::Off ? ImGuiWindowFlags_NoInputs : 0);
        if (const auto headline = model.comparison().headline()) draw_headline(model, *headline);
        if (phase == Phase::Offered) draw_offer(model);
        const Rect card = end_card("headline");
        memory.low_card_start = card.y;
        memory.low_card_height = card.height;
        return;
    }
    if (phase == Phase::Running && !model.has_dialog()) {
        const TourStep& step = tour_steps()[static_cast<std::size_t>(model.tour().step())];
        // Over everything else, but the picture's below the card.
        draw_frame(step.place == TourStep::kPicture ? *ImGui::GetBackgroundDrawList()
                                                    : *ImGui::GetForegroundDrawList(),
                   place_of(step, image));
    }
    begin_card("tour", view, view.y + em(0.6f), false);
    draw_card(model, phase);
    const Rect card = end_card("tour");
    memory.top_card_end = card.y + card.height;
}

}  // namespace pl::ui
