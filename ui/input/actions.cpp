#include "ui/input/actions.h"

#include <array>
#include <vector>

#include <SDL_keycode.h>
#include <SDL_scancode.h>

namespace pl::ui {
namespace {

using enum ActionId;
using Group = ActionGroup;

constexpr Modifiers kShift{.shift = true};
constexpr Modifiers kCtrl{.ctrl = true};
constexpr Modifiers kCtrlShift{.shift = true, .ctrl = true};

constexpr Chord at(int scancode, Modifiers modifiers = {}) { return {Chord::By::Place, scancode, modifiers}; }
constexpr Chord sign(int symbol, Modifiers modifiers = {}) { return {Chord::By::Symbol, symbol, modifiers}; }

std::vector<Action> actions_before_methods() {
    return {
        {MoveForward, Group::Fly, "W", "fly forward", {at(SDL_SCANCODE_W)}, true},
        {MoveBack, Group::Fly, "S", "fly back", {at(SDL_SCANCODE_S)}, true},
        {MoveLeft, Group::Fly, "A", "fly left", {at(SDL_SCANCODE_A)}, true},
        {MoveRight, Group::Fly, "D", "fly right", {at(SDL_SCANCODE_D)}, true},
        {MoveUp, Group::Fly, "E", "fly up", {at(SDL_SCANCODE_E)}, true},
        {MoveDown, Group::Fly, "Q", "fly down", {at(SDL_SCANCODE_Q)}, true},
        {Fast, Group::Fly, "Shift", "four times as fast", {at(SDL_SCANCODE_LSHIFT), at(SDL_SCANCODE_RSHIFT)}, true},
        {Slow, Group::Fly, "Alt", "a quarter as fast", {at(SDL_SCANCODE_LALT)}, true},
        {SpeedUp,
         Group::Fly,
         "+",
         "higher speed",
         {at(SDL_SCANCODE_EQUALS), at(SDL_SCANCODE_EQUALS, kShift), at(SDL_SCANCODE_KP_PLUS)}},
        {SpeedDown, Group::Fly, "-", "lower speed", {at(SDL_SCANCODE_MINUS), at(SDL_SCANCODE_KP_MINUS)}},
        {CameraHome,
         Group::Fly,
         "Home",
         "the whole picture if it is zoomed, else the scene's own camera",
         {at(SDL_SCANCODE_HOME)}},
        {LookAtPoint, Group::Fly, "F", "look at the selected point, and focus the lens on it", {sign(SDLK_f)}},
        {AddBookmark, Group::Fly, "F8", "bookmark the camera", {at(SDL_SCANCODE_F8)}},
        {NextBookmark, Group::Fly, "F9", "next bookmark", {at(SDL_SCANCODE_F9)}},
        {PreviousBookmark, Group::Fly, "Shift+F9", "previous bookmark", {at(SDL_SCANCODE_F9, kShift)}},
        {PlayPath, Group::Fly, "F10", "fly along the bookmarks, or stop", {at(SDL_SCANCODE_F10)}},

        {Undo,
         Group::Render,
         "Ctrl+Z",
         "undo the last change of settings, materials or camera",
         {sign(SDLK_z, kCtrl)}},
        {Redo,
         Group::Render,
         "Ctrl+Shift+Z",
         "do again what was undone; also Ctrl+Y",
         {sign(SDLK_z, kCtrlShift), sign(SDLK_y, kCtrl)}},
        {Pause, Group::Render, "Space", "pause or continue", {at(SDL_SCANCODE_SPACE)}},
        {SinglePass, Group::Render, "N", "one pass while paused", {sign(SDLK_n)}},
        {SwitchBackend, Group::Render, "B", "other back end: CPU or CUDA", {sign(SDLK_b)}},
        {Restart, Group::Render, "R", "restart the picture", {sign(SDLK_r)}},
        {Forget, Group::Render, "Ctrl+Shift+R", "restart and forget the learned field", {sign(SDLK_r, kCtrlShift)}},
    };
}

/// Digits by position, letters by symbol.
Action method_action(const MethodInfo& method) {
    Chord chord = sign(method.key);
    if (method.key >= '1' && method.key <= '9') chord = at(SDL_SCANCODE_1 + method.key - '1');
    if (method.key == '0') chord = at(SDL_SCANCODE_0);
    return {ChooseMethod, Group::Method, std::string(1, method.key), "method: " + std::string(method.name), {chord},
            false,        method.id};
}

std::vector<Action> actions_after_methods() {
    return {
        {NextEvent, Group::Method, "L", "light samples on or off", {sign(SDLK_l)}},

        {PreviousView, Group::View, ",", "previous view", {at(SDL_SCANCODE_COMMA)}},
        {NextView, Group::View, ".", "next view", {at(SDL_SCANCODE_PERIOD)}},
        {ExposureDown, Group::View, "[", "half a stop darker", {at(SDL_SCANCODE_LEFTBRACKET)}},
        {ExposureUp, Group::View, "]", "half a stop brighter", {at(SDL_SCANCODE_RIGHTBRACKET)}},
        {FollowExposure, Group::View, "O", "automatic exposure on or off", {sign(SDLK_o)}},
        {Denoise, Group::View, "Shift+N", "denoised preview of the first samples on or off", {sign(SDLK_n, kShift)}},
        {Zoom, Group::View, "Z", "zoom to single pixels, or the whole picture", {sign(SDLK_z)}},
        {Magnify, Group::View, "M", "magnifier beside the pointer, while held", {sign(SDLK_m)}, true},

        {Cells, Group::Overlay, "V", "tint by radiance volume (Voronoi cells)", {sign(SDLK_v)}},
        {CellsFainter, Group::Overlay, ";", "fainter tint", {at(SDL_SCANCODE_SEMICOLON)}},
        {CellsStronger, Group::Overlay, "'", "stronger tint", {at(SDL_SCANCODE_APOSTROPHE)}},
        {Hemisphere, Group::Overlay, "H", "hemisphere of the selected volume", {sign(SDLK_h)}},
        {LobesOrDome, Group::Overlay, "Shift+H", "hemisphere as lobes or as a glass dome", {sign(SDLK_h, kShift)}},
        {PinVolume, Group::Overlay, "K", "pin the selected volume, or unpin it", {sign(SDLK_k)}},
        {Flowers, Group::Overlay, "U", "lobes of many volumes", {sign(SDLK_u)}},
        {TracePaths, Group::Overlay, "J", "paths of the clicked pixel as lines", {sign(SDLK_j)}},
        {ShowGain, Group::Overlay, "Y", "mark where guiding gains or loses", {sign(SDLK_y)}},
        {ShowDiagnostics, Group::Overlay, "T", "mark pixels with invalid samples, lost paths, ...", {sign(SDLK_t)}},

        {Accuracy, Group::Compare, "P", "accuracy panel: error against time", {sign(SDLK_p)}},
        {CompareNext, Group::Compare, "C", "compare two pictures: next mode", {sign(SDLK_c)}},
        {CompareBack, Group::Compare, "Shift+C", "compare two pictures: previous mode", {sign(SDLK_c, kShift)}},
        {Flip, Group::Compare, "G", "flip to the other picture", {sign(SDLK_g)}},
        {Turns, Group::Compare, "X", "two runs in turns of equal time", {sign(SDLK_x)}},
        {MakeReference, Group::Compare, "Ctrl+R", "render the reference, or continue it", {sign(SDLK_r, kCtrl)}},

        {HidePanels, Group::Window, "Tab", "hide or show the panels", {at(SDL_SCANCODE_TAB)}},
        {FoldSettings, Group::Window, "F6", "fold or open the settings", {at(SDL_SCANCODE_F6)}},
        {FoldRight, Group::Window, "F7", "fold or open tabs and accuracy panel", {at(SDL_SCANCODE_F7)}},
        {KeyPanels,
         Group::Window,
         "Ctrl+Tab",
         "keyboard into the panels: arrows and Space; again: the next one; Esc leaves",
         {at(SDL_SCANCODE_TAB, kCtrl)}},
        {FullScreen, Group::Window, "F11", "full screen", {at(SDL_SCANCODE_F11)}},
        {SwitchLayout, Group::Window, "F3", "layout: Explore or Research", {at(SDL_SCANCODE_F3)}},
        {ResetWindow,
         Group::Window,
         "Ctrl+F3",
         "reset the window, and forget what is remembered of it",
         {at(SDL_SCANCODE_F3, kCtrl)}},
        {Cancel,
         Group::Window,
         "Esc",
         "close or end the topmost that is open or under way",
         {at(SDL_SCANCODE_ESCAPE)}},

        {Open, Group::File, "Ctrl+O", "open a scene", {sign(SDLK_o, kCtrl)}},
        {Reload, Group::File, "F5", "reload the scene", {at(SDL_SCANCODE_F5)}},
        {Screenshot, Group::File, "F12", "save the picture as PNG", {at(SDL_SCANCODE_F12)}},
        {ScreenshotWithPanels,
         Group::File,
         "Shift+F12",
         "save the whole window as PNG",
         {at(SDL_SCANCODE_F12, kShift)}},
        {SaveView,
         Group::File,
         "Ctrl+F12",
         "save the picture as it is seen, with all over it",
         {at(SDL_SCANCODE_F12, kCtrl)}},
        {Save, Group::File, "Ctrl+S", "save the picture as EXR and PNG", {sign(SDLK_s, kCtrl)}},
        {SaveField, Group::File, "Ctrl+Shift+S", "save the learned field", {sign(SDLK_s, kCtrlShift)}},
        {LoadField, Group::File, "Ctrl+L", "continue from the newest saved field", {sign(SDLK_l, kCtrl)}},
        {CopyView,
         Group::File,
         "Ctrl+Shift+C",
         "copy the picture as it is seen, with all over it",
         {sign(SDLK_c, kCtrlShift)}},
        {CopyCommand, Group::File, "Ctrl+C", "copy as command line", {sign(SDLK_c, kCtrl)}},
        {Paste, Group::File, "Ctrl+V", "open the copied file or picture", {sign(SDLK_v, kCtrl)}},
        {Quit, Group::File, "Ctrl+Q", "quit", {sign(SDLK_q, kCtrl)}},

        {Help, Group::Help, "F1 or ?", "keys and mouse", {at(SDL_SCANCODE_F1), at(SDL_SCANCODE_SLASH, kShift)}},
        {Tour, Group::Help, "F4", "guided tour: begin, leave or continue", {at(SDL_SCANCODE_F4)}},
        {SelfTest, Group::Help, "F2", "self test of all back ends", {at(SDL_SCANCODE_F2)}},
        {About, Group::Help, "Shift+F1", "about pathlight", {at(SDL_SCANCODE_F1, kShift)}},
    };
}

std::vector<Action> make_actions() {
    std::vector<Action> actions = actions_before_methods();
    for (const MethodInfo& method : all_methods()) actions.push_back(method_action(method));
    for (Action& action : actions_after_methods()) actions.push_back(std::move(action));
    return actions;
}

constexpr std::array kMouseActions{
    MouseAction{"left drag", "look around"},
    MouseAction{"right hold", "look around, pointer hidden"},
    MouseAction{"middle drag", "orbit around the selected point; also Alt+left drag"},
    MouseAction{"Shift+drag", "move the camera across its view"},
    MouseAction{"wheel", "speed"},
    MouseAction{"Ctrl+wheel",
                "zoom the picture around the pointer; Ctrl+drag moves it, a double click shows all of it"},
    MouseAction{"left click", "select the radiance volume and the material"},
    MouseAction{"wheel on plot", "zoom; dragging pans, a double click fits"},
    MouseAction{"drag on axis", "pictures at equal time, at equal error; right click: off"},
    MouseAction{"drag on border", "size of the panel; a double click makes it automatic, the arrow folds it"},
    MouseAction{"drop a file",
                "open an .obj, .gltf, .glb, .xml or .json scene, or a saved .field; compare with a picture"},
};

}  // namespace

std::span<const Action> all_actions() {
    static const std::vector<Action> kActions = make_actions();
    return kActions;
}

std::span<const MouseAction> mouse_actions() { return kMouseActions; }

const Action& info_of(ActionId id) {
    for (const Action& action : all_actions())
        if (action.id == id) return action;
    return all_actions().front();
}

const char* name_of(ActionGroup group) {
    switch (group) {
    case Group::Fly: return "Fly";
    case Group::Render: return "Render";
    case Group::Method: return "Method";
    case Group::View: return "View";
    case Group::Overlay: return "Overlays";
    case Group::Compare: return "Compare";
    case Group::Window: return "Window";
    case Group::File: return "File";
    case Group::Help: return "Help";
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

const Action* find_action(const KeyStroke& stroke) {
    for (const Action& action : all_actions())
        if (matches(action, stroke)) return &action;
    return nullptr;
}

}  // namespace pl::ui
