// From text to options: the command line and the settings of a scene file; and back to a command line.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/option_table.h"
#include "core/scene/description.h"
#include "core/session/learned_field.h"

namespace pl {

/// One option of the command line, with its text.
struct GivenOption {
    const OptionSpec* spec = nullptr;
    std::string text;
};

struct CommandLine {
    Command command = Command::View;
    std::vector<GivenOption> given;     ///< in the order of option_table()
    Options options;                    ///< the defaults and the given options; final only after resolve_options()
    bool has_scene = false;             ///< one was named
    std::optional<std::string> answer;  ///< help, version or a list: print this and do nothing else
};

/// `arguments` are without the program's name. Throws Error(Usage) for an unknown subcommand or option (with the
/// nearest known one), a wrong value or a missing argument; Error(Input) for the camera file.
CommandLine parse_command_line(const std::vector<std::string>& arguments);

/// Whether an option of this name is among them.
bool is_given(const std::vector<GivenOption>& given, std::string_view name);

/// An option of every subcommand that is answered, after which the program ends.
struct Question {
    std::string_view flags;  ///< all spellings: "-h,--help"
    std::string_view help;
    std::string (*answer)(Command, bool json);
};
std::span<const Question> all_questions();

/// Defaults, then the scene's camera and settings, then the given options. A loaded field brings its method and
/// settings, of which only the lookup may be given otherwise. Throws Error(Usage) for options that exclude each
/// other, Error(Input) for invalid settings of the scene.
Options resolve_options(const CommandLine& line, const SceneDescription& scene, const LearnedField* loaded = nullptr);

/// Throws Error(Usage) if --pixel is given and outside of the picture.
void require_pixel_inside(const Options& options);

/// resolve_options() of a scene opened without options.
Options scene_defaults(const std::string& scene_name, const SceneDescription& scene);

/// The shell command that renders with these options: "pathlight render ..." or replay. Leaves out options that equal
/// `defaults`, which are scene_defaults() of the same scene.
std::string command_text(Command command, const Options& options, const Options& defaults);

/// A word as a shell reads it back, in quotes if it needs them.
std::string shell_word(const std::string& text);

std::string_view command_name(Command command);

}  // namespace pl
