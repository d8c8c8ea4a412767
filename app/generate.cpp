#include "app/generate.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/help.h"
#include "app/option_parsers.h"
#include "app/options.h"
#include "app/parse_values.h"
#include "core/io/load_scene.h"

namespace pl {
namespace {

/// An option as one subcommand takes it.
struct TakenOption {
    std::vector<std::string> flags;  ///< "-t", "--threads"
    std::string_view value;          ///< placeholder; empty: a switch
    std::string help;
    const OptionSpec* spec = nullptr;  ///< null for one that only the parser knows
};

std::vector<TakenOption> options_of(Command command) {
    std::vector<TakenOption> options;
    for (const OptionSpec& spec : option_table())
        if (spec.commands.has(command) && !spec.group.empty())
            options.push_back({split(spec.flags, ','), spec.value, spec.help_text(), &spec});
    for (const Question& question : all_questions())
        options.push_back({split(question.flags, ','), "", std::string(question.help), nullptr});
    return options;
}

/// The words that an option takes: the words that its parser names when it is given none of them, and the words of
/// "on|off".
std::vector<std::string> words_of(const OptionSpec& spec) {
    if (spec.value.starts_with("NAME")) {
        try {
            Options ignored;
            spec.parse(ignored, "?");
        } catch (const ChoiceError& error) {
            return error.names();
        } catch (const Error&) {
        }
        return {};
    }
    std::vector<std::string> words;
    for (const std::string& word : split(spec.value, '|'))
        if (word.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == std::string::npos) words.push_back(word);
    return words;
}

bool takes_file(std::string_view value) { return value.starts_with("FILE"); }
bool takes_folder(std::string_view value) { return value.starts_with("DIR") || value.starts_with("FOLDER"); }

std::string first_line(std::string_view text) { return std::string(text.substr(0, text.find('\n'))); }

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// A text with its gaps, such as "@NAMES@", filled.
std::string filled(std::string text, const std::vector<std::pair<std::string_view, std::string>>& parts) {
    for (const auto& [gap, part] : parts) text = replaced(std::move(text), gap, part);
    return text;
}

/// Plain text for troff: hyphens that can be copied, and no line that begins like a request.
std::string roff(std::string_view text) {
    std::string result = replaced(replaced(std::string(text), "\\", "\\e"), "-", "\\-");
    result = replaced(result, "\n.", "\n\\&.");
    result = replaced(result, "\n'", "\n\\&'");
    return result.starts_with('.') || result.starts_with('\'') ? "\\&" + result : result;
}

std::string man_option(const std::vector<std::string>& flags, std::string_view value, const std::string& help) {
    std::string head;
    for (const std::string& flag : flags) head += (head.empty() ? "" : ", ") + ("\\fB" + roff(flag) + "\\fR");
    if (!value.empty()) head += " \\fI" + roff(value) + "\\fR";
    return fmt::format(".TP\n{}\n{}\n", head, replaced(roff(help), "\n", "\n.br\n"));
}

/// "(render, view)", or nothing if all subcommands take it.
std::string takers(const OptionSpec& spec) {
    std::vector<std::string_view> names;
    for (const CommandInfo& info : all_commands())
        if (spec.commands.has(info.id)) names.push_back(info.name);
    return names.size() == all_commands().size() ? "" : fmt::format(" ({})", fmt::join(names, ", "));
}

std::string man_page() {
    std::string text = fmt::format(
        ".\\\" Written by: pathlight --generate man\n"
        ".TH PATHLIGHT 1 \"\" \"pathlight {}\" \"User Commands\"\n.nh\n.ad l\n"
        ".SH NAME\npathlight \\- interactive path tracer that learns where light comes from\n.SH SYNOPSIS\n.nf\n",
        PL_VERSION);
    for (const CommandInfo& info : all_commands())
        text += fmt::format("\\fBpathlight\\fR {} {}[OPTIONS]\n",
                            info.id == Command::View ? "[view]" : fmt::format("\\fB{}\\fR", info.name),
                            info.arguments.empty() ? "" : roff(info.arguments) + " ");
    text += ".fi\n.SH DESCRIPTION\n"
            "Pathlight renders scenes by path tracing, and learns while it renders which directions bring light. It "
            "shows the picture in a window, or writes it to a file.\n.PP\n" +
            roff(scene_help()) + ".SH SUBCOMMANDS\n";
    for (const CommandInfo& info : all_commands())
        text += fmt::format(".TP\n\\fB{}\\fR{}{}\n{}\n", info.name, info.arguments.empty() ? "" : " ",
                            roff(info.arguments), roff(info.summary));

    std::vector<std::string_view> groups;
    for (const OptionSpec& spec : option_table())
        if (!spec.group.empty() && std::ranges::find(groups, spec.group) == groups.end())
            groups.push_back(spec.group);
    text += ".SH OPTIONS\nThe subcommands that take an option are in parentheses, unless all do.\n";
    for (const std::string_view group : groups) {
        text += fmt::format(".SS {}\n", roff(group));
        for (const OptionSpec& spec : option_table())
            if (spec.group == group)
                text += man_option(split(spec.flags, ','), spec.value, spec.help_text() + takers(spec));
    }
    text += ".SS Questions\n";
    for (const Question& question : all_questions())
        text += man_option(split(question.flags, ','), "", std::string(question.help));
    text += ".SH EXAMPLES\n.nf\n";
    for (const CommandInfo& info : all_commands())
        for (const std::string_view example : info.examples) text += roff(example) + "\n";
    text +=
        ".fi\n.SH EXIT STATUS\n" + roff(exit_code_help()) +
        ".SH ENVIRONMENT\n.TP\n\\fBPATHLIGHT_ASSETS\\fR\nFolder that holds the folder \"scenes\", in place of the "
        "installed one.\n.TP\n\\fBNO_COLOR\\fR\nMessages are not colored.\n";
    return text;
}

/// The names of scenes for a shell; none where the program has no assets.
std::string scene_names() {
    try {
        return fmt::format("{}", fmt::join(list_scenes(find_assets_dir()), " "));
    } catch (const Error&) {
        return "";
    }
}

std::string bash_completion() {
    const std::string scenes = fmt::format("_pathlight_words '{}'; _pathlight_files", scene_names());
    std::string names, options, values, inputs;
    for (const CommandInfo& info : all_commands()) {
        names += fmt::format("{}{}", names.empty() ? "" : " ", info.name);
        std::string flags;
        for (const TakenOption& option : options_of(info.id)) {
            std::vector<std::string> cases;
            for (const std::string& flag : option.flags) {
                flags += (flags.empty() ? "" : " ") + flag;
                cases.push_back(fmt::format("{}\\ {}", info.name, flag));
            }
            if (option.value.empty()) continue;
            const std::vector<std::string> words = words_of(*option.spec);
            values += fmt::format("        {}) {}{}return ;;\n", fmt::join(cases, "|"),
                                  words.empty() ? "" : fmt::format("_pathlight_words '{}'; ", fmt::join(words, " ")),
                                  takes_file(option.value)     ? "_pathlight_files; "
                                  : takes_folder(option.value) ? "_pathlight_folders; "
                                                               : "");
        }
        options += fmt::format("        {}) options='{}' ;;\n", info.name, flags);
        const bool takes_scene = info.inputs == Inputs::Scene || info.inputs == Inputs::Scenes;
        if (info.inputs != Inputs::Nothing)
            inputs += fmt::format("        {}) {} ;;\n", info.name,
                                  takes_scene                       ? scenes
                                  : info.inputs == Inputs::Pictures ? "_pathlight_files"
                                                                    : "_pathlight_folders");
    }
    return filled(R"---(# Completion of bash, written by: pathlight --generate complete-bash
_pathlight_words() { while read -r; do COMPREPLY+=("$REPLY"); done < <(compgen -W "$1" -- "$current"); }
_pathlight_files() { compopt -o filenames; while read -r; do COMPREPLY+=("$REPLY"); done < <(compgen -f -- "$current"); }
_pathlight_folders() { compopt -o filenames; while read -r; do COMPREPLY+=("$REPLY"); done < <(compgen -d -- "$current"); }

_pathlight() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=view options
    local names='@NAMES@'
    COMPREPLY=()
    if ((COMP_CWORD > 1)) && [[ " $names " == *" ${COMP_WORDS[1]} "* ]]; then command=${COMP_WORDS[1]}; fi
    case "$command $previous" in
@VALUES@    esac
    case $command in
@OPTIONS@    esac
    if [[ $current == -* ]]; then
        _pathlight_words "$options"
        return
    fi
    if ((COMP_CWORD == 1)); then _pathlight_words "$names"; fi
    case $command in
@INPUTS@    esac
}
complete -F _pathlight pathlight
)---",
                  {{"@NAMES@", names}, {"@VALUES@", values}, {"@OPTIONS@", options}, {"@INPUTS@", inputs}});
}

/// Text inside of [...] in single quotes, in one line.
std::string zsh_help(const std::string& text) {
    return replaced(replaced(replaced(replaced(text, "\n", " "), "[", "\\["), "]", "\\]"), "'", "'\\''");
}

std::string zsh_option(const TakenOption& option) {
    std::string value;
    if (!option.value.empty()) {
        const std::vector<std::string> words = words_of(*option.spec);
        value = fmt::format(":{}:{}", replaced(std::string(option.value), ":", "\\:"),
                            takes_file(option.value)     ? "_files"
                            : takes_folder(option.value) ? "_files -/"
                            : words.empty()              ? " "
                                                         : fmt::format("({})", fmt::join(words, " ")));
    }
    const bool repeats = option.spec != nullptr && option.spec->repeatable;
    const std::string excludes = repeats ? "*" : fmt::format("({})", fmt::join(option.flags, " "));
    const std::string flags =
        option.flags.size() == 1 ? option.flags.front() : fmt::format("'{{{}}}'", fmt::join(option.flags, ","));
    return fmt::format(" \\\n            '{}{}[{}]{}'", excludes, flags, zsh_help(option.help), value);
}

std::string zsh_completion() {
    std::string names, cases;
    for (const CommandInfo& info : all_commands()) {
        names += fmt::format("        '{}:{}'\n", info.name, replaced(first_line(info.summary), "'", "'\\''"));
        cases += fmt::format("        {}) _arguments -s", info.name);
        for (const TakenOption& option : options_of(info.id)) cases += zsh_option(option);
        switch (info.inputs) {
        case Inputs::Nothing: break;
        case Inputs::Scene: cases += " \\\n            ':scene:_pathlight_scenes'"; break;
        case Inputs::Scenes: cases += " \\\n            '*:scene:_pathlight_scenes'"; break;
        case Inputs::Pictures: cases += " \\\n            '*:picture:_files'"; break;
        case Inputs::Folder: cases += " \\\n            ':folder:_files -/'"; break;
        }
        cases += " ;;\n";
    }
    return filled(R"---(#compdef pathlight
# Completion of zsh, written by: pathlight --generate complete-zsh
_pathlight_scenes() {
    _alternative 'scenes:scene:(@SCENES@)' 'files:file:_files -g "*.(obj|gltf|glb|xml|json)"'
}

_pathlight() {
    local -a commands=(
@NAMES@    )
    local command=view
    if ((CURRENT == 2)) && [[ $words[2] != -* ]]; then
        _describe -t commands subcommand commands
        _pathlight_scenes
        return
    fi
    if ((${commands[(I)$words[2]:*]})); then
        command=$words[2]
        shift words
        ((CURRENT--))
    fi
    case $command in
@CASES@    esac
}

_pathlight "$@"
)---",
                  {{"@NAMES@", names}, {"@CASES@", cases}, {"@SCENES@", scene_names()}});
}

}  // namespace

std::string generated_page(const std::string& kind) {
    if (kind == "man") return man_page();
    if (kind == "complete-bash") return bash_completion();
    if (kind == "complete-zsh") return zsh_completion();
    try {
        fail_choice({"man", "complete-bash", "complete-zsh"}, kind);
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("--generate: {}", error.what()));
    }
}

}  // namespace pl
