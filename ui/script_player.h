// Plays a script: pushes what a person would do into the window's queue of events, checks what the script expects.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "ui/layout.h"
#include "ui/script.h"

struct SDL_Window;

namespace pl {

class ViewerModel;

class ScriptPlayer {
public:
    static constexpr double kFrameSeconds = 1.0 / 60.0;
    static constexpr double kLongestWaitSeconds = 120.0;

    ScriptPlayer(std::vector<ScriptCommand> commands, SDL_Window* window);

    /// Does what belongs to the next frame. `image` is where the picture is, `seconds` the real time.
    /// Throws Error(Runtime) with file and line if an expectation fails or a wait takes too long.
    void step(ViewerModel& model, const Rect& image, double seconds);

    /// File that the finished frame should be saved to, once.
    std::optional<std::filesystem::path> take_shot();

private:
    bool run(const ScriptCommand& command, ViewerModel& model, const Rect& image, double seconds);
    bool wait(const ScriptCommand& command, const ViewerModel& model, double seconds);
    void push_motion(Vec2f position);
    void push_button(int button, bool down);
    void push_key(const KeyStroke& key, bool down);

    std::vector<ScriptCommand> commands_;
    SDL_Window* window_;
    std::size_t next_ = 0;
    int frame_ = 0;
    std::optional<double> waiting_since_;
    std::vector<KeyStroke> tapped_;  ///< keys that go up in the next frame
    std::optional<std::filesystem::path> shot_;
    Vec2f pointer_{0.0f};
    unsigned int buttons_ = 0;
};

}  // namespace pl
