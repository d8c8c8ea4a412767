#include "ui/script/script.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <SDL_keyboard.h>
#include <SDL_mouse.h>

#include "core/base/error.h"
#include "ui/script/script_values.h"

namespace pl::ui {
namespace {

using Kind = ScriptCommand::Kind;

struct CommandWord {
    std::string_view word;
    Kind kind;
};
constexpr std::array kWords{
    CommandWord{"move", Kind::Move},        CommandWord{"aim", Kind::Aim},
    CommandWord{"aim_plot", Kind::AimPlot}, CommandWord{"aim_at", Kind::AimAt},
    CommandWord{"down", Kind::Down},        CommandWord{"up", Kind::Up},
    CommandWord{"wheel", Kind::Wheel},      CommandWord{"key", Kind::Key},
    CommandWord{"keyup", Kind::KeyUp},      CommandWord{"tap", Kind::Tap},
    CommandWord{"resize", Kind::Resize},    CommandWord{"drop", Kind::Drop},
    CommandWord{"type", Kind::Type},        CommandWord{"monkey", Kind::Monkey},
    CommandWord{"shot", Kind::Shot},        CommandWord{"expect", Kind::Expect},
    CommandWord{"wait", Kind::Wait},        CommandWord{"keep_places", Kind::KeepPlaces},
    CommandWord{"quit", Kind::Quit},
};
constexpr std::array<std::string_view, 7> kOperators{"==", "!=", "<", "<=", ">", ">=", "~"};

std::optional<double> to_number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// The words of one line, taken from the front.
class ScriptLine {
public:
    ScriptLine(std::string_view line, std::string where) : stream_(std::string(line)), where_(std::move(where)) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorKind::Input, fmt::format("{}: {}", where_, what));
    }
    std::optional<std::string> next() {
        std::string word;
        if (!(stream_ >> word)) return std::nullopt;
        return word;
    }
    std::string word(const char* what) {
        auto result = next();
        if (!result) fail(fmt::format("expected {}, got the end of the line", what));
        return *result;
    }
    double number(const char* what) {
        const std::string text = word(what);
        const auto value = to_number(text);
        // No window is that large; NaN is refused too.
        constexpr double kLargest = 1.0e6;
        if (!value || !(std::fabs(*value) <= kLargest)) fail(fmt::format("expected {}, got '{}'", what, text));
        return *value;
    }
    std::string rest(const char* what) {
        std::string text;
        std::getline(stream_ >> std::ws, text);
        while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.pop_back();
        if (text.empty()) fail(fmt::format("expected {}, got the end of the line", what));
        return text;
    }
    void end() {
        if (const auto extra = next()) fail(fmt::format("expected the end of the line, got '{}'", *extra));
    }
    const std::string& where() const { return where_; }

private:
    std::istringstream stream_;
    std::string where_;
};

int read_button(ScriptLine& line) {
    const std::string name = line.word("left, right or middle");
    if (name == "left") return SDL_BUTTON_LEFT;
    if (name == "right") return SDL_BUTTON_RIGHT;
    if (name == "middle") return SDL_BUTTON_MIDDLE;
    line.fail(fmt::format("expected left, right or middle, got '{}'", name));
}

/// The rest of the line.
Modifiers read_modifiers(ScriptLine& line) {
    Modifiers modifiers;
    while (const auto modifier = line.next()) {
        if (*modifier == "shift")
            modifiers.shift = true;
        else if (*modifier == "ctrl")
            modifiers.ctrl = true;
        else if (*modifier == "alt")
            modifiers.alt = true;
        else
            line.fail(fmt::format("expected shift, ctrl or alt, got '{}'", *modifier));
    }
    return modifiers;
}

KeyStroke read_key(ScriptLine& line) {
    const std::string name = line.word("a key");
    const SDL_Scancode scancode = SDL_GetScancodeFromName(name.c_str());
    if (scancode == SDL_SCANCODE_UNKNOWN)
        line.fail(fmt::format("expected the name of a key such as W, Space, F12 or [, got '{}'", name));
    return {scancode, 0, read_modifiers(line)};  // the symbol follows from the keyboard layout
}

ScriptCondition read_condition(ScriptLine& line) {
    ScriptCondition condition;
    condition.name = line.word("the name of a value");
    if (!is_script_value(condition.name))
        line.fail(fmt::format("unknown value '{}', expected one of: {}", condition.name, script_value_names()));
    condition.op = line.word("a comparison");
    if (std::ranges::find(kOperators, condition.op) == kOperators.end())
        line.fail(fmt::format("expected one of == != < <= > >= ~, got '{}'", condition.op));
    condition.value = line.rest("a value to compare with");
    return condition;
}

/// Takes " within N" off the end of a wait's value.
void read_limit(const ScriptLine& line, ScriptCommand& command) {
    constexpr std::string_view kWord = " within ";
    std::string& value = command.condition.value;
    const std::size_t at = value.rfind(kWord);
    if (at == std::string::npos) return;
    const std::string text = value.substr(at + kWord.size());
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), command.most_passes);
    if (error != std::errc{} || end != text.data() + text.size() || command.most_passes == 0)
        line.fail(fmt::format("expected a number of passes, a whole number from 1, got '{}'", text));
    value.resize(at);
}

void read_arguments(ScriptLine& line, ScriptCommand& command) {
    switch (command.kind) {
    case Kind::Move:
    case Kind::Aim:
    case Kind::AimPlot:
        command.x = line.number("x");
        command.y = line.number("y");
        break;
    case Kind::AimAt:
        command.x = line.number("x");
        command.y = line.number("y");
        command.text = line.rest("the label of a control");
        break;
    case Kind::Resize:
        command.x = line.number("a width");
        command.y = line.number("a height");
        if (command.x < 1.0 || command.y < 1.0) line.fail("expected a width and a height of at least 1");
        break;
    case Kind::Down:
        command.button = read_button(line);
        command.key.modifiers = read_modifiers(line);
        break;
    case Kind::Up: command.button = read_button(line); break;
    case Kind::Wheel:
        command.x = line.number("a number of notches");
        command.key.modifiers = read_modifiers(line);
        break;
    case Kind::Key:
    case Kind::KeyUp:
    case Kind::Tap: command.key = read_key(line); break;
    case Kind::Monkey:
        command.x = line.number("a seed");
        command.y = line.number("a number of events");
        if (command.x < 0.0 || command.y < 0.0) line.fail("expected a seed and a number of events of at least 0");
        break;
    case Kind::Type: command.text = line.rest("a text"); break;
    case Kind::Drop:
    case Kind::Shot: command.text = line.rest("a file name"); break;
    case Kind::Expect: command.condition = read_condition(line); break;
    case Kind::Wait:
        command.condition = read_condition(line);
        read_limit(line, command);
        break;
    case Kind::KeepPlaces:
    case Kind::Quit: break;
    }
    line.end();
}

std::string known_words() {
    std::string text;
    for (const CommandWord& entry : kWords) text += (text.empty() ? "" : ", ") + std::string(entry.word);
    return text;
}

ScriptCommand parse_line(std::string_view text, const std::string& where, int previous_frame) {
    ScriptLine line(text, where);
    ScriptCommand command;
    command.where = where;
    const double frame = line.number("a frame number");
    command.frame = static_cast<int>(std::clamp(frame, -1.0, 1.0e9));
    if (command.frame < 0 || static_cast<double>(command.frame) != frame)
        line.fail("expected a frame number, a whole number from 0");
    if (command.frame < previous_frame)
        line.fail(
            fmt::format("frame {} comes after frame {}: lines are in order of time", command.frame, previous_frame));
    const std::string word = line.word("a command");
    const auto entry = std::ranges::find(kWords, word, &CommandWord::word);
    if (entry == kWords.end())
        line.fail(fmt::format("unknown command '{}', expected one of: {}", word, known_words()));
    command.kind = entry->kind;
    read_arguments(line, command);
    return command;
}

}  // namespace

bool holds(const ScriptCondition& condition, const std::string& actual) {
    const auto a = to_number(actual);
    const auto b = to_number(condition.value);
    const bool numbers = a && b;
    const int order = numbers ? (*a < *b ? -1 : (*a > *b ? 1 : 0)) : actual.compare(condition.value);
    if (condition.op == "~") return actual.find(condition.value) != std::string::npos;
    if (condition.op == "==") return order == 0;
    if (condition.op == "!=") return order != 0;
    if (a.has_value() != b.has_value()) return false;  // "none" has no order with 2
    if (condition.op == "<") return order < 0;
    if (condition.op == "<=") return order <= 0;
    if (condition.op == ">") return order > 0;
    return order >= 0;
}

std::vector<ScriptCommand> parse_script(std::string_view text, const std::string& file_name) {
    std::vector<ScriptCommand> commands;
    int number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++number;
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
        const int previous = commands.empty() ? 0 : commands.back().frame;
        commands.push_back(parse_line(line, fmt::format("{}:{}", file_name, number), previous));
    }
    return commands;
}

std::vector<ScriptCommand> load_script(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    if (std::filesystem::is_directory(path) || !file || !(text << file.rdbuf()))
        throw Error(ErrorKind::Input, fmt::format("{}: cannot read the script", path.string()));
    return parse_script(text.str(), path.string());
}

}  // namespace pl::ui
