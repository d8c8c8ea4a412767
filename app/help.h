// Help, lists of methods and views.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "app/option_values.h"

namespace pl {

/// Positional arguments of a subcommand.
enum class Inputs { Nothing, Scene, Scenes, Pictures, Folder };

struct CommandInfo {
    Command id;
    std::string_view name;
    std::string_view arguments;
    std::string_view summary;
    std::array<std::string_view, 3> examples;
    Inputs inputs = Inputs::Scene;
};

std::span<const CommandInfo> all_commands();
const CommandInfo& info_of(Command command);

/// Parts of all help texts: what SCENE may be, and the exit codes.
std::string_view scene_help();
std::string_view exit_code_help();

/// Help of the whole program and of one subcommand. All texts end with a line feed.
std::string program_help();
/// Without OptionSpec::is_expert unless it `is_whole`.
std::string command_help(Command command, bool is_whole);
/// The program's licence and what others contributed.
std::string licenses_text();
/// Registries as a table, or as one JSON object per line.
std::string method_list(bool json);
std::string view_list(bool json);

}  // namespace pl
