// Random input for a script, as of hands on mouse and keyboard. The same seed and the same windows give the same input.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "ui/draw/layout.h"
#include "ui/script/script.h"

namespace pl::ui {

class Monkey {
public:
    using Places = std::map<std::string, Rect, std::less<>>;  ///< controls by their labels, as in GuiMemory

    Monkey(std::uint64_t seed, int events) : random_(seed), left_(events) {}

    /// The next piece of input, for a window of this size; empty when all have been played and every key and button is up again.
    /// It never quits by key or label.
    std::optional<ScriptCommand> next(Vec2f window, const Places& places);

private:
    using Kind = ScriptCommand::Kind;

    void plan(Vec2f window, const Places& places);
    void plan_click(Vec2f window, const Places& places);
    void plan_drag(Vec2f window, const Places& places);
    void plan_key();
    void plan_typing();
    void release_all();
    void aim(Vec2f window, const Places& places);
    void move(Vec2f window);
    void press(int button);
    std::size_t below(std::size_t count);
    double unit();

    std::mt19937_64 random_;
    int left_;
    std::deque<ScriptCommand> planned_;
    std::vector<KeyStroke> held_;
};

}  // namespace pl::ui
