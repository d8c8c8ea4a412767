#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/panels/widgets.h"

namespace pl {
namespace {

void draw_method(ViewerModel& model) {
    if (!section("Method", true)) return;
    const MethodId current = model.settings().method;
    for (const MethodInfo& method : all_methods()) {
        const std::string label = fmt::format("{}  {}", static_cast<int>(method.id) + 1, method.label);
        if (ImGui::RadioButton(label.c_str(), method.id == current)) model.set_method(method.id);
        tooltip(std::string(method.summary).c_str());
    }
    faint_text(std::string(info_of(model.settings().method).summary).c_str());
    bool next_event = model.settings().next_event;
    if (toggle_row("Next-event estimation",
                   "Sample the lights directly at every surface, combined with the method's own directions "
                   "by multiple "
                   "importance sampling. Off by default: then only the method finds the light.",
                   &next_event))
        model.set_next_event(next_event);
}

/// One that cannot be had is greyed, with the reason where the others tell their device.
void draw_back_end(ViewerModel& model) {
    if (!section("Back end", true)) return;
    const std::string wanted = model.wanted_backend();
    for (const BackendChoice& choice : *model.status().backends) {
        const bool available = choice.unavailable.empty();
        ImGui::BeginDisabled(!available);
        if (ImGui::RadioButton(back_end_label(choice.name).c_str(), choice.name == wanted))
            model.set_backend(choice.name);
        ImGui::EndDisabled();
        if (available)
            tooltip(choice.failed.empty() ? "B switches. Method, camera and what was learned stay."
                                          : "It failed. Choosing it tries again.");
        const std::string text = !available              ? choice.unavailable
                                 : choice.failed.empty() ? choice.device
                                                         : "failed: " + choice.failed;
        if (text.empty()) continue;
        const float label_start = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
        ImGui::Indent(label_start);
        faint_text(text.c_str());
        ImGui::Unindent(label_start);
    }
    if (model.frame() != nullptr)
        text_row("Rays", model.frame()->backend.intersector, "How rays find triangles in this scene.");
}

void draw_size(ViewerModel& model) {
    int width = model.settings().width;
    int height = model.settings().height;
    if (size_row("Size", "Width and height of the picture in pixels. Resizing the window does not change them.",
                 &width, &height))
        model.set_size(std::clamp(width, 16, 8192), std::clamp(height, 16, 8192));
    if (wide_button("Fit size to window", "As many pixels as the window has room for, in the shape of the picture."))
        model.window().fit_size_asked = true;
}

void draw_sampling(ViewerModel& model) {
    if (!section("Sampling", true)) return;
    SampleLimits limits = model.limits();
    int spp = static_cast<int>(limits.spp);
    if (int_row("Samples", "Rest after this many samples per pixel. 0: no limit.", &spp, 64)) {
        limits.spp = static_cast<std::uint32_t>(std::max(spp, 0));
        model.set_limits(limits);
    }
    double seconds = limits.seconds;
    if (double_row("Seconds",
                   "Rest after this time. It counts placing volumes, precomputing, learning and rendering; "
                   "not loading, "
                   "building the hierarchy or drawing the window. 0: no limit.",
                   &seconds, 5.0, "%.1f")) {
        limits.seconds = std::max(seconds, 0.0);
        model.set_limits(limits);
    }
    draw_size(model);
    int depth = model.settings().max_depth;
    if (int_row("Max depth",
                "Longest path in surface points, a safety net: Russian roulette does the ending. Default 64.", &depth,
                1))
        model.set_max_depth(std::clamp(depth, 1, 1024));
    int roulette = static_cast<int>(model.settings().roulette);
    if (choice_row(
            "Roulette",
            "What ends paths early, and splits them. Spare: the reflectances end them, what is learned may spare or "
            "split one. Albedo: the reflectances alone. Field: what is learned alone.",
            &roulette, "Spare\0Albedo\0Field\0"))
        model.set_roulette(static_cast<RouletteRule>(roulette));
    int seed = static_cast<int>(model.settings().seed);
    if (int_row("Seed", "Same seed, scene and settings: same picture to the bit, whatever the number of threads.",
                &seed, 1))
        model.set_seed(static_cast<std::uint64_t>(std::max(seed, 0)));
}

void draw_run_buttons(ViewerModel& model) {
    const float width = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::Button(model.paused() ? "Go on" : "Pause", {width, 0.0f})) model.set_paused(!model.paused());
    tooltip("Space");
    ImGui::SameLine();
    if (ImGui::Button("Restart", {width, 0.0f})) model.restart();
    tooltip("R: clears the picture, keeps what was learned.");
}

/// How many volumes may come to those that were placed. Every change starts over.
void draw_refinement(ViewerModel& model, FieldSettings settings) {
    bool is_auto = settings.refine_share == kRefineByRecords;
    if (toggle_row(
            "Refine",
            "Reinforcement splits volumes that many paths ask and whose neighbours have learned something else: "
            "up to twice as many, once enough is known for them, unless their number is given.",
            &is_auto)) {
        settings.refine_share = is_auto ? kRefineByRecords : 0.0f;
        model.set_field(settings);
    }
    if (!is_auto &&
        slider_row("Added share", "How many more volumes reinforcement may add, as a share of those placed.",
                   &settings.refine_share, 0.0f, 1.0f, 0.0f, "%.2f"))
        model.set_field(settings);
}

/// What is recorded, and how far a record moves what is learned. Every change starts over.
void draw_learning_targets(ViewerModel& model, FieldSettings settings) {
    constexpr std::array kRates{LearningRate::SampleMean, LearningRate::Forgetful, LearningRate::Power,
                                LearningRate::Floor};
    int rate = static_cast<int>(std::ranges::find(kRates, settings.rate) - kRates.begin());
    int target = static_cast<int>(settings.learning.target);
    int light = static_cast<int>(settings.learning.light);
    bool changed =
        choice_row("Learning rate",
                   "Forgetful lets go of the early records, mean is 1/(1+visits), power n^-0.7, floor never "
                   "falls below 0.05.",
                   &rate, "Mean\0Forgetful\0Power\0Floor\0");
    changed |= choice_row("Learns from",
                          "What reinforcement records for a direction: what is expected to be reflected where "
                          "it leads, what the next direction brings by the table, or what the path brought.",
                          &target, "Expected Sarsa\0Sarsa\0Monte Carlo\0");
    changed |= choice_row("Light", "With next-event estimation: all light, or only what light samples do not bring.",
                          &light, "All\0Indirect\0");
    if (!changed) return;
    settings.rate = kRates[static_cast<std::size_t>(rate)];
    settings.learning = {static_cast<LearningTarget>(target), static_cast<LearnedLight>(light)};
    model.set_field(settings);
}

void draw_learning(ViewerModel& model) {
    if (!section("Learning", true)) return;
    const std::optional<FieldStatus>& field = model.status().field;
    if (field) {
        text_row(
            "Learned",
            fmt::format("{} passes, {} records", field->passes, short_number(static_cast<double>(field->records))),
            "Survives camera moves.");
    } else {
        faint_text(info_of(model.settings().method).uses_field ? "nothing yet"
                                                               : "The default method learns nothing.");
    }
    MixtureSettings mixture = model.settings().mixture;
    bool learned = mixture.learned != 0;
    if (toggle_row("Learned share", "Reinforcement: each volume learns how many directions it leaves to the BSDF.",
                   &learned)) {
        mixture.learned = learned ? 1 : 0;
        model.set_mixture(mixture);
    }
    if (slider_row(
            "BSDF share",
            "Share of directions that come from the surface's reflectance instead of the learned table, where it "
            "is not learned.",
            &mixture.bsdf_fraction, kMinBsdfFraction, 1.0f, MixtureSettings{}.bsdf_fraction, "%.2f"))
        model.set_mixture(mixture);
    FieldSettings settings = model.settings().field;
    int volumes = settings.volumes;
    if (int_row("Volumes",
                "Number of radiance volumes; 0 takes as many as the memory holds, at most 1000. More learn "
                "more slowly.",
                &volumes, 100)) {
        settings.volumes = std::clamp(volumes, 0, 1000000);
        model.set_field(settings);
    }
    draw_refinement(model, settings);
    int side = static_cast<int>(std::lround(std::sqrt(settings.bins))) - 2;
    if (choice_row("Directions", "Cells of the hemisphere per volume.", &side,
                   "4\0009\00016\00025\00036\00049\00064\00081\000100\000121\000144\000169\000196\000225\0002"
                   "56\000")) {
        settings.bins = (side + 2) * (side + 2);
        model.set_field(settings);
    }
    draw_learning_targets(model, settings);
    if (wide_button("Forget what was learned", "Ctrl+Shift+R")) model.forget();
}

void draw_camera(ViewerModel& model) {
    if (!section("Camera", false)) return;
    CameraDescription camera = model.controls().camera();
    if (point_row("Eye", "Position in scene units.", &camera.eye.x)) model.set_camera(camera);
    if (point_row("Target", "Point that the camera looks at.", &camera.target.x)) model.set_camera(camera);
    if (slider_row("View angle", "Vertical field of view in degrees.", &camera.fov_deg, 5.0f, 120.0f,
                   model.options().settings.camera.fov_deg, "%.1f\xc2\xb0"))
        model.set_camera(camera);
    const CameraDescription& given = model.options().settings.camera;
    if (slider_row("Aperture", "Radius of the lens in scene units; 0 is a pinhole.", &camera.aperture_radius, 0.0f,
                   0.1f * camera.focus_distance, given.aperture_radius, "%.4g"))
        model.set_camera(camera);
    if (slider_row("Focus", "Distance that is sharp, along the view.", &camera.focus_distance,
                   0.1f * given.focus_distance, 10.0f * given.focus_distance, given.focus_distance, "%.4g"))
        model.set_camera(camera);
    if (model.picked() && wide_button("Focus on the selected point", "Makes it sharp.")) model.focus_on_picked();
    text_row("Speed", fmt::format("{:.4g} units/s", model.controls().speed()), "Wheel, + and -.");
    if (wide_button("Reset camera", "Home")) model.camera_home();
    if (wide_button("Copy as command line", "Ctrl+C: the command that renders this picture without a window."))
        perform(model, ActionId::CopyCommand);
}

void draw_display(ViewerModel& model) {
    if (!section("Display", true)) return;
    std::string labels;
    for (const ViewInfo& view : all_views()) labels += std::string(view.label) + '\0';
    int view = static_cast<int>(model.settings().view);
    if (choice_row("View", std::string(info_of(model.settings().view).summary).c_str(), &view, labels.c_str()))
        model.set_view(all_views()[static_cast<std::size_t>(view)].id);
    float exposure = model.display().exposure_ev;
    if (slider_row("Exposure", "In stops; display only.", &exposure, -8.0f, 8.0f, 0.0f, "%+.2f EV"))
        model.set_exposure(exposure);
    int curve = static_cast<int>(model.display().curve);
    if (choice_row("Tone curve", "Display only. Clamp shows values as they are up to 1.", &curve,
                   "Clamp\0Reinhard\0ACES fit\0"))
        model.set_curve(static_cast<ToneCurve>(curve));
    bool cells = model.window().cells;
    if (toggle_row("Tint by radiance volume", "V: the Voronoi cells of the volumes, over any view.", &cells))
        model.set_cells(cells);
    float opacity = model.window().cells_opacity;
    if (slider_row("Opacity", "Of the tint.", &opacity, 0.0f, 1.0f, 0.4f, "%.2f")) model.set_cells_opacity(opacity);
    toggle_row("Hemisphere in the picture", "H: what the selected volume has learned, drawn where it stands.",
               &model.window().hemisphere);
    bool low = model.window().low_resolution;
    if (toggle_row("Coarser while moving", "Lowers the resolution in motion to keep up with the hand.", &low))
        model.set_low_resolution(low);
    int scale = static_cast<int>(std::lround((model.window().ui_scale - 0.75f) / 0.25f));
    if (choice_row("UI scale", "Size of text and controls.", &scale,
                   "75 %\000100 %\000125 %\000150 %\000175 %\000200 %\000"))
        model.window().ui_scale = 0.75f + 0.25f * static_cast<float>(scale);
}

}  // namespace

void draw_settings_panel(ViewerModel& model, const Layout& layout) {
    begin_fixed_window("settings", layout.left);
    draw_run_buttons(model);
    draw_method(model);
    draw_back_end(model);
    draw_display(model);
    draw_sampling(model);
    draw_learning(model);
    draw_camera(model);
    ImGui::End();
}

}  // namespace pl
