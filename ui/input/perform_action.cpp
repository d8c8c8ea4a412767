#include "ui/input/perform_action.h"

#include <fmt/format.h>

#include "ui/draw/imgui_draw.h"

namespace pl::ui {
namespace {

constexpr float kOpacityStep = 0.1f;
constexpr float kExposureStep = 0.5f;  ///< stops

void copy_command(ViewerModel& model) {
    Messages& messages = model.messages();
    // A picture that began with a learned field is repeated with one: the field as it is now, the nearest that there is.
    const bool warm = model.frame() != nullptr && model.frame()->snapshot.warm;
    const std::string field = warm ? model.files().fields().save_as_named().string() : "";
    const bool is_edited = !model.scene().materials().edited_names().empty();
    const std::string materials = is_edited ? model.files().save_materials().string() : "";
    const std::string command = model.files().pictures().command_line(field, materials);
    if (command.empty()) {
        messages.say(MessageLevel::Warning, "this build cannot write the command line");
        return;
    }
    ImGui::SetClipboardText(command.c_str());
    messages.say(MessageLevel::Info, "copied: " + command);
    if (warm)
        messages.say(MessageLevel::Info, "it continues from the field as it is now: the same light with other noise");
    const std::optional<FieldStatus>& field_status = model.status().field;
    if (field_status && field_status->was_edited && !warm)
        messages.say(
            MessageLevel::Warning,
            "it learns without the steps, pauses and forgotten volumes of this field: those are not reproducible");
    if (!model.scene().materials().are_edits_named())
        messages.say(MessageLevel::Warning,
                     "it lacks edits of materials that have no name of their own in the files");
}

void step_opacity(DisplayControls& display, float step) {
    display.set_cells(true);
    display.set_cells_opacity(display.cells_opacity() + step);
}

void step_exposure(DisplayControls& display, float step) {
    display.set_exposure(display.settings().exposure_ev + step);
}

/// Behind a folded right side it would change unseen.
void toggle_accuracy(WindowState& window) {
    PanelChoice& panels = window.panels;
    const bool is_seen = panels.shows_right(window.one_side);
    panels.accuracy = !is_seen || !panels.accuracy;
    if (!is_seen) panels.toggle_right(window.one_side);
}

/// The next one that is visible: it is opened where nothing else is.
void next_keyed_panel(WindowState& window) {
    window.panels.shown = true;
    const auto is_open = [&](KeyedPanel panel) {
        const bool right = window.panels.shows_right(window.one_side);
        switch (panel) {
        case KeyedPanel::Menu: return true;
        case KeyedPanel::Settings: return window.panels.shows_settings(window.one_side);
        case KeyedPanel::Tabs: return right && (window.panels.tabs || !window.panels.accuracy);
        case KeyedPanel::Accuracy: return right && window.panels.accuracy;
        }
        return false;
    };
    constexpr int kPanels = 4;
    int index = window.keyed_panel ? static_cast<int>(*window.keyed_panel) : 0;
    do index = (index + 1) % kPanels;
    while (!is_open(static_cast<KeyedPanel>(index)));
    window.keyed_panel = static_cast<KeyedPanel>(index);
}

void switch_layout(WindowState& window) {
    window.layout = window.layout == WindowLayout::Explore ? WindowLayout::Research : WindowLayout::Explore;
}

void toggle_tour(ViewerModel& model) {
    const GuidedTour::Phase phase = model.tour().phase();
    if (phase == GuidedTour::Phase::Off || phase == GuidedTour::Phase::Offered)
        model.tour().begin(model);
    else
        model.tour().leave();
}

/// Hidden, it would change unseen.
void switch_lobe_shape(WindowState& window) {
    if (window.hemisphere)
        window.lobe_shape = window.lobe_shape == LobeShape::Lobe ? LobeShape::Dome : LobeShape::Lobe;
    window.hemisphere = true;
}

/// The whole picture first: a camera that the user has set is not lost by a look at pixels.
void go_home(ViewerModel& model) {
    if (model.window().zoom.is_whole())
        model.camera().go_home();
    else
        model.window().zoom.reset();
}

void look_at_point(ViewerModel& model) {
    if (const auto& picked = model.selection().picked())
        model.camera().look_at(picked->position);
    else
        model.messages().say(MessageLevel::Info, "click a surface first: the camera turns to that point");
}

/// Each function does a part of the actions; false for the others.
bool perform_render_action(ViewerModel& model, ActionId id) {
    RenderControls& render = model.render();
    switch (id) {
    case ActionId::SpeedUp: model.camera().change_speed(1.0f); return true;
    case ActionId::SpeedDown: model.camera().change_speed(-1.0f); return true;
    case ActionId::CameraHome: go_home(model); return true;
    case ActionId::LookAtPoint: look_at_point(model); return true;
    case ActionId::AddBookmark: model.bookmarks().add(); return true;
    case ActionId::NextBookmark: model.bookmarks().step(1); return true;
    case ActionId::PreviousBookmark: model.bookmarks().step(-1); return true;
    case ActionId::PlayPath: model.flight().toggle(); return true;
    case ActionId::Undo: model.history().undo(model); return true;
    case ActionId::Redo: model.history().redo(model); return true;
    case ActionId::Restart: render.restart(); return true;
    case ActionId::Forget: render.forget(); return true;
    case ActionId::Pause: render.set_paused(!render.paused()); return true;
    case ActionId::SinglePass: render.single_pass(); return true;
    case ActionId::SwitchBackend: render.next_backend(); return true;
    case ActionId::NextEvent: render.set_next_event(!render.settings().next_event); return true;
    case ActionId::PreviousView: render.step_view(-1); return true;
    case ActionId::NextView: render.step_view(1); return true;
    default: return false;
    }
}

bool perform_display_action(ViewerModel& model, ActionId id) {
    DisplayControls& display = model.display();
    WindowState& window = model.window();
    switch (id) {
    case ActionId::ExposureDown: step_exposure(display, -kExposureStep); return true;
    case ActionId::ExposureUp: step_exposure(display, kExposureStep); return true;
    case ActionId::FollowExposure: model.exposure().set_on(!model.exposure().is_on()); return true;
    case ActionId::Denoise: display.set_denoises(!display.denoises()); return true;
    case ActionId::Zoom: window.requests.zoom = true; return true;
    case ActionId::Cells: display.set_cells(!display.cells()); return true;
    case ActionId::CellsFainter: step_opacity(display, -kOpacityStep); return true;
    case ActionId::CellsStronger: step_opacity(display, kOpacityStep); return true;
    case ActionId::Hemisphere: window.hemisphere = !window.hemisphere; return true;
    case ActionId::LobesOrDome: switch_lobe_shape(window); return true;
    case ActionId::Accuracy: toggle_accuracy(window); return true;
    case ActionId::HidePanels: window.panels.shown = !window.panels.shown; return true;
    case ActionId::FoldSettings: window.panels.toggle_settings(window.one_side); return true;
    case ActionId::FoldRight: window.panels.toggle_right(window.one_side); return true;
    case ActionId::Help: window.help = !window.help; return true;
    case ActionId::KeyPanels: next_keyed_panel(window); return true;
    case ActionId::About: window.about = !window.about; return true;
    case ActionId::SwitchLayout: switch_layout(window); return true;
    case ActionId::ResetWindow: window.requests.reset = true; return true;
    case ActionId::FullScreen: window.requests.full_screen = true; return true;
    case ActionId::ScreenshotWithPanels: window.requests.window_shot = true; return true;
    case ActionId::SaveView: window.requests.view_shot = true; return true;
    case ActionId::CopyView: window.requests.view_copy = true; return true;
    case ActionId::Paste: window.requests.paste = true; return true;
    case ActionId::Quit: window.requests.quit = true; return true;
    default: return false;
    }
}

bool perform_compare_action(ViewerModel& model, ActionId id) {
    CompareControls& comparison = model.comparison();
    switch (id) {
    case ActionId::PinVolume: model.selection().toggle_pin(); return true;
    case ActionId::Flowers: model.flowers().set_shown(!model.flowers().is_shown()); return true;
    case ActionId::TracePaths: model.paths().set_shown(!model.paths().is_shown()); return true;
    case ActionId::ShowGain: model.gain_marks().set_shown(!model.gain_marks().is_shown()); return true;
    case ActionId::ShowDiagnostics: model.diagnostics().toggle(); return true;
    case ActionId::CompareNext: comparison.step_mode(1); return true;
    case ActionId::CompareBack: comparison.step_mode(-1); return true;
    case ActionId::Flip: comparison.flip(); return true;
    case ActionId::Turns: comparison.set_turns(!comparison.in_turns()); return true;
    case ActionId::MakeReference: model.references().make(); return true;
    case ActionId::SelfTest: model.self_test().is_shown() = !model.self_test().is_shown(); return true;
    case ActionId::Tour: toggle_tour(model); return true;
    case ActionId::Cancel: model.cancel(); return true;
    default: return false;
    }
}

bool perform_file_action(ViewerModel& model, ActionId id) {
    Files& files = model.files();
    switch (id) {
    case ActionId::Open: model.open_dialog().toggle(); return true;
    case ActionId::Reload: model.scene().reload(); return true;
    case ActionId::Screenshot: files.pictures().save_png(); return true;
    case ActionId::Save: files.pictures().save_exr_and_png(); return true;
    case ActionId::SaveField: files.fields().save(); return true;
    case ActionId::LoadField: files.fields().load_newest(); return true;
    case ActionId::CopyCommand: copy_command(model); return true;
    default: return false;
    }
}

}  // namespace

bool perform(ViewerModel& model, const Action& action) {
    if (action.method) {
        model.render().set_method(*action.method);
        return true;
    }
    return perform_render_action(model, action.id) || perform_display_action(model, action.id) ||
           perform_compare_action(model, action.id) || perform_file_action(model, action.id);
}

bool is_on(const ViewerModel& model, const Action& action) {
    const WindowState& window = model.window();
    if (action.method) return model.render().method() == *action.method;
    switch (action.id) {
    case ActionId::NextEvent: return model.render().settings().next_event;
    case ActionId::Pause: return model.render().paused();
    case ActionId::FollowExposure: return model.exposure().is_on();
    case ActionId::Denoise: return model.display().denoises();
    case ActionId::Zoom: return !window.zoom.is_whole();
    case ActionId::Cells: return model.display().cells();
    case ActionId::Hemisphere: return window.hemisphere;
    case ActionId::LobesOrDome: return window.lobe_shape == LobeShape::Dome;
    case ActionId::PinVolume: return model.selection().pins().contains(model.selection().volume());
    case ActionId::Flowers: return model.flowers().is_shown();
    case ActionId::TracePaths: return model.paths().is_shown();
    case ActionId::ShowGain: return model.gain_marks().is_shown();
    case ActionId::ShowDiagnostics: return model.diagnostics().map() != nullptr;
    case ActionId::Accuracy: return window.panels.shows_right(window.one_side) && window.panels.accuracy;
    case ActionId::Turns: return model.comparison().in_turns();
    case ActionId::MakeReference: return model.references().is_making();
    case ActionId::PlayPath: return model.flight().is_flying();
    case ActionId::Tour: return model.tour().phase() == GuidedTour::Phase::Running;
    default: return false;
    }
}

bool perform(ViewerModel& model, ActionId id) { return perform(model, info_of(id)); }

}  // namespace pl::ui
