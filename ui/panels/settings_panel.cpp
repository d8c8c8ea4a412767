#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/session/choices.h"
#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/input/perform_action.h"
#include "ui/model/window_choices.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

/// Only for scenes with knobs.
void draw_scene(ViewerModel& model) {
    const std::vector<KnobDescription> knobs = model.scene().knobs();
    if (knobs.empty() || !section("Scene", true)) return;
    for (std::size_t i = 0; i < knobs.size(); ++i) {
        const KnobDescription& knob = knobs[i];
        float value = knob.value;
        if (slider_row(knob.name.c_str(), (knob.does + ". The field is learned anew.").c_str(), &value,
                       {knob.low, knob.high, knob.default_value, "%.4g"}))
            model.scene().set_knob(i, value);
    }
    const bool turned =
        std::ranges::any_of(knobs, [](const KnobDescription& k) { return k.value != k.default_value; });
    ImGui::BeginDisabled(!turned);
    if (wide_button("Reset knobs", "The scene's own values.")) model.scene().reset_knobs();
    ImGui::EndDisabled();
}

void draw_method(ViewerModel& model) {
    if (!section("Method", true)) return;
    const MethodId current = model.render().settings().method;
    for (const MethodInfo& method : all_methods()) {
        const std::string label = fmt::format("{}  {}", method.key, method.label);
        if (ImGui::RadioButton(label.c_str(), method.id == current)) model.render().set_method(method.id);
        tooltip(std::string(method.summary).c_str());
    }
    faint_text(std::string(info_of(model.render().settings().method).summary).c_str());
    bool next_event = model.render().settings().next_event;
    if (toggle_row(
            "Light samples",
            "Key L: next-event estimation. Samples a point on a light at every path vertex and combines it with "
            "the scattered directions by multiple importance sampling. Without them paths reach light only by "
            "scattering.",
            &next_event))
        model.render().set_next_event(next_event);
}

/// An unavailable one is grayed out, with the reason in place of its device.
void draw_back_end(ViewerModel& model) {
    if (!section("Back end", true)) return;
    const std::string wanted = model.render().wanted_backend();
    for (const BackendChoice& choice : *model.status().backends) {
        const bool available = choice.unavailable.empty();
        ImGui::BeginDisabled(!available);
        if (ImGui::RadioButton(back_end_label(choice.name).c_str(), choice.name == wanted))
            model.render().set_backend(choice.name);
        ImGui::EndDisabled();
        if (available)
            tooltip(choice.failed.empty() ? "B switches. Method, camera and learned field stay."
                                          : "It has failed. Choose it to try again.");
        const std::string text = !available              ? choice.unavailable
                                 : choice.failed.empty() ? choice.device
                                                         : "failed: " + choice.failed;
        if (text.empty()) continue;
        const float label_start = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
        ImGui::Indent(label_start);
        faint_text(text.c_str());
        ImGui::Unindent(label_start);
    }
    if (is_research(model))
        text_row("Rays", model.frame() != nullptr ? model.frame()->backend.intersector : "-",
                 "The intersector of this scene.");
}

void draw_size(ViewerModel& model) {
    int width = model.render().settings().width;
    int height = model.render().settings().height;
    if (size_row("Size", "Width and height of the picture in pixels, independent of the size of the window.", &width,
                 &height))
        model.render().set_size(std::clamp(width, 16, 8192), std::clamp(height, 16, 8192));
    if (wide_button("Fit size to window", "The largest size that fits, with the aspect ratio of the picture."))
        model.window().requests.fit_size = true;
}

void draw_limits(ViewerModel& model) {
    SampleLimits limits = model.render().limits();
    int spp = static_cast<int>(limits.spp);
    if (int_row("Samples", "Stop at this number of samples per pixel. 0: no limit.", &spp, 64, "no limit")) {
        limits.spp = static_cast<std::uint32_t>(std::max(spp, 0));
        model.render().set_limits(limits);
    }
    double seconds = limits.seconds;
    if (double_row("Seconds",
                   "Stop after this time: placement of volumes, precomputation, learning and rendering, without "
                   "loading, the hierarchy and the window. 0: no limit.",
                   &seconds, 5.0, "%.1f", "no limit")) {
        limits.seconds = std::max(seconds, 0.0);
        model.render().set_limits(limits);
    }
}

void draw_estimator(ViewerModel& model) {
    int depth = model.render().settings().max_depth;
    if (int_row("Max depth", "Largest number of path vertices; Russian roulette ends most paths earlier. Default 64.",
                &depth, 1))
        model.render().set_max_depth(std::clamp(depth, 1, 1024));
    RouletteRule roulette = model.render().settings().roulette;
    if (choice_row("Roulette", "The rule of Russian roulette.", &roulette)) model.render().set_roulette(roulette);
    GuidingRule guiding = model.render().settings().guiding;
    if (choice_row("Guiding", "Guided methods with light samples.", &guiding)) model.render().set_guiding(guiding);
    int seed = static_cast<int>(model.render().settings().seed);
    if (int_row("Seed", "Same seed, scene and settings: same picture to the bit with any number of threads.", &seed,
                1))
        model.render().set_seed(static_cast<std::uint64_t>(std::max(seed, 0)));
}

void draw_sampling(ViewerModel& model) {
    if (!section("Sampling", true)) return;
    draw_limits(model);
    draw_size(model);
    if (is_research(model)) draw_estimator(model);
}

void draw_run_buttons(ViewerModel& model) {
    const float width = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button(model.render().paused() ? "Continue###run" : "Pause###run", {width, 0.0f}))
        model.render().set_paused(!model.render().paused());
    tooltip("Space");
    ImGui::SameLine();
    if (ImGui::Button("Restart", {width, 0.0f})) model.render().restart();
    tooltip("R: clears the picture and keeps the learned field.");
}

void draw_camera(ViewerModel& model) {
    if (!section("Camera", false)) return;
    CameraDescription camera = model.camera().camera();
    if (point_row("Eye", "Position in scene units.", &camera.eye.x)) model.camera().set(camera);
    if (point_row("Target", "The point that the camera looks at.", &camera.target.x)) model.camera().set(camera);
    if (slider_row("View angle", "Vertical field of view in degrees.", &camera.fov_deg,
                   {5.0f, 120.0f, model.camera().given().fov_deg, "%.1f\xc2\xb0"}))
        model.camera().set(camera);
    const CameraDescription& given = model.camera().given();
    if (slider_row("Aperture", "Radius of the lens in scene units; 0 is a pinhole.", &camera.aperture_radius,
                   {0.0f, 0.1f * camera.focus_distance, given.aperture_radius, "%.4g"}))
        model.camera().set(camera);
    if (slider_row("Focus", "Focus distance along the view direction, in scene units.", &camera.focus_distance,
                   {0.1f * given.focus_distance, 10.0f * given.focus_distance, given.focus_distance, "%.4g"}))
        model.camera().set(camera);
    const auto& picked = model.selection().picked();
    if (picked && wide_button("Focus on the selected point", "Sets the focus distance to it."))
        model.camera().focus_on(picked->position);
    text_row("Speed", fmt::format("{:.4g} units/s", model.camera().speed()), "Wheel, + and -.");
    if (wide_button("Reset camera", "Home")) model.camera().go_home();
    if (wide_button("Copy as command line", "Ctrl+C: the command that renders this picture without a window."))
        perform(model, ActionId::CopyCommand);
}

void draw_view(ViewerModel& model) {
    std::vector<std::string> labels;
    for (const ViewInfo& view : all_views()) labels.emplace_back(view.label);
    int view = static_cast<int>(model.render().settings().view);
    if (choice_row("View", std::string(info_of(model.render().settings().view).summary).c_str(), &view, labels))
        model.render().set_view(all_views()[static_cast<std::size_t>(view)].id);
    if (is_heat_map(model.render().settings().view)) range_controls(model.display().heat_rule());
    float exposure = model.display().settings().exposure_ev;
    if (slider_row("Exposure", "In stops; display only.", &exposure, {-8.0f, 8.0f, 0.0f, "%+.2f EV"}))
        model.display().set_exposure(exposure);
    draw_auto_exposure(model);
}

void draw_tone_curve(ViewerModel& model) {
    ToneCurve curve = model.display().settings().curve;
    if (choice_row("Tone curve", "Display only.", &curve)) model.display().set_curve(curve);
}

void draw_field_displays(ViewerModel& model) {
    bool cells = model.display().cells();
    if (toggle_row("Tint by radiance volume", "V: the Voronoi cells of the radiance volumes, over any view.", &cells))
        model.display().set_cells(cells);
    float opacity = model.display().cells_opacity();
    if (slider_row("Tint opacity", "Keys ; and '.", &opacity, {0.0f, 1.0f, 0.4f, "%.2f"}))
        model.display().set_cells_opacity(opacity);
    toggle_row("Hemisphere in the picture",
               "H: the field of the selected volume, and of pinned ones, drawn at their positions.",
               &model.window().hemisphere);
    choice_row("Drawn as", "Shift+H.", &model.window().lobe_shape);
    bool gain = model.gain_marks().is_shown();
    if (toggle_row(
            "Gain marks",
            "Y: marks where the guided method gains or loses against Default at equal time, as measured from the "
            "pictures of both.",
            &gain))
        model.gain_marks().set_shown(gain);
    bool flowers = model.flowers().is_shown();
    if (toggle_row("Lobes of many volumes", "U: each as long as the others at its own peak.", &flowers))
        model.flowers().set_shown(flowers);
    if (!flowers) return;
    auto step = static_cast<float>(model.flowers().step());
    if (slider_row("Every n-th", "Of the volumes; at most 2000 are drawn.", &step,
                   {1.0f, 64.0f, 1.0f, "%.0f", ImGuiSliderFlags_Logarithmic}))
        model.flowers().set_step(static_cast<int>(step + 0.5f));
}

void draw_window_displays(ViewerModel& model) {
    bool low = model.display().low_resolution();
    if (toggle_row("Coarser while moving", "Lowers the resolution in motion to keep the frame rate.", &low))
        model.display().set_low_resolution(low);
    bool preview = model.display().preview();
    ImGui::BeginDisabled(!low);
    if (toggle_row("Preview while moving",
                   "For Default without light samples, whose first samples are single dots: the learned radiance map "
                   "if there is one, else light samples. A badge names it; no sample of it comes to the picture.",
                   &preview))
        model.display().set_preview(preview);
    ImGui::EndDisabled();
    bool denoises = model.display().denoises();
    if (toggle_row(
            "Denoised preview",
            "Shift+N: while moving and below 16 samples the CPU's picture is shown smoothed along its surfaces. "
            "A badge says so; films, errors, files and compared pictures are never denoised.",
            &denoises))
        model.display().set_denoises(denoises);
}

/// In both layouts: who cannot read the window does not look for more settings.
void draw_reading(ViewerModel& model) {
    constexpr float kLeastScale = 0.75f, kMostScale = 2.0f, kScaleStep = 0.25f;
    std::vector<std::string> sizes;
    for (float scale = kLeastScale; scale <= kMostScale; scale += kScaleStep)
        sizes.push_back(fmt::format("{:.0f} %", 100.0f * scale));
    int size = static_cast<int>(std::lround((model.window().ui_scale - kLeastScale) / kScaleStep));
    if (choice_row("Text size", "Size of text and controls; also --ui-scale.", &size, sizes))
        model.window().ui_scale = kLeastScale + kScaleStep * static_cast<float>(size);
    choice_row("Theme", "Colors of the window.", &model.window().theme);
}

void draw_display(ViewerModel& model) {
    if (!section("Display", true)) return;
    draw_view(model);
    if (is_research(model)) draw_tone_curve(model);
    draw_field_displays(model);
    if (is_research(model)) draw_window_displays(model);
    draw_reading(model);
}

void draw_layout_button(ViewerModel& model) {
    const char* const label = is_research(model) ? "Fewer settings" : "All settings";
    if (wide_button(label, "F3: layout Explore, with the settings and tabs of a first look, or Research, with all."))
        perform(model, ActionId::SwitchLayout);
    note_place("layout");
}

}  // namespace

void draw_settings_panel(ViewerModel& model, const Layout& layout) {
    begin_fixed_window("settings", layout.left);
    draw_run_buttons(model);
    draw_layout_button(model);
    draw_scene(model);
    draw_method(model);
    draw_back_end(model);
    draw_display(model);
    draw_cameras(model);
    draw_sampling(model);
    draw_learning_section(model);
    if (is_research(model)) draw_camera(model);
    ImGui::End();
}

}  // namespace pl::ui
