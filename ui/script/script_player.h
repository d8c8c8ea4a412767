// Plays a script: pushes its input into the event queue of the window and checks its expectations.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ui/draw/layout.h"
#include "ui/script/monkey.h"
#include "ui/script/script.h"

struct SDL_Window;

namespace pl::ui {

class ViewerModel;

class ScriptPlayer {
public:
    static constexpr double kFrameSeconds = 1.0 / 60.0;
    /// Only a guard against waits without end while nothing is rendered, see also ScriptCommand::most_passes.
    static constexpr double kHangSeconds = 600.0;

    ScriptPlayer(std::vector<ScriptCommand> commands, SDL_Window* window);

    /// Runs the commands of the next frame. `image` is the rectangle of the picture, `seconds` the real time.
    /// Throws Error(Runtime) with file and line if an expectation fails or a wait hangs.
    void step(ViewerModel& model, const Rect& image, double seconds);

    /// The clock of the script: its frames at a sixtieth of a second. Clicks are timed by it, so that a slow frame makes
    /// no difference.
    double seconds() const { return (frame_ + monkey_frames_) * kFrameSeconds; }

    /// Random input is played, whose requests to quit do not count.
    bool ignores_quit() const { return monkey_.has_value(); }

    /// The file to save the finished frame to, once.
    std::optional<std::filesystem::path> take_shot();

private:
    bool run(const ScriptCommand& command, ViewerModel& model, const Rect& image, double seconds);
    bool play_monkey(const ScriptCommand& command, ViewerModel& model, const Rect& image, double seconds);
    bool wait(const ScriptCommand& command, const ViewerModel& model, double seconds);
    void require(const ScriptCommand& command, const ViewerModel& model) const;
    /// The value of a condition. "message" is every message since the last input: others may follow the one that is waited for.
    std::string value_of(const ScriptCondition& condition, const ViewerModel& model) const;
    void follow_control();
    void note_moved();
    void push_motion(Vec2f position);
    void push_button(int button, bool down);
    void push_text(const std::string& text);
    void push_key(const KeyStroke& key, bool down);

    std::vector<ScriptCommand> commands_;
    SDL_Window* window_;
    std::size_t next_ = 0;
    int frame_ = 0;
    std::optional<Monkey> monkey_;
    int monkey_frames_ = 0;                                 ///< in which random input was played
    std::optional<double> waiting_since_;                   ///< seconds of the real time at which a wait began
    std::uint64_t passes_before_wait_ = 0;                  ///< WorkerStatus::all_passes then
    std::uint64_t messages_before_ = 0;                     ///< the last input
    std::optional<ScriptCommand> aimed_at_;                 ///< the control under the pointer
    std::map<std::string, Rect, std::less<>> kept_places_;  ///< of controls that must not move
    std::vector<KeyStroke> tapped_;                         ///< keys that go up in the next frame
    std::optional<std::filesystem::path> shot_;
    Vec2f pointer_{0.0f};
    unsigned int buttons_ = 0;
};

}  // namespace pl::ui
