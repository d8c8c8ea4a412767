#include "ui/script/monkey.h"

#include <algorithm>
#include <map>

#include <SDL_scancode.h>

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::ui;

namespace {

using CommandKind = ScriptCommand::Kind;

const Monkey::Places kPlaces{{"Pause", {10, 10, 80, 20}}, {"quit", {10, 40, 80, 20}}, {"Volume", {900, 10, 80, 20}}};

std::vector<ScriptCommand> all_of(Monkey monkey) {
    std::vector<ScriptCommand> commands;
    while (const auto command = monkey.next({1280.0f, 720.0f}, kPlaces)) commands.push_back(*command);
    return commands;
}

}  // namespace

TEST_CASE("Monkey: as many events as requested, the same ones for the same seed, and every kind of them") {
    const std::vector<ScriptCommand> commands = all_of(Monkey(3, 2000));
    CHECK(commands.size() >= 2000);
    CHECK(commands.size() < 2020);  // what is held at the end is let go
    const std::vector<ScriptCommand> again = all_of(Monkey(3, 2000));
    const std::vector<ScriptCommand> other = all_of(Monkey(4, 2000));
    const auto same = [](const ScriptCommand& a, const ScriptCommand& b) {
        return a.kind == b.kind && a.x == b.x && a.y == b.y && a.text == b.text && a.button == b.button &&
               a.key.scancode == b.key.scancode && a.key.symbol == b.key.symbol;
    };
    CHECK(std::ranges::equal(commands, again, same));
    CHECK_FALSE(std::ranges::equal(commands, other, same));
    std::map<CommandKind, int> counts;
    for (const ScriptCommand& command : commands) ++counts[command.kind];
    for (const CommandKind kind :
         {CommandKind::Move, CommandKind::AimAt, CommandKind::Down, CommandKind::Up, CommandKind::Wheel,
          CommandKind::Key, CommandKind::Tap, CommandKind::Type, CommandKind::Drop})
        CHECK(counts[kind] > 0);
}

TEST_CASE("Monkey: all keys and buttons are up at the end, and it does not quit") {
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
        std::map<int, int> keys, buttons;
        for (const ScriptCommand& command : all_of(Monkey(seed, 500))) {
            if (command.kind == CommandKind::Key) ++keys[command.key.scancode];
            if (command.kind == CommandKind::KeyUp) --keys[command.key.scancode];
            if (command.kind == CommandKind::Down) ++buttons[command.button];
            if (command.kind == CommandKind::Up) --buttons[command.button];
            CHECK(command.text != "quit");
            if (command.kind == CommandKind::Tap) {
                const Action* action = find_action(command.key);
                CHECK((action == nullptr || action->id != ActionId::Quit));
            }
            CHECK((command.x < 1280.0 && command.y < 720.0));
        }
        for (const auto& [key, down] : keys) CHECK(down == 0);
        for (const auto& [button, down] : buttons) CHECK(down == 0);
    }
}
