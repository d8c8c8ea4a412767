#include <SDL_mouse.h>
#include <SDL_scancode.h>

#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "ui/script/script.h"
#include "ui/script/script_values.h"

using namespace pl;
using namespace pl::ui;

namespace {

std::string message_of(const std::string& text) {
    try {
        parse_script(text, "tour.script");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Input);
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("Script: every command is understood") {
    const auto commands = parse_script("# a tour\n"
                                       "0 move 10 20\n"
                                       "  1 aim 0.5 .25   # the middle\r\n"
                                       "\n"
                                       "2 down left\n2 up right\n3 wheel -2\n4 key W shift alt\n5 keyup W\n"
                                       "6 tap F12 shift\n7 resize 1280 720\n8 drop a file.obj\n9 shot out dir/a.png\n"
                                       "10 expect method == default\n11 wait spp >= 16\n12 keep_places\n13 quit\n"
                                       "14 aim_plot 0.5 1.1\n15 type a text\n16 monkey 7 100",
                                       "tour.script");
    using Kind = ScriptCommand::Kind;
    const std::vector<Kind> kinds{Kind::Move,    Kind::Aim,    Kind::Down,  Kind::Up,         Kind::Wheel,
                                  Kind::Key,     Kind::KeyUp,  Kind::Tap,   Kind::Resize,     Kind::Drop,
                                  Kind::Shot,    Kind::Expect, Kind::Wait,  Kind::KeepPlaces, Kind::Quit,
                                  Kind::AimPlot, Kind::Type,   Kind::Monkey};
    REQUIRE(commands.size() == kinds.size());
    for (std::size_t i = 0; i < kinds.size(); ++i) CHECK(commands[i].kind == kinds[i]);
    CHECK(commands[0].where == "tour.script:2");
    CHECK(commands[1].frame == 1);
    CHECK(commands[1].y == 0.25);
    CHECK(commands[2].button == SDL_BUTTON_LEFT);
    CHECK(commands[4].x == -2.0);
    CHECK(commands[5].key.scancode == SDL_SCANCODE_W);
    CHECK(commands[5].key.modifiers == Modifiers{.shift = true, .ctrl = false, .alt = true});
    CHECK(commands[9].text == "a file.obj");
    CHECK(commands[10].text == "out dir/a.png");
    CHECK(commands[12].condition.value == "16");
    CHECK(commands[12].condition.name == "spp");
    CHECK(commands[12].condition.op == ">=");
    CHECK(commands[15].y == 1.1);
    CHECK(commands[16].text == "a text");
    CHECK(commands[17].x == 7.0);
    CHECK(commands[17].y == 100.0);
    CHECK(parse_script("", "x").empty());
}

TEST_CASE("Script: a wait has a limit in passes") {
    const auto commands = parse_script("0 wait headline ~ no pixel within sight within 12\n0 wait spp >= 7\n"
                                       "0 wait spp >= 3\n0 expect headline ~ within 12",
                                       "x");
    CHECK(commands[0].condition.value == "no pixel within sight");
    CHECK(commands[0].most_passes == 12);
    CHECK(commands[1].most_passes == ScriptCommand::kMostPasses);
    CHECK(commands[2].most_passes == ScriptCommand::kMostPasses);
    CHECK(commands[3].condition.value == "within 12");  // an expectation waits for nothing
}

TEST_CASE("Script: a bad line names file, line and what was expected") {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"0 move 1 2\nx quit", "tour.script:2: expected a frame number, got 'x'"},
        {"1.5 quit", "tour.script:1: expected a frame number, a whole number"},
        {"-1 quit", "tour.script:1: expected a frame number, a whole number"},
        {"5 quit\n3 quit", "tour.script:2: frame 3 comes after frame 5"},
        {"0", "tour.script:1: expected a command, got the end of the line"},
        {"0 jump", "unknown command 'jump', expected one of: move, aim"},
        {"0 move 1", "expected y, got the end of the line"},
        {"0 move 1 2 3", "expected the end of the line, got '3'"},
        {"0 move 1 nan2", "expected y, got 'nan2'"},
        {"0 move nan 1", "expected x, got 'nan'"},
        {"0 wheel 1e300", "got '1e300'"},
        {"0 down thumb", "expected left, right or middle, got 'thumb'"},
        {"0 key Hyper", "expected the name of a key"},
        {"0 key W meta", "expected shift, ctrl or alt, got 'meta'"},
        {"0 resize 0 5", "expected a width and a height of at least 1"},
        {"0 type", "expected a text, got the end of the line"},
        {"0 monkey 1", "expected a number of events, got the end of the line"},
        {"0 monkey -1 5", "expected a seed and a number of events of at least 0"},
        {"0 shot", "expected a file name, got the end of the line"},
        {"0 expect colour == red", "unknown value 'colour', expected one of: method"},
        {"0 expect method = default", "expected one of == != < <= > >= ~, got '='"},
        {"0 expect method ==", "expected a value to compare with"},
        {"0 wait spp >= 9 within 0", "expected a number of passes, a whole number from 1, got '0'"},
        {"0 wait spp >= 9 within -1", "got '-1'"},
        {"0 wait spp >= 9 within 1.5", "got '1.5'"},
        {"0 wait spp >= 9 within 5 s", "got '5 s'"},
        {"0 wait spp >= 9 within 18446744073709551616", "got '18446744073709551616'"},
    };
    for (const auto& [script, part] : cases) {
        INFO(script);
        CHECK_THAT(message_of(script), test::contains(part));
    }
    CHECK_THROWS_AS(load_script("/nonexistent/tour.script"), Error);
    CHECK_THROWS_AS(load_script("/"), Error);
}

TEST_CASE("Script: conditions compare numbers as numbers and words as words") {
    const auto check = [](const char* op, const char* value, const char* actual) {
        return holds({"x", op, value}, actual);
    };
    CHECK(check("==", "1.0", "1"));
    CHECK(check("<", "10", "9"));
    CHECK_FALSE(check("<", "9", "10"));
    CHECK(check(">=", "2", "2"));
    CHECK(check("!=", "default", "precomputed"));
    CHECK(check("~", "com", "precomputed"));
    CHECK_FALSE(check("~", "x", "precomputed"));
    CHECK(check("==", "yes", "yes"));
    CHECK(check(">", "-2", "-1.5"));
    CHECK_FALSE(check(">=", "2", "none"));
    CHECK_FALSE(check("<", "2", "none"));
    CHECK(check("!=", "2", "none"));
}
