// Plays a script of input on the viewer without a screen: its model over fake back ends, its input router and its panels,
// in a window of SDL's dummy driver that nothing is drawn into.
#pragma once

#include <vector>

#include "ui/script/script.h"

namespace pl::test {
using namespace pl::ui;

/// Plays the commands, pauses between them shortened, so that any script takes milliseconds. Conditions are looked at and not
/// waited for: fake back ends meet few of them. Throws what the model throws, and std::logic_error if the model then holds
/// numbers that it never may.
void play_script(std::vector<ScriptCommand> commands);

}  // namespace pl::test
