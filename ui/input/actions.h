// The one table of actions and their keys. Dispatch, the help overlay, menus and the documented list all read it, so
// that they cannot disagree. Knows key numbers, not the window library's headers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/session/methods.h"

namespace pl::ui {

enum class ActionId {
    MoveForward,
    MoveBack,
    MoveLeft,
    MoveRight,
    MoveUp,
    MoveDown,
    Fast,
    Slow,
    SpeedUp,
    SpeedDown,
    CameraHome,
    Restart,
    Forget,
    Undo,
    Redo,
    Pause,
    SinglePass,
    SwitchBackend,
    ChooseMethod,  ///< of Action::method: one action for each method
    NextEvent,
    PreviousView,
    NextView,
    ExposureDown,
    ExposureUp,
    Cells,
    CellsFainter,
    CellsStronger,
    Hemisphere,
    ShowDiagnostics,
    Accuracy,
    CompareNext,
    CompareBack,
    Flip,
    Turns,
    MakeReference,
    HidePanels,
    FoldSettings,
    FoldRight,
    Help,
    SelfTest,
    Tour,
    SwitchLayout,
    ResetWindow,
    FullScreen,
    Open,
    Reload,
    Screenshot,
    ScreenshotWithPanels,
    Save,
    SaveField,
    LoadField,
    CopyCommand,
    Paste,
    TracePaths,
    ShowGain,
    PinVolume,
    LobesOrDome,
    Flowers,
    LookAtPoint,
    AddBookmark,
    NextBookmark,
    PreviousBookmark,
    PlayPath,
    Denoise,
    Zoom,
    Magnify,
    FollowExposure,
    About,
    KeyPanels,
    SaveView,
    CopyView,
    Cancel,
    Quit,
};

/// Order of the help overlay and of the menus.
enum class ActionGroup { Fly, Render, Method, View, Overlay, Compare, Window, File, Help };

struct Modifiers {
    bool shift = false;
    bool ctrl = false;
    bool alt = false;

    friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

/// A key as the window reports it.
struct KeyStroke {
    int scancode = 0;  ///< position on the keyboard
    int symbol = 0;    ///< letter or sign of the keyboard layout
    Modifiers modifiers;
};

/// A key of an action: by position for keys found by hand (the same on every keyboard layout), by symbol for keys
/// remembered by their letter.
struct Chord {
    enum class By { None, Place, Symbol };
    By by = By::None;
    int key = 0;  ///< scancode or symbol
    Modifiers modifiers;
};

struct Action {
    ActionId id;
    ActionGroup group;
    std::string keys;  ///< as displayed
    std::string text;
    std::array<Chord, 3> chords;  ///< any of them triggers the action
    bool is_held = false;         ///< acts as long as the key is down, with or without Shift and Alt; never with Ctrl
    std::optional<MethodId> method{};
};

/// An action of the mouse, for the same lists; dispatched by PointerGesture.
struct MouseAction {
    const char* keys;
    const char* text;
};

/// The fixed actions, and one for each method with the key of its MethodInfo.
std::span<const Action> all_actions();
std::span<const MouseAction> mouse_actions();
/// The first action with this id.
const Action& info_of(ActionId id);
const char* name_of(ActionGroup group);
inline constexpr int kActionGroupCount = 9;

/// The action of a key press; null if the key has none.
const Action* find_action(const KeyStroke& stroke);

/// Whether the stroke is one of the action's keys.
bool matches(const Action& action, const KeyStroke& stroke);

}  // namespace pl::ui
