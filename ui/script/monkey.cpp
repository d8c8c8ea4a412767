#include "ui/script/monkey.h"

#include <array>
#include <iterator>

#include <SDL_mouse.h>
#include <SDL_scancode.h>

namespace pl::ui {
namespace {

using Kind = ScriptCommand::Kind;

constexpr std::array kButtons{SDL_BUTTON_LEFT, SDL_BUTTON_LEFT, SDL_BUTTON_LEFT, SDL_BUTTON_RIGHT, SDL_BUTTON_MIDDLE};
constexpr std::array kHeldKeys{SDL_SCANCODE_W, SDL_SCANCODE_S, SDL_SCANCODE_A,      SDL_SCANCODE_D,
                               SDL_SCANCODE_E, SDL_SCANCODE_Q, SDL_SCANCODE_LSHIFT, SDL_SCANCODE_LALT};
/// Keys of text fields and lists, besides the keys of the table of actions.
constexpr std::array kOtherKeys{SDL_SCANCODE_RETURN, SDL_SCANCODE_BACKSPACE, SDL_SCANCODE_DELETE, SDL_SCANCODE_UP,
                                SDL_SCANCODE_DOWN,   SDL_SCANCODE_LEFT,      SDL_SCANCODE_RIGHT,  SDL_SCANCODE_END,
                                SDL_SCANCODE_PAGEUP, SDL_SCANCODE_PAGEDOWN};
constexpr std::array kTyped{"0", "1", "7", "12", "-3", ".5", "1e3", "99999999", "nan", "/", "/tmp", "door", " "};
constexpr std::array kDropped{"cornell", "door", "no-such-file.obj", "no-such-file.field", ""};

ScriptCommand command_of(Kind kind) {
    ScriptCommand command;
    command.kind = kind;
    command.where = "monkey";
    return command;
}

ScriptCommand command_of(Kind kind, const KeyStroke& key) {
    ScriptCommand command = command_of(kind);
    command.key = key;
    return command;
}

KeyStroke stroke_of(int scancode, Modifiers modifiers = {}) { return {scancode, 0, modifiers}; }

}  // namespace

std::size_t Monkey::below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }

double Monkey::unit() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }

void Monkey::move(Vec2f window) {
    ScriptCommand command = command_of(Kind::Move);
    command.x = unit() * static_cast<double>(window.x);
    command.y = unit() * static_cast<double>(window.y);
    planned_.push_back(command);
}

/// At a control, or anywhere.
void Monkey::aim(Vec2f window, const Places& places) {
    if (places.empty() || below(4) == 0) {
        move(window);
        return;
    }
    const auto place = std::next(places.begin(), static_cast<std::ptrdiff_t>(below(places.size())));
    if (place->first == info_of(ActionId::Quit).text) return;
    ScriptCommand command = command_of(Kind::AimAt);
    command.x = unit();
    command.y = unit();
    command.text = place->first;
    planned_.push_back(command);
}

void Monkey::press(int button) {
    ScriptCommand down = command_of(Kind::Down);
    down.button = button;
    planned_.push_back(down);
}

void Monkey::plan_click(Vec2f window, const Places& places) {
    aim(window, places);
    const int button = kButtons[below(kButtons.size())];
    for (std::size_t clicks = below(8) == 0 ? 2 : 1; clicks > 0; --clicks) {
        press(button);
        planned_.push_back(planned_.back());
        planned_.back().kind = Kind::Up;
    }
}

void Monkey::plan_drag(Vec2f window, const Places& places) {
    aim(window, places);
    const int button = kButtons[below(kButtons.size())];
    press(button);
    for (std::size_t moves = 1 + below(4); moves > 0; --moves) move(window);
    planned_.push_back(command_of(Kind::Up));
    planned_.back().button = button;
}

void Monkey::plan_key() {
    const auto actions = all_actions();
    const std::size_t index = below(actions.size() + kOtherKeys.size());
    if (index >= actions.size()) {
        planned_.push_back(command_of(Kind::Tap, stroke_of(kOtherKeys[index - actions.size()])));
        return;
    }
    const Action& action = actions[index];
    if (action.id == ActionId::Quit) return;
    const Chord& chord = action.chords[0];
    if (!action.is_held) {
        KeyStroke stroke{chord.by == Chord::By::Place ? chord.key : 0, chord.by == Chord::By::Symbol ? chord.key : 0,
                         chord.modifiers};
        planned_.push_back(command_of(Kind::Tap, stroke));
    } else if (held_.size() < 3) {
        held_.push_back(stroke_of(kHeldKeys[below(kHeldKeys.size())]));
        planned_.push_back(command_of(Kind::Key, held_.back()));
    }
}

void Monkey::plan_typing() {
    planned_.push_back(command_of(Kind::Type));
    planned_.back().text = kTyped[below(kTyped.size())];
}

/// Of the keys that are held.
void Monkey::release_all() {
    for (const KeyStroke& key : held_) planned_.push_back(command_of(Kind::KeyUp, key));
    held_.clear();
}

void Monkey::plan(Vec2f window, const Places& places) {
    const std::size_t choice = below(100);
    if (choice < 40) {
        plan_click(window, places);
    } else if (choice < 52) {
        plan_drag(window, places);
    } else if (choice < 78) {
        plan_key();
    } else if (choice < 84) {
        plan_typing();
    } else if (choice < 90) {
        release_all();
    } else if (choice < 97) {
        planned_.push_back(command_of(Kind::Wheel));
        planned_.back().x = below(2) == 0 ? -1.0 : 1.0 + static_cast<double>(below(3));
    } else if (choice < 98) {
        planned_.push_back(command_of(Kind::Drop));
        planned_.back().text = kDropped[below(kDropped.size())];
    } else {
        move(window);
    }
}

std::optional<ScriptCommand> Monkey::next(Vec2f window, const Places& places) {
    while (planned_.empty() && left_ > 0) plan(window, places);
    if (planned_.empty()) release_all();
    if (planned_.empty()) return std::nullopt;
    ScriptCommand command = std::move(planned_.front());
    planned_.pop_front();
    --left_;
    return command;
}

}  // namespace pl::ui
