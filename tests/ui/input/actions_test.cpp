#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <SDL.h>

#include "tests/support/catch.hpp"
#include "ui/input/actions.h"

using namespace pl;
using namespace pl::ui;

namespace {

/// Every stroke that should trigger a chord, on the default keyboard layout.
std::vector<KeyStroke> strokes_of(const Action& action, const Chord& chord) {
    std::vector<KeyStroke> strokes;
    if (chord.by == Chord::By::None) return strokes;
    KeyStroke stroke;
    if (chord.by == Chord::By::Place) {
        stroke.scancode = chord.key;
        stroke.symbol = SDL_GetKeyFromScancode(static_cast<SDL_Scancode>(chord.key));
    } else {
        stroke.symbol = chord.key;
        stroke.scancode = SDL_GetScancodeFromKey(chord.key);
    }
    stroke.modifiers = chord.modifiers;
    strokes.push_back(stroke);
    if (!action.is_held) return strokes;
    // Held keys act with any combination of the speed modifiers.
    for (const Modifiers modifiers :
         {Modifiers{.shift = true}, Modifiers{.alt = true}, Modifiers{.shift = true, .alt = true}}) {
        stroke.modifiers = modifiers;
        strokes.push_back(stroke);
    }
    return strokes;
}

int count_matches(const KeyStroke& stroke) {
    int count = 0;
    for (const Action& action : all_actions()) count += matches(action, stroke) ? 1 : 0;
    return count;
}

/// "F1 or ?" is two keys.
std::string code(const std::string& keys) {
    const std::size_t split = keys.find(" or ");
    if (split == std::string::npos) return "`" + keys + "`";
    return "`" + keys.substr(0, split) + "` or `" + keys.substr(split + 4) + "`";
}

/// The table of the manual.
std::string key_table() {
    std::string text = "| | key | does |\n| --- | --- | --- |\n";
    std::string_view group;
    for (const Action& action : all_actions()) {
        const std::string_view name = name_of(action.group);
        text +=
            "| " + std::string(group == name ? "" : name) + " | " + code(action.keys) + " | " + action.text + " |\n";
        group = name;
    }
    for (const MouseAction& action : mouse_actions())
        text += std::string("| ") + (&action == mouse_actions().data() ? "Mouse" : "") + " | " + action.keys + " | " +
                action.text + " |\n";
    return text;
}

}  // namespace

TEST_CASE("Actions: every key has exactly one meaning") {
    // The tables between places and symbols exist only while the video part runs.
    SDL_setenv("SDL_VIDEODRIVER", "dummy", 1);
    REQUIRE(SDL_InitSubSystem(SDL_INIT_VIDEO) == 0);
    for (const Action& action : all_actions())
        for (const Chord& chord : action.chords)
            for (const KeyStroke& stroke : strokes_of(action, chord)) {
                INFO(action.keys << " (" << action.text << "), scancode " << stroke.scancode << ", shift "
                                 << stroke.modifiers.shift << ", alt " << stroke.modifiers.alt);
                CHECK(stroke.scancode != 0);
                CHECK(count_matches(stroke) == 1);
                CHECK(find_action(stroke) == &action);
            }
    SDL_QuitSubSystem(SDL_INIT_VIDEO);
}

TEST_CASE("Actions: every action is listed once, has a key and words for it") {
    std::set<ActionId> seen;
    std::vector<MethodId> seen_methods;
    for (const Action& action : all_actions()) {
        INFO(action.text);
        CHECK(seen.insert(action.id).second == (action.id != ActionId::ChooseMethod || seen_methods.empty()));
        CHECK(action.method.has_value() == (action.id == ActionId::ChooseMethod));
        if (action.method) seen_methods.push_back(*action.method);
        CHECK(action.chords[0].by != Chord::By::None);
        CHECK_FALSE(action.keys.empty());
        CHECK_FALSE(action.text.empty());
        if (!action.method) CHECK(&info_of(action.id) == &action);
    }
    CHECK(seen_methods.size() == all_methods().size());
    CHECK(seen.size() == static_cast<std::size_t>(ActionId::Quit) + 1);
}

TEST_CASE("Actions: flying keys work with Shift and Alt, and leave Ctrl to commands") {
    const KeyStroke s{SDL_SCANCODE_S, SDLK_s, {}};
    CHECK(find_action(s)->id == ActionId::MoveBack);
    CHECK(find_action({s.scancode, s.symbol, {.shift = true}})->id == ActionId::MoveBack);
    CHECK(find_action({s.scancode, s.symbol, {.ctrl = true}})->id == ActionId::Save);
    CHECK(find_action({SDL_SCANCODE_Q, SDLK_q, {.ctrl = true}})->id == ActionId::Quit);
    // Flying keys are found by place, commands by symbol: a French keyboard has Z in the place of W.
    CHECK(find_action({SDL_SCANCODE_W, SDLK_z, {}})->id == ActionId::MoveForward);
    CHECK(find_action({SDL_SCANCODE_A, SDLK_q, {.ctrl = true}})->id == ActionId::Quit);
    CHECK(find_action({SDL_SCANCODE_F13, SDLK_F13, {}}) == nullptr);
}

TEST_CASE("Actions: the table for the manual lists all of them") {
    const std::string table = key_table();
    for (const Action& action : all_actions()) CHECK_THAT(table, test::contains(action.text));
    for (const MouseAction& action : mouse_actions()) CHECK_THAT(table, test::contains(action.text));
    CHECK_THAT(table, test::contains("| `F1` or `?` | keys and mouse |"));
    const auto lines = static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n'));
    CHECK(lines == 2 + all_actions().size() + mouse_actions().size());
}

TEST_CASE("Actions: the manual holds the table that the program makes") {
    std::ifstream file(std::string(PL_SOURCE_DIR) + "/docs/manual.md");
    const std::string manual{std::istreambuf_iterator<char>(file), {}};
    CHECK_THAT(manual, test::contains(key_table()));
}
