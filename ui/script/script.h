// Scripted input: keys and mouse as events of the real window, counted in frames of the window. The automated test of
// the user interface, on SDL's dummy driver. One command per line, '#' starts a comment:
//   FRAME move X Y | aim U V | aim_plot U V | aim_at U V LABEL | down B [MODS] | up B | wheel N [MODS]
//   FRAME key K [MODS] | keyup K
//   FRAME tap K [MODS] | resize W H | drop FILE
//   FRAME type TEXT | monkey SEED EVENTS | keep_places
//   FRAME shot FILE | expect NAME OP VALUE | wait NAME OP VALUE [within N] | quit
// B is left, right or middle; MODS are shift, ctrl, alt. `aim` points at the image: (0, 0) is its top left corner and
// (1, 1) its bottom right one. `aim_plot` points at the curves of the accuracy panel in the same way, and beyond (1, 1)
// at the numbers of its axes. `aim_at` points at the control with this label: also a tab or a button. OP is one of
// == != < <= > >= ~ (contains). `monkey` plays random input. From `keep_places` on the value `moved` collects the controls that leave
// their place; `cut` has those that reach beyond the right edge of their panel. The frame count stands still while a script waits, and meanwhile.
// A wait that has not come true after N further passes of any picture, 20000 unless given otherwise, ends the script as a failed
// expectation does. Passes, not seconds: no verdict depends on the speed of the machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ui/input/actions.h"

namespace pl::ui {

struct ScriptCondition {
    std::string name;
    std::string op;
    std::string value;
};

/// Numbers are compared as numbers, everything else as text. A number and a text have no order.
bool holds(const ScriptCondition& condition, const std::string& actual);

struct ScriptCommand {
    static constexpr std::uint64_t kMostPasses = 20000;

    enum class Kind {
        Move,
        Aim,
        AimPlot,
        AimAt,
        Down,
        Up,
        Wheel,
        Key,
        KeyUp,
        Tap,
        Resize,
        Drop,
        Type,
        Monkey,
        KeepPlaces,
        Shot,
        Expect,
        Wait,
        Quit
    };
    Kind kind = Kind::Quit;
    int frame = 0;
    std::string where;  ///< file:line, for messages
    double x = 0.0;     ///< also width, notches, seed
    double y = 0.0;     ///< also height, number of events
    int button = 0;     ///< SDL's number
    KeyStroke key{};
    std::string text;  ///< file name, label, typed text
    ScriptCondition condition;
    std::uint64_t most_passes = kMostPasses;  ///< that a wait may take
};

/// Throws Error(Input) with file and line.
std::vector<ScriptCommand> parse_script(std::string_view text, const std::string& file_name);
std::vector<ScriptCommand> load_script(const std::filesystem::path& path);

}  // namespace pl::ui
