// The one table of what keys do. Dispatch, the help overlay, menu labels and the README's list all read it, so they
// cannot disagree. Knows key numbers, not the window library's headers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace pl {

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
    Pause,
    SinglePass,
    SwitchBackend,
    MethodDefault,
    MethodPrecomputed,
    MethodReinforcement,
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
    Help,
    SelfTest,
    FullScreen,
    Reload,
    Screenshot,
    ScreenshotWithPanels,
    Save,
    SaveField,
    LoadField,
    CopyCommand,
    Cancel,
    Quit,
};

/// Order of the help overlay and of the menus.
enum class ActionGroup { Fly, Render, Method, View, Overlay, Compare, Window, File };

struct Modifiers {
    bool shift = false;
    bool ctrl = false;
    bool alt = false;

    friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

/// A key as the window reports it.
struct KeyStroke {
    int scancode = 0;  ///< where the key is
    int symbol = 0;    ///< what is printed on it
    Modifiers modifiers;
};

/// A key that an action listens to: by place for keys that the hand finds (the same on every keyboard layout), by
/// symbol for those that the head remembers.
struct Chord {
    enum class By { None, Place, Symbol };
    By by = By::None;
    int key = 0;  ///< scancode or symbol
    Modifiers modifiers;
};

struct Action {
    ActionId id;
    ActionGroup group;
    const char* keys;  ///< as people read it
    const char* text;
    std::array<Chord, 3> chords;  ///< any of them
    bool is_held = false;         ///< acts as long as the key is down, whatever Shift and Alt do; never with Ctrl
};

/// What the mouse does: told in the same places, dispatched by ui/pointer_gesture.h.
struct MouseAction {
    const char* keys;
    const char* text;
};

std::span<const Action> all_actions();
std::span<const MouseAction> mouse_actions();
const Action& info_of(ActionId id);
const char* name_of(ActionGroup group);
inline constexpr int kActionGroupCount = 8;

/// The action of a key that goes down.
std::optional<ActionId> find_action(const KeyStroke& stroke);

/// Does one of the action's keys go down or stay down with this stroke?
bool matches(const Action& action, const KeyStroke& stroke);

/// The table in Markdown, for the README.
std::string key_table_markdown();

}  // namespace pl
