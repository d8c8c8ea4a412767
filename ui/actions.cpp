#include "ui/actions.h"

#include <array>

#include <fmt/format.h>
#include <SDL_keycode.h>
#include <SDL_scancode.h>

namespace pl {
namespace {

using enum ActionId;

constexpr Modifiers kShift{.shift = true};
constexpr Modifiers kCtrl{.ctrl = true};
constexpr Modifiers kCtrlShift{.shift = true, .ctrl = true};

constexpr Chord at(int scancode, Modifiers modifiers = {}) { return {Chord::By::Place, scancode, modifiers}; }
constexpr Chord sign(int symbol, Modifiers modifiers = {}) { return {Chord::By::Symbol, symbol, modifiers}; }

constexpr std::array kActions{
    Action{MoveForward, ActionGroup::Fly, "W", "fly forward", {at(SDL_SCANCODE_W)}, true},
    Action{MoveBack, ActionGroup::Fly, "S", "fly back", {at(SDL_SCANCODE_S)}, true},
    Action{MoveLeft, ActionGroup::Fly, "A", "fly left", {at(SDL_SCANCODE_A)}, true},
    Action{MoveRight, ActionGroup::Fly, "D", "fly right", {at(SDL_SCANCODE_D)}, true},
    Action{MoveUp, ActionGroup::Fly, "E", "fly up", {at(SDL_SCANCODE_E)}, true},
    Action{MoveDown, ActionGroup::Fly, "Q", "fly down", {at(SDL_SCANCODE_Q)}, true},
    Action{Fast,
           ActionGroup::Fly,
           "Shift",
           "four times as fast",
           {at(SDL_SCANCODE_LSHIFT), at(SDL_SCANCODE_RSHIFT)},
           true},
    Action{Slow, ActionGroup::Fly, "Alt", "a quarter as fast", {at(SDL_SCANCODE_LALT)}, true},
    Action{SpeedUp,
           ActionGroup::Fly,
           "+",
           "higher speed",
           {at(SDL_SCANCODE_EQUALS), at(SDL_SCANCODE_EQUALS, kShift), at(SDL_SCANCODE_KP_PLUS)}},
    Action{SpeedDown, ActionGroup::Fly, "-", "lower speed", {at(SDL_SCANCODE_MINUS), at(SDL_SCANCODE_KP_MINUS)}},
    Action{CameraHome, ActionGroup::Fly, "Home", "the scene's own camera", {at(SDL_SCANCODE_HOME)}},

    Action{Pause, ActionGroup::Render, "Space", "pause or go on", {at(SDL_SCANCODE_SPACE)}},
    Action{SinglePass, ActionGroup::Render, "N", "one pass while paused", {sign(SDLK_n)}},
    Action{SwitchBackend, ActionGroup::Render, "B", "other back end: CPU or CUDA", {sign(SDLK_b)}},
    Action{Restart, ActionGroup::Render, "R", "restart the picture", {sign(SDLK_r)}},
    Action{Forget,
           ActionGroup::Render,
           "Ctrl+Shift+R",
           "restart and forget what was learned",
           {sign(SDLK_r, kCtrlShift)}},

    Action{MethodDefault, ActionGroup::Method, "1", "method: default", {at(SDL_SCANCODE_1)}},
    Action{MethodPrecomputed, ActionGroup::Method, "2", "method: precomputed", {at(SDL_SCANCODE_2)}},
    Action{MethodReinforcement, ActionGroup::Method, "3", "method: reinforcement", {at(SDL_SCANCODE_3)}},
    Action{NextEvent, ActionGroup::Method, "L", "next-event estimation on or off", {sign(SDLK_l)}},

    Action{PreviousView, ActionGroup::View, ",", "previous view", {at(SDL_SCANCODE_COMMA)}},
    Action{NextView, ActionGroup::View, ".", "next view", {at(SDL_SCANCODE_PERIOD)}},
    Action{ExposureDown, ActionGroup::View, "[", "half a stop darker", {at(SDL_SCANCODE_LEFTBRACKET)}},
    Action{ExposureUp, ActionGroup::View, "]", "half a stop brighter", {at(SDL_SCANCODE_RIGHTBRACKET)}},

    Action{Cells, ActionGroup::Overlay, "V", "tint by radiance volume (Voronoi cells)", {sign(SDLK_v)}},
    Action{CellsFainter, ActionGroup::Overlay, ";", "fainter tint", {at(SDL_SCANCODE_SEMICOLON)}},
    Action{CellsStronger, ActionGroup::Overlay, "'", "stronger tint", {at(SDL_SCANCODE_APOSTROPHE)}},
    Action{Hemisphere, ActionGroup::Overlay, "H", "hemisphere of the selected volume", {sign(SDLK_h)}},
    Action{ShowDiagnostics, ActionGroup::Overlay, "T", "where samples were invalid, paths lost, ...", {sign(SDLK_t)}},

    Action{Accuracy, ActionGroup::Compare, "P", "accuracy panel: error against time", {sign(SDLK_p)}},
    Action{CompareNext, ActionGroup::Compare, "C", "compare two pictures: next mode", {sign(SDLK_c)}},
    Action{
        CompareBack, ActionGroup::Compare, "Shift+C", "compare two pictures: previous mode", {sign(SDLK_c, kShift)}},
    Action{Flip, ActionGroup::Compare, "G", "flip to the other picture", {sign(SDLK_g)}},
    Action{Turns, ActionGroup::Compare, "X", "two methods in turns of equal time", {sign(SDLK_x)}},
    Action{
        MakeReference, ActionGroup::Compare, "Ctrl+R", "make the reference, or go on with it", {sign(SDLK_r, kCtrl)}},

    Action{HidePanels, ActionGroup::Window, "Tab", "hide or show the panels", {at(SDL_SCANCODE_TAB)}},
    Action{FullScreen, ActionGroup::Window, "F11", "full screen", {at(SDL_SCANCODE_F11)}},
    Action{Help, ActionGroup::Window, "F1 or ?", "this list", {at(SDL_SCANCODE_F1), at(SDL_SCANCODE_SLASH, kShift)}},
    Action{SelfTest, ActionGroup::Window, "F2", "self test: does this machine compute right?", {at(SDL_SCANCODE_F2)}},
    Action{Cancel, ActionGroup::Window, "Esc", "close, cancel or deselect", {at(SDL_SCANCODE_ESCAPE)}},

    Action{Reload, ActionGroup::File, "F5", "reload the scene", {at(SDL_SCANCODE_F5)}},
    Action{Screenshot, ActionGroup::File, "F12", "save the picture as PNG", {at(SDL_SCANCODE_F12)}},
    Action{ScreenshotWithPanels,
           ActionGroup::File,
           "Shift+F12",
           "save the whole window as PNG",
           {at(SDL_SCANCODE_F12, kShift)}},
    Action{Save, ActionGroup::File, "Ctrl+S", "save the picture as EXR and PNG", {sign(SDLK_s, kCtrl)}},
    Action{SaveField, ActionGroup::File, "Ctrl+Shift+S", "save what was learned", {sign(SDLK_s, kCtrlShift)}},
    Action{LoadField, ActionGroup::File, "Ctrl+L", "go on from what was saved last", {sign(SDLK_l, kCtrl)}},
    Action{CopyCommand, ActionGroup::File, "Ctrl+C", "copy as command line", {sign(SDLK_c, kCtrl)}},
    Action{Quit, ActionGroup::File, "Ctrl+Q", "quit", {sign(SDLK_q, kCtrl)}},
};

constexpr std::array kMouseActions{
    MouseAction{"left drag", "look around"},
    MouseAction{"right hold", "look around, pointer hidden"},
    MouseAction{"wheel", "speed"},
    MouseAction{"left click", "select the radiance volume there"},
    MouseAction{"wheel on plot", "zoom; dragging pans, a double click fits"},
    MouseAction{"drag on axis", "pictures at equal time, at equal error; right click: off"},
    MouseAction{"drop a file", "open an .obj or .json scene, or a saved .field"},
};

std::string code(const std::string& keys) {
    // "F1 or ?" is two keys.
    const std::size_t split = keys.find(" or ");
    if (split == std::string::npos) return fmt::format("`{}`", keys);
    return fmt::format("`{}` or `{}`", keys.substr(0, split), keys.substr(split + 4));
}

}  // namespace

std::span<const Action> all_actions() { return kActions; }
std::span<const MouseAction> mouse_actions() { return kMouseActions; }

const Action& info_of(ActionId id) {
    for (const Action& action : kActions)
        if (action.id == id) return action;
    return kActions.front();
}

const char* name_of(ActionGroup group) {
    switch (group) {
    case ActionGroup::Fly: return "Fly";
    case ActionGroup::Render: return "Render";
    case ActionGroup::Method: return "Method";
    case ActionGroup::View: return "View";
    case ActionGroup::Overlay: return "Overlays";
    case ActionGroup::Compare: return "Compare";
    case ActionGroup::Window: return "Window";
    case ActionGroup::File: return "File";
    }
    return "";
}

bool matches(const Action& action, const KeyStroke& stroke) {
    for (const Chord& chord : action.chords) {
        const bool same_key = (chord.by == Chord::By::Place && chord.key == stroke.scancode) ||
                              (chord.by == Chord::By::Symbol && chord.key == stroke.symbol);
        if (same_key && (action.is_held ? !stroke.modifiers.ctrl : chord.modifiers == stroke.modifiers)) return true;
    }
    return false;
}

std::optional<ActionId> find_action(const KeyStroke& stroke) {
    for (const Action& action : kActions)
        if (matches(action, stroke)) return action.id;
    return std::nullopt;
}

std::string key_table_markdown() {
    std::string text = "| | key | does |\n| --- | --- | --- |\n";
    std::string_view group;
    for (const Action& action : kActions) {
        const std::string_view name = name_of(action.group);
        text += fmt::format("| {} | {} | {} |\n", group == name ? "" : name, code(action.keys), action.text);
        group = name;
    }
    for (const MouseAction& action : kMouseActions)
        text += fmt::format("| {} | {} | {} |\n", &action == kMouseActions.data() ? "Mouse" : "", action.keys,
                            action.text);
    return text;
}

}  // namespace pl
