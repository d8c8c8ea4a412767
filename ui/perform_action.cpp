#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/style.h"

namespace pl {
namespace {

constexpr float kOpacityStep = 0.1f;
constexpr float kExposureStep = 0.5f;

void copy_command(ViewerModel& model) {
    const std::string command = model.command_line();
    if (command.empty()) {
        model.say(LogLevel::Warning, "this build cannot write the command line");
        return;
    }
    ImGui::SetClipboardText(command.c_str());
    model.say(LogLevel::Info, "copied: " + command);
    const std::size_t edited = model.materials().edited_names().size();
    if (edited > 0)
        model.say(LogLevel::Warning, fmt::format("it has the materials of the file: {} {} changed here", edited,
                                                 edited == 1 ? "was" : "were"));
}

void step_opacity(ViewerModel& model, float step) {
    model.set_cells(true);
    model.set_cells_opacity(model.window().cells_opacity + step);
}

}  // namespace

void perform(ViewerModel& model, ActionId action) {
    WindowState& window = model.window();
    switch (action) {
    case ActionId::MoveForward:
    case ActionId::MoveBack:
    case ActionId::MoveLeft:
    case ActionId::MoveRight:
    case ActionId::MoveUp:
    case ActionId::MoveDown:
    case ActionId::Fast:
    case ActionId::Slow: break;  // held: InputRouter adds them up
    case ActionId::SpeedUp: model.change_speed(1.0f); break;
    case ActionId::SpeedDown: model.change_speed(-1.0f); break;
    case ActionId::CameraHome: model.camera_home(); break;
    case ActionId::Restart: model.restart(); break;
    case ActionId::Forget: model.forget(); break;
    case ActionId::Pause: model.set_paused(!model.paused()); break;
    case ActionId::SinglePass: model.single_pass(); break;
    case ActionId::SwitchBackend: model.next_backend(); break;
    case ActionId::MethodDefault: model.set_method(MethodId::Default); break;
    case ActionId::MethodPrecomputed: model.set_method(MethodId::Precomputed); break;
    case ActionId::MethodReinforcement: model.set_method(MethodId::Reinforcement); break;
    case ActionId::NextEvent: model.set_next_event(!model.settings().next_event); break;
    case ActionId::PreviousView: model.step_view(-1); break;
    case ActionId::NextView: model.step_view(1); break;
    case ActionId::ExposureDown: model.set_exposure(model.display().exposure_ev - kExposureStep); break;
    case ActionId::ExposureUp: model.set_exposure(model.display().exposure_ev + kExposureStep); break;
    case ActionId::Cells: model.set_cells(!window.cells); break;
    case ActionId::CellsFainter: step_opacity(model, -kOpacityStep); break;
    case ActionId::CellsStronger: step_opacity(model, kOpacityStep); break;
    case ActionId::Hemisphere: window.hemisphere = !window.hemisphere; break;
    case ActionId::ShowDiagnostics: model.toggle_diagnostics(); break;
    case ActionId::Accuracy: window.accuracy = !window.accuracy; break;
    case ActionId::CompareNext: model.step_compare(1); break;
    case ActionId::CompareBack: model.step_compare(-1); break;
    case ActionId::Flip: model.flip(); break;
    case ActionId::Turns: model.set_turns(!model.turns()); break;
    case ActionId::MakeReference: model.make_reference(); break;
    case ActionId::HidePanels: window.panels = !window.panels; break;
    case ActionId::Help: window.help = !window.help; break;
    case ActionId::SelfTest: window.self_test = !window.self_test; break;
    case ActionId::FullScreen: window.full_screen_asked = true; break;
    case ActionId::Reload: model.reload(); break;
    case ActionId::Screenshot: model.save_screenshot(); break;
    case ActionId::ScreenshotWithPanels: window.window_shot_asked = true; break;
    case ActionId::Save: model.save_picture(); break;
    case ActionId::SaveField: model.save_field(); break;
    case ActionId::LoadField: model.load_last_field(); break;
    case ActionId::CopyCommand: copy_command(model); break;
    case ActionId::Cancel: model.cancel(); break;
    case ActionId::Quit: window.quit_asked = true; break;
    }
}

}  // namespace pl
