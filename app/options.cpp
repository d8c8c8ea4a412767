#include "app/options.h"

#include <algorithm>
#include <array>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/generate.h"
#include "app/help.h"
#include "app/version.h"
#include "core/base/error.h"
#include "core/io/load_scene.h"
#include "core/io/nearest_name.h"

namespace pl {
namespace {

/// The parser's findings, before the options are applied.
struct Found {
    std::vector<GivenOption> given;
    std::string scene;
    std::vector<std::string> inputs;
    std::vector<const Question*> asked;
};

// clang-format off
constexpr auto kQuestions = std::to_array<Question>({
    {"-h,--help", "Print the usual options of the subcommand and exit",
     [](Command command, bool) { return command_help(command, false); }},
    {"--help-all", "Print all options of the subcommand and exit",
     [](Command command, bool) { return command_help(command, true); }},
    {"--version", "Print version, commit, compiler and back ends and exit",
     [](Command, bool) { return version_text(); }},
    {"--list-methods", "Print the methods and exit", [](Command, bool json) { return method_list(json); }},
    {"--list-views", "Print the views and exit", [](Command, bool json) { return view_list(json); }},
    {"--licenses", "Print the licences of the program and its parts and exit",
     [](Command, bool) { return licenses_text(); }},
});
// clang-format on

[[noreturn]] void fail(const std::string& message) { throw Error(ErrorKind::Usage, message); }

bool is_option(const std::string& argument) { return argument.size() > 1 && argument.front() == '-'; }

bool is_scene(const std::string& word) {
    if (word.find_first_of("./") != std::string::npos) return true;
    const std::vector<std::string> known = list_scenes(find_assets_dir());
    return std::find(known.begin(), known.end(), word) != known.end();
}

constexpr std::string_view kHelpWord = "help";

std::optional<Command> command_named(std::string_view word) {
    for (const CommandInfo& info : all_commands())
        if (info.name == word) return info.id;
    return std::nullopt;
}

[[noreturn]] void fail_command(const std::string& word) {
    std::vector<std::string> commands{std::string(kHelpWord)};
    for (const CommandInfo& info : all_commands()) commands.emplace_back(info.name);
    std::vector<std::string> names = commands;
    for (const std::string& scene : list_scenes(find_assets_dir())) names.push_back(scene);
    const std::string hint = did_you_mean(word, names);
    fail(fmt::format("unknown subcommand '{}', and no scene of that name{} Subcommands are: {}", word,
                     hint.empty() ? "." : hint, fmt::join(commands, ", ")));
}

/// The subcommand, taken off the front of the arguments; `view` if they start with an option or a scene.
Command take_command(std::vector<std::string>& arguments) {
    if (arguments.empty() || is_option(arguments.front())) return Command::View;
    if (const std::optional<Command> command = command_named(arguments.front())) {
        arguments.erase(arguments.begin());
        return *command;
    }
    if (is_scene(arguments.front())) return Command::View;
    fail_command(arguments.front());
}

/// `pathlight help`, which may be followed by a subcommand; nothing if the arguments do not begin so.
std::optional<std::string> help_asked_for(const std::vector<std::string>& arguments) {
    if (arguments.empty() || arguments.front() != kHelpWord) return std::nullopt;
    if (arguments.size() == 1) return program_help();
    if (arguments.size() > 2)
        fail(fmt::format("'{}': expected one subcommand, got {}", kHelpWord,
                         fmt::join(arguments.begin() + 1, arguments.end(), " ")));
    if (const std::optional<Command> command = command_named(arguments[1])) return command_help(*command, false);
    fail_command(arguments[1]);
}

void add_option(CLI::App& app, const OptionSpec& spec, Found& found) {
    const std::string flags(spec.flags);
    const auto note = [&spec, &found](const std::string& text) { found.given.push_back({&spec, text}); };
    if (spec.value.empty()) {
        app.add_flag_function(flags, [note](std::int64_t times) {
            for (std::int64_t i = 0; i < times; ++i) note("");
        });
    } else {
        const auto note_all = [note](const std::vector<std::string>& texts) {
            std::for_each(texts.begin(), texts.end(), note);
        };
        CLI::Option* const option = app.add_option_function<std::vector<std::string>>(flags, note_all);
        option->expected(1)->allow_extra_args(false);
        option->multi_option_policy(spec.repeatable ? CLI::MultiOptionPolicy::TakeAll
                                                    : CLI::MultiOptionPolicy::TakeLast);
    }
}

void add_options(CLI::App& app, Command command, Found& found) {
    app.set_help_flag();
    app.allow_extras();
    for (const OptionSpec& spec : option_table())
        if (spec.commands.has(command)) add_option(app, spec, found);
    for (const Question& question : kQuestions)
        app.add_flag_function(std::string(question.flags), [&](std::int64_t) { found.asked.push_back(&question); });
    switch (info_of(command).inputs) {
    case Inputs::Nothing: break;
    case Inputs::Scene: app.add_option("SCENE,--scene", found.scene)->take_last(); break;
    case Inputs::Scenes:
    case Inputs::Folder:
    case Inputs::Pictures: app.add_option("INPUTS", found.inputs)->expected(-1); break;
    }
}

/// Fails for arguments that the parser could not place.
void refuse(const CLI::App& app, Command command, const std::vector<std::string>& extras) {
    const auto unknown = std::find_if(extras.begin(), extras.end(), is_option);
    const std::string command_word(command_name(command));
    if (unknown == extras.end())
        fail(fmt::format("unexpected argument '{}': '{}' takes {}; a subcommand has to come first", extras.front(),
                         command_word, info_of(command).inputs == Inputs::Nothing ? "options only" : "one SCENE"));
    const std::string word = unknown->substr(0, unknown->find('='));
    std::vector<std::string> known;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    fail(fmt::format("unknown option '{}' of '{}'{}", word, command_word, did_you_mean(word, known)));
}

Found parse(Command command, std::vector<std::string> arguments) {
    Found found;
    CLI::App app;
    add_options(app, command, found);
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them in reverse
    try {
        app.parse(arguments);
    } catch (const CLI::ParseError& error) {
        fail(error.what());
    }
    if (const std::vector<std::string> extras = app.remaining(); !extras.empty()) refuse(app, command, extras);
    // The specifications lie in one array, so their addresses are in the order of the table.
    std::stable_sort(found.given.begin(), found.given.end(),
                     [](const GivenOption& a, const GivenOption& b) { return a.spec < b.spec; });
    return found;
}

void require_complete(Command command, const Options& options) {
    const bool needs_file = command == Command::Render || command == Command::Inspect || command == Command::Convert;
    const bool needs_folder =
        command == Command::Replay || command == Command::Reference || command == Command::Bench;
    if (options.scene.empty() && options.inputs.empty() && options.suite == kNoPreset &&
        (needs_file || needs_folder || command == Command::Info || command == Command::Trace))
        fail(fmt::format(
            "'{}' needs a SCENE: a name ({}), an .obj, .gltf, .glb or Mitsuba .xml file, or a scene .json file",
            command_name(command), fmt::join(list_scenes(find_assets_dir()), ", ")));
    if (options.output.empty() && needs_file)
        fail(fmt::format("'{}' needs a file to write: -o FILE", command_name(command)));
    if (options.output.empty() && needs_folder)
        fail(fmt::format("'{}' needs a folder to write to: -o DIR", command_name(command)));
    if (command == Command::Replay && options.camera_path.empty()) fail("'replay' needs a camera path: --path FILE");
    if (command == Command::Inspect && options.at.has_value() == options.pixel.has_value())
        fail("'inspect' needs a place: either --at X,Y,Z[,NX,NY,NZ] or --pixel X,Y");
    const bool is_whole = !options.diagnostics_file.empty() || !options.gain_file.empty();
    const bool has_path = options.pixel && options.samples.has_value() != options.why;
    if (is_whole && (options.pixel || options.samples || options.why || !options.output.empty()))
        fail("'trace': --diagnostics and --gain are about the whole picture: expected no --pixel, --sample, --why, "
             "-o");
    if (command == Command::Trace && !is_whole && !has_path)
        fail("'trace' needs a path: --pixel X,Y and --sample N[-M], or --why in place of --sample; or, for the whole "
             "picture, --diagnostics FILE or --gain FILE");
    if (command == Command::Trace && options.why && !options.output.empty())
        fail("'trace --why' prints figures and draws no lines: -o FILE goes with --sample N[-M]");
    if (options.suite != kNoPreset && !options.inputs.empty())
        fail(fmt::format("--suite: expected no SCENE with it, got {}", options.inputs.front()));
    if (command == Command::Report && options.inputs.size() != 1)
        fail(fmt::format("'report' needs one folder of 'bench', DIR: got {}", options.inputs.size()));
    if (command == Command::Score && options.inputs.size() != 1)
        fail(fmt::format("'score' needs one folder with score.json, DIR: got {}", options.inputs.size()));
    if (command == Command::Compare && options.inputs.size() != 2)
        fail(fmt::format("'compare' needs two pictures, IMAGE REFERENCE: got {}", options.inputs.size()));
}

}  // namespace

bool is_given(const std::vector<GivenOption>& given, std::string_view name) {
    return std::ranges::any_of(given, [&](const GivenOption& option) { return option.spec->name == name; });
}

std::span<const Question> all_questions() { return kQuestions; }

CommandLine parse_command_line(const std::vector<std::string>& arguments) {
    CommandLine line;
    if (arguments.size() == 2 && arguments.front() == "--generate") {
        line.answer = generated_page(arguments.back());
        return line;
    }
    line.answer = help_asked_for(arguments);
    if (line.answer) return line;
    std::vector<std::string> rest = arguments;
    const bool bare = rest.empty() || is_option(rest.front());
    line.command = take_command(rest);
    Found found = parse(line.command, rest);
    line.given = std::move(found.given);
    if (!found.asked.empty()) {
        const Question& question = *found.asked.front();
        line.answer = bare && &question == kQuestions.data()
                          ? program_help()
                          : question.answer(line.command, is_given(line.given, "json"));
        return line;
    }
    for (const GivenOption& given : line.given) apply_option(*given.spec, line.options, given.text);
    line.has_scene = !found.scene.empty();
    line.options.scene = found.scene.empty() && line.command == Command::View ? "cornell" : found.scene;
    line.options.inputs = std::move(found.inputs);
    require_complete(line.command, line.options);
    return line;
}

}  // namespace pl
