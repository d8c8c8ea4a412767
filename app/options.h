// From words to options: the command line, the settings of a scene file, and back to a command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/option_table.h"
#include "core/scene/description.h"
#include "core/session/learned_field.h"

namespace pl {

/// One option that was given, as it was given.
struct GivenOption {
    const OptionSpec* spec = nullptr;
    std::string text;
};

struct CommandLine {
    Command command = Command::View;
    std::vector<GivenOption> given;     ///< in the order of option_table()
    Options options;                    ///< what was given, over the defaults; final only after resolve_options()
    std::optional<std::string> answer;  ///< help, version or a list: print this and do nothing else
};

/// `arguments` are without the program's name. Throws Error(Usage): unknown subcommand or option (the nearest one is
/// named), wrong value, something missing; Error(Input): the camera file.
CommandLine parse_command_line(const std::vector<std::string>& arguments);

/// Defaults, then the scene's camera and settings, then what was given. A field that was loaded brings its method and
/// settings; of these only the lookup may be given otherwise. Throws Error(Usage) for options that do not go together,
/// Error(Input) for settings of the scene that are wrong.
Options resolve_options(const CommandLine& line, const SceneDescription& scene, const LearnedField* loaded = nullptr);

/// What resolve_options() gives for a scene opened without options.
Options scene_defaults(const std::string& scene_name, const SceneDescription& scene);

/// The shell command that renders with these options: "pathlight render ...". Leaves out what equals `defaults`, for
/// which scene_defaults() of the same scene is right.
std::string command_text(const Options& options, const Options& defaults);

/// A word as a shell reads it back, in quotes where it needs them.
std::string shell_word(const std::string& text);

std::string_view command_name(Command command);

}  // namespace pl
