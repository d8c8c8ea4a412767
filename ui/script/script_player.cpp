#include "ui/script/script_player.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <SDL.h>

#include "core/base/error.h"
#include "ui/draw/imgui_draw.h"
#include "ui/model/viewer_model.h"
#include "ui/script/script_values.h"

namespace pl::ui {
namespace {

using Kind = ScriptCommand::Kind;

Uint16 sdl_modifiers(const Modifiers& modifiers) {
    int mod = KMOD_NONE;
    if (modifiers.shift) mod |= KMOD_LSHIFT;
    if (modifiers.ctrl) mod |= KMOD_LCTRL;
    if (modifiers.alt) mod |= KMOD_LALT;
    return static_cast<Uint16>(mod);
}

/// Kinds of input that begin something: messages before them are not their answer.
bool begins_input(Kind kind) {
    return kind == Kind::Down || kind == Kind::Wheel || kind == Kind::Key || kind == Kind::Tap ||
           kind == Kind::Drop || kind == Kind::Type;
}

Vec2f point_in(const Rect& frame, const ScriptCommand& command) {
    return {frame.x + static_cast<float>(command.x) * frame.width,
            frame.y + static_cast<float>(command.y) * frame.height};
}

/// The frame of a control of the last frame. Throws Error(Runtime) if there is none of this label.
const Rect& place_of(const ScriptCommand& command) {
    const auto& places = gui_memory().places;
    const auto place = places.find(command.text);
    if (place == places.end())
        throw Error(ErrorKind::Runtime,
                    fmt::format("{}: there is no control '{}' in the window", command.where, command.text));
    return place->second;
}

}  // namespace

ScriptPlayer::ScriptPlayer(std::vector<ScriptCommand> commands, SDL_Window* window)
    : commands_(std::move(commands)), window_(window) {}

void ScriptPlayer::step(ViewerModel& model, const Rect& image, double seconds) {
    note_moved();
    for (const KeyStroke& key : std::exchange(tapped_, {})) push_key(key, false);
    if (buttons_ == 0) SDL_SetModState(KMOD_NONE);  // of a wheel, or of a button that is up again
    while (next_ < commands_.size() && commands_[next_].frame <= frame_) {
        if (!run(commands_[next_], model, image, seconds)) return;  // the frame count stands still
        ++next_;
    }
    ++frame_;
    if (next_ == commands_.size()) model.window().requests.quit = true;
}

std::optional<std::filesystem::path> ScriptPlayer::take_shot() { return std::exchange(shot_, std::nullopt); }

std::string ScriptPlayer::value_of(const ScriptCondition& condition, const ViewerModel& model) const {
    return condition.name == "message" ? model.messages().texts_after(messages_before_)
                                       : script_value(model, condition.name);
}

void ScriptPlayer::require(const ScriptCommand& command, const ViewerModel& model) const {
    const ScriptCondition& condition = command.condition;
    const std::string actual = value_of(condition, model);
    if (!holds(condition, actual))
        throw Error(ErrorKind::Runtime, fmt::format("{}: expected {} {} {}, got '{}'", command.where, condition.name,
                                                    condition.op, condition.value, actual));
}

bool ScriptPlayer::wait(const ScriptCommand& command, const ViewerModel& model, double seconds) {
    if (holds(command.condition, value_of(command.condition, model))) {
        waiting_since_.reset();
        return true;
    }
    const std::uint64_t passes = model.status().all_passes;
    if (!waiting_since_) {
        waiting_since_ = seconds;
        passes_before_wait_ = passes;
    }
    const std::uint64_t waited = passes - passes_before_wait_;
    if (waited < command.most_passes && seconds - *waiting_since_ < kHangSeconds) return false;
    throw Error(ErrorKind::Runtime,
                fmt::format("{}: waited {} for {} {} {}, got '{}'", command.where,
                            waited < command.most_passes ? fmt::format("{:.0f} s and {} passes", kHangSeconds, waited)
                                                         : fmt::format("{} passes", waited),
                            command.condition.name, command.condition.op, command.condition.value,
                            value_of(command.condition, model)));
}

/// The layout may have moved a control since it was aimed at, as a line appears above it.
void ScriptPlayer::follow_control() {
    if (!aimed_at_ || !gui_memory().places.contains(aimed_at_->text)) return;
    const Vec2f point = point_in(place_of(*aimed_at_), *aimed_at_);
    if (point != pointer_) push_motion(point);
}

/// Whoever aims at a control must find it there, whatever the numbers beside it do.
void ScriptPlayer::note_moved() {
    GuiMemory& memory = gui_memory();
    std::erase_if(kept_places_, [&](const auto& kept) {
        const auto now = memory.places.find(kept.first);
        if (now == memory.places.end() || (now->second.x == kept.second.x && now->second.y == kept.second.y))
            return false;
        memory.moved += (memory.moved.empty() ? "" : ", ") + kept.first;
        return true;
    });
}

/// One event in each frame of the window.
bool ScriptPlayer::play_monkey(const ScriptCommand& command, ViewerModel& model, const Rect& image, double seconds) {
    if (!monkey_) monkey_.emplace(static_cast<std::uint64_t>(command.x), static_cast<int>(command.y));
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const auto next = monkey_->next({size.x, size.y}, gui_memory().places);
    ++monkey_frames_;
    if (next)
        run(*next, model, image, seconds);
    else
        monkey_.reset();
    return !next;
}

bool ScriptPlayer::run(const ScriptCommand& command, ViewerModel& model, const Rect& image, double seconds) {
    if (begins_input(command.kind)) messages_before_ = model.messages().count();
    const bool is_motion = command.kind == Kind::Move || command.kind == Kind::Aim || command.kind == Kind::AimPlot;
    if (is_motion) aimed_at_.reset();
    switch (command.kind) {
    case Kind::Move: push_motion({static_cast<float>(command.x), static_cast<float>(command.y)}); break;
    case Kind::Aim: push_motion(point_in(image, command)); break;
    case Kind::AimPlot: push_motion(point_in(model.window().plot.frame, command)); break;
    case Kind::AimAt:
        push_motion(point_in(place_of(command), command));
        aimed_at_ = command;
        break;
    case Kind::Down: SDL_SetModState(static_cast<SDL_Keymod>(sdl_modifiers(command.key.modifiers))); [[fallthrough]];
    case Kind::Up:
        follow_control();
        push_button(command.button, command.kind == Kind::Down);
        break;
    case Kind::Wheel: {
        SDL_SetModState(static_cast<SDL_Keymod>(sdl_modifiers(command.key.modifiers)));
        SDL_Event event{};
        event.type = SDL_MOUSEWHEEL;
        event.wheel.windowID = SDL_GetWindowID(window_);
        event.wheel.y = static_cast<Sint32>(command.x);
        SDL_PushEvent(&event);
        break;
    }
    case Kind::Key: push_key(command.key, true); break;
    case Kind::KeyUp: push_key(command.key, false); break;
    case Kind::Tap:
        push_key(command.key, true);
        tapped_.push_back(command.key);
        break;
    case Kind::Resize: SDL_SetWindowSize(window_, static_cast<int>(command.x), static_cast<int>(command.y)); break;
    case Kind::Drop: {
        SDL_Event event{};
        event.type = SDL_DROPFILE;
        event.drop.windowID = SDL_GetWindowID(window_);
        event.drop.file = SDL_strdup(command.text.c_str());
        SDL_PushEvent(&event);
        break;
    }
    case Kind::Type: push_text(command.text); break;
    case Kind::Monkey: return play_monkey(command, model, image, seconds);
    case Kind::KeepPlaces:
        kept_places_ = gui_memory().places;
        gui_memory().moved.clear();
        break;
    case Kind::Shot: shot_ = command.text; break;
    case Kind::Expect: require(command, model); break;
    case Kind::Wait: return wait(command, model, seconds);
    case Kind::Quit: model.window().requests.quit = true; break;
    }
    return true;
}

void ScriptPlayer::push_motion(Vec2f position) {
    SDL_Event event{};
    event.type = SDL_MOUSEMOTION;
    event.motion.windowID = SDL_GetWindowID(window_);
    event.motion.state = buttons_;
    event.motion.x = static_cast<Sint32>(std::lround(position.x));
    event.motion.y = static_cast<Sint32>(std::lround(position.y));
    event.motion.xrel = event.motion.x - static_cast<Sint32>(std::lround(pointer_.x));
    event.motion.yrel = event.motion.y - static_cast<Sint32>(std::lround(pointer_.y));
    pointer_ = position;
    SDL_PushEvent(&event);
}

void ScriptPlayer::push_button(int button, bool down) {
    SDL_Event event{};
    event.type = down ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
    event.button.windowID = SDL_GetWindowID(window_);
    event.button.button = static_cast<Uint8>(button);
    event.button.state = down ? SDL_PRESSED : SDL_RELEASED;
    event.button.clicks = 1;
    event.button.x = static_cast<Sint32>(std::lround(pointer_.x));
    event.button.y = static_cast<Sint32>(std::lround(pointer_.y));
    const auto mask = SDL_BUTTON(static_cast<unsigned int>(button));
    buttons_ = down ? buttons_ | mask : buttons_ & ~mask;
    SDL_PushEvent(&event);
}

void ScriptPlayer::push_text(const std::string& text) {
    SDL_Event event{};
    event.type = SDL_TEXTINPUT;
    event.text.windowID = SDL_GetWindowID(window_);
    SDL_strlcpy(event.text.text, text.c_str(), sizeof(event.text.text));
    SDL_PushEvent(&event);
}

void ScriptPlayer::push_key(const KeyStroke& key, bool down) {
    SDL_Event event{};
    event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
    event.key.windowID = SDL_GetWindowID(window_);
    event.key.state = down ? SDL_PRESSED : SDL_RELEASED;
    event.key.keysym.scancode = key.symbol != 0 ? SDL_GetScancodeFromKey(static_cast<SDL_Keycode>(key.symbol))
                                                : static_cast<SDL_Scancode>(key.scancode);
    event.key.keysym.sym = SDL_GetKeyFromScancode(event.key.keysym.scancode);
    event.key.keysym.mod = sdl_modifiers(key.modifiers);
    SDL_PushEvent(&event);
}

}  // namespace pl::ui
