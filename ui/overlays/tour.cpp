#include <algorithm>
#include <cmath>

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

/// A frame around it, over everything else, that swells gently.
void draw_frame(const Rect& place) {
    if (place.width <= 0.0f || place.height <= 0.0f) return;
    const float phase = 0.5f + 0.5f * std::sin(4.0f * static_cast<float>(ImGui::GetTime()));
    const float margin = em(0.15f + 0.15f * phase);
    ImGui::GetForegroundDrawList()->AddRect({place.x - margin, place.y - margin},
                                            {place.x + place.width + margin, place.y + place.height + margin},
                                            colors::kWarning, em(0.25f), 0, em(0.15f));
}

bool button(const char* label, const char* place) {
    const bool is_pressed = ImGui::Button(label);
    note_place(place);
    return is_pressed;
}

void draw_offer(ViewerModel& model) {
    text_line("New here?", colors::kAccent);
    text_line(
        "Six short steps show how light transport is learned while the picture is rendered, in the scene 'door'.",
        colors::kText);
    if (button("Take the tour", "tour: take")) model.tour().begin(model);
    ImGui::SameLine();
    if (button("No, thanks", "tour: decline")) model.tour().leave();
    faint_text("F4 begins it at any time.");
}

void draw_step(ViewerModel& model) {
    GuidedTour& tour = model.tour();
    const std::span<const TourStep> steps = tour_steps();
    const TourStep& step = steps[static_cast<std::size_t>(tour.step())];
    text_line(fmt::format("{} of {}   {}", tour.step() + 1, steps.size(), step.title).c_str(), colors::kAccent);
    text_line(step.text, colors::kText);
    text_line(step.task, colors::kWarning);
    if (button("Skip this step", "tour: skip")) tour.skip_step(model);
    ImGui::SameLine();
    if (button("Leave the tour", "tour: leave")) tour.leave();
    tooltip("F4 continues it here.");
}

void draw_end(ViewerModel& model) {
    text_line("This was the tour.", colors::kAccent);
    text_line("F1 lists all keys, F3 shows all settings, Ctrl+O opens other scenes, F4 begins the tour again.",
              colors::kText);
    if (button("Close", "tour: close")) model.tour().leave();
}

void draw_card(ViewerModel& model, Phase phase) {
    if (phase == Phase::Offered) draw_offer(model);
    if (phase == Phase::Opening) text_line("opening the scene 'door'", colors::kFaint);
    if (phase == Phase::Running) draw_step(model);
    if (phase == Phase::Finished) draw_end(model);
}

/// Below the badges, where it leaves the floor of the scene free. Badges come, go and wrap while pictures render: during a click the
/// card stays, so that its buttons are still under the pointer when it ends.
float top_of_card(const Rect& view) {
    float& top = gui_memory().card_top;
    const bool is_click = ImGui::IsAnyMouseDown() || ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    if (is_click && top > 0.0f) return top;
    const auto& places = gui_memory().places;
    const auto badges = places.find("badges");
    top = (badges != places.end() ? badges->second.y + badges->second.height : view.y) + em(0.6f);
    return top;
}

}  // namespace

void draw_tour(ViewerModel& model, const Layout& layout, const Rect& image) {
    const Phase phase = model.tour().phase();
    if (phase == Phase::Off) return;
    const bool is_covered = model.open_dialog().is_shown() || model.window().help || model.self_test().is_shown();
    if (phase == Phase::Running && !is_covered) {
        const Rect place = place_of(tour_steps()[static_cast<std::size_t>(model.tour().step())], image);
        draw_frame(place);
    }
    const Rect& view = layout.clear;
    const float width = std::min(view.width - em(1.2f), em(34.0f));
    ImGui::SetNextWindowPos({view.x + 0.5f * view.width, top_of_card(view)}, ImGuiCond_Always, {0.5f, 0.0f});
    ImGui::SetNextWindowSize({width, 0.0f});
    ImGui::SetNextWindowBgAlpha(0.94f);
    ImGui::Begin("tour", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
    draw_card(model, phase);
    const ImVec2 corner = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    ImGui::End();
    note_place("tour", {corner.x, corner.y, size.x, size.y});
}

}  // namespace pl::ui
