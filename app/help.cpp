#include "app/help.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "app/events.h"
#include "app/options.h"
#include "app/version.h"

namespace pl {
namespace {

// clang-format off
constexpr std::array kCommands{
    CommandInfo{Command::View, "view", "[SCENE]",
                "Opens the viewer (default scene: cornell). The word 'view' may be left out.",
                {"pathlight",
                 "pathlight door --method reinforcement",
                 "pathlight view staircase --size 640x360 --spp 256"}},
    CommandInfo{Command::Render, "render", "SCENE -o IMAGE",
                "Makes a picture without a display.",
                {"pathlight render cornell -o cornell.png",
                 "pathlight render door --method reinforcement --time-limit 10 -o door.exr",
                 "pathlight render door -D opening=5 --size 256x256 --spp 16 -o dark.png"}},
    CommandInfo{Command::Replay, "replay", "SCENE --path FILE -o DIR",
                "Makes the pictures of a moving camera, frame by frame, without a display.\n"
                "FILE holds the cameras of the path, such as the viewer's bookmarks. Every frame gets the same time,\n"
                "or the same samples; what is learned stays from one to the next. An interrupted replay keeps its\n"
                "whole frames.",
                {"pathlight replay door --path bookmarks.json --spp 16 -o frames",
                 "pathlight replay door --path bookmarks.json --frames 48 --seconds-per-frame 2 -o frames",
                 "pathlight replay cornell --path bookmarks.json --format exr -o frames"}},
    CommandInfo{Command::Info, "info", "SCENE",
                "Prints the contents of a scene, the effects that it needs and the kernel that serves it.",
                {"pathlight info door",
                 "pathlight info door -D opening=5",
                 "pathlight info cornell --json"}},
    CommandInfo{Command::Convert, "convert", "SCENE -o FILE",
                "Writes a scene in the program's own format: FILE, a .json, with mesh and images in FILE-parts.\n"
                "The new scene renders to the same bits as SCENE with the same options. Knobs are left out, their\n"
                "values stay; a default light is written as an environment map. Nothing is overwritten: both names\n"
                "have to be new.",
                {"pathlight convert cornell -o room.json",
                 "pathlight convert door -D opening=45 -o open-door.json",
                 "pathlight convert kitchen.xml -D shade=0.5 -o kitchen.json"}},
    CommandInfo{Command::Devices, "devices", "",
                "Lists the back ends, and why one is unavailable.",
                {"pathlight devices",
                 "pathlight devices --json",
                 "pathlight devices --json --log-file devices.log"},
                Inputs::Nothing},
    CommandInfo{Command::Inspect, "inspect", "SCENE (--at X,Y,Z[,NX,NY,NZ] | --pixel X,Y) -o FILE",
                "Trains, then writes the learned hemisphere at a point.\n"
                "Training takes --spp samples per pixel with method reinforcement; method precomputed only\n"
                "computes its radiance map. The suffix decides the kind of file: .json, .csv (one row per\n"
                "direction cell) or .png (the hemisphere as an equal-area disc).",
                {"pathlight inspect cornell --pixel 256,450 -o floor.png",
                 "pathlight inspect cornell --at 400,0,100 --size 256x256 -o floor.json",
                 "pathlight inspect door --pixel 256,400 --truth -o floor.csv"}},
    CommandInfo{Command::Trace, "trace", "SCENE --pixel X,Y (--sample N[-M] | --why)",
                "Prints one path of a picture: every vertex with its densities and weights.\n"
                "It is the path that 'render' with the same options traces, to the bit. A method that learns renders\n"
                "the samples before it first, so that the field is the one that the path sampled from. Of several\n"
                "samples a line each, the brightest first; with --json each whole path. --why: the noise of the\n"
                "pixel by technique and bounces, and whether guiding gains there. --diagnostics FILE and --gain FILE,\n"
                "without --pixel: what is wrong with the whole picture, and where guiding gains in it.",
                {"pathlight trace cornell --pixel 256,450 --sample 0",
                 "pathlight trace cornell --pixel 256,450 --sample 0-15",
                 "pathlight trace door --pixel 256,400 --why --method reinforcement"}},
    CommandInfo{Command::Compare, "compare", "IMAGE REFERENCE",
                "Measures the error of a picture against another, in all metrics.\n"
                "Both are linear: .exr, .pfm or .hdr. REFERENCE may be a folder of 'pathlight reference': it then\n"
                "has to hold the reference of the same scene, camera, size and depth as an .exr of 'render'.",
                {"pathlight compare door.exr better.exr",
                 "pathlight compare door.exr references --target-error 0.01",
                 "pathlight compare door.pfm better.pfm --flip"},
                Inputs::Pictures},
    CommandInfo{Command::Reference, "reference", "SCENE -o DIR",
                "Renders a converged picture in two independent halves.\n"
                "They are stored by a hash of scene, camera and size, and a reference that is there goes on: after an\n"
                "interruption, or for more samples. Renders by method default with next-event estimation unless\n"
                "given otherwise; the converged picture is the same.",
                {"pathlight reference cornell -o references",
                 "pathlight reference door --spp 1024 --size 256x256 -o references",
                 "pathlight reference door --time-limit 60 -o references"}},
    CommandInfo{Command::Bench, "bench", "(SCENE... | --suite NAME --scenes DIR) -o DIR",
                "Measures accuracy against time: methods x back ends x scenes x seeds.\n"
                "Each run starts with an empty field. Time is placing, precomputing, learning and rendering; loading,\n"
                "building, uploading and measuring are not in it. The same command continues an interrupted bench.\n"
                "'report' makes a page of the folder.",
                {"pathlight bench cornell door --time-limit 2 -o results",
                 "pathlight bench --suite literature --scenes scenes --protocol npm --quick -o quick",
                 "pathlight bench cornell --field table,lobes --method reinforcement -o fields"},
                Inputs::Scenes},
    CommandInfo{Command::Report, "report", "DIR",
                "Makes one HTML page of a bench folder, and its plots as SVG.\n"
                "The page is self-contained.",
                {"pathlight report results",
                 "pathlight report results --json",
                 "pathlight report results --quiet"},
                Inputs::Folder},
    CommandInfo{Command::Score, "score", "DIR",
                "Puts pictures of any renderer, with their times, into the tables of a bench.\n"
                "DIR/score.json names them, and the references: {\"schema\": \"pathlight.score/1\", \"references\":\n"
                "{\"room\": [\"half-1.exr\", \"half-2.exr\"]}, \"pictures\": [{\"file\": \"a.exr\", \"scene\": \"room\", \"method\":\n"
                "\"path\", \"seed\": 1, \"samples\": 64, \"seconds\": 12.5}, ...]}. The first method of \"methods\", or else\n"
                "of the first picture, is the baseline of the others. 'report' makes a page of the folder.",
                {"pathlight score pictures",
                 "pathlight score pictures --json",
                 "pathlight score pictures --quiet"},
                Inputs::Folder},
    CommandInfo{Command::SelfTest, "selftest", "",
                "Renders scenes whose radiance has a closed form, on every back end that is available.\n"
                "Each line has the expected and the measured value, and the share of the tolerance between them.\n"
                "Exit with 5 if a check fails.",
                {"pathlight selftest",
                 "pathlight selftest --backend cpu",
                 "pathlight selftest --json"},
                Inputs::Nothing},
};
// clang-format on

constexpr std::string_view kScene =
    "SCENE is a name (cornell, door, ...), an .obj, .gltf, .glb or Mitsuba .xml file, or a scene .json\n"
    "file, whose settings are defaults that options override.\n";

constexpr std::string_view kExitCodes =
    "Exit codes: 0 done, 1 run-time failure, 2 usage, 3 input missing or invalid, 4 back end, device or\n"
    "display unavailable, 5 a threshold was missed, 130 interrupted (a partial picture is written and\n"
    "marked).\n";

constexpr std::size_t kHelpColumn = 32;
constexpr std::size_t kLineWidth = 100;

/// "-t,--threads" as "-t, --threads N".
std::string option_head(const OptionSpec& spec) {
    std::string head = "  ";
    for (const char c : spec.flags) head += c == ',' ? std::string(", ") : std::string(1, c);
    if (!spec.value.empty()) head += fmt::format(" {}", spec.value);
    return head;
}

/// `text` in lines of at most kLineWidth, from kHelpColumn on, behind `head`.
std::string in_columns(const std::string& head, std::string_view text) {
    std::string result = head;
    std::size_t column = head.size();
    const auto new_line = [&] {
        result += "\n" + std::string(kHelpColumn, ' ');
        column = kHelpColumn;
    };
    if (column + 2 > kHelpColumn) {
        new_line();
    } else {
        result.append(kHelpColumn - column, ' ');
        column = kHelpColumn;
    }
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
        const std::string_view word = text.substr(0, end);
        const bool ends_line = text.substr(end).starts_with('\n');
        text.remove_prefix(std::min(text.size(), end + 1));
        if (column > kHelpColumn && column + 1 + word.size() > kLineWidth) new_line();
        if (column > kHelpColumn) {
            result += ' ';
            ++column;
        }
        result += word;
        column += word.size();
        if (ends_line) new_line();
    }
    return result + "\n";
}

bool is_shown(const OptionSpec& spec, Command command, bool is_whole) {
    return !spec.group.empty() && spec.commands.has(command) && (is_whole || !spec.is_expert);
}

std::string options_help(Command command, bool is_whole) {
    std::vector<std::string_view> groups;
    for (const OptionSpec& spec : option_table())
        if (std::find(groups.begin(), groups.end(), spec.group) == groups.end()) groups.push_back(spec.group);
    std::string text;
    for (const std::string_view group : groups) {
        std::string lines;
        for (const OptionSpec& spec : option_table())
            if (spec.group == group && is_shown(spec, command, is_whole))
                lines += in_columns(option_head(spec), spec.help_text());
        if (!lines.empty()) text += fmt::format("\n{}:\n{}", group, lines);
    }
    return text;
}

/// The way to the options that are not shown; empty if all are.
std::string rest_help(Command command, bool is_whole) {
    const auto count = [&](bool with_expert) {
        return std::ranges::count_if(option_table(),
                                     [&](const OptionSpec& spec) { return is_shown(spec, command, with_expert); });
    };
    const auto hidden = count(true) - count(is_whole);
    if (hidden == 0) return "";
    return fmt::format("\n{} more options: pathlight {} --help-all\n", hidden, command_name(command));
}

std::string examples_help(const CommandInfo& info) {
    std::string text = "\nExamples:\n";
    for (const std::string_view example : info.examples) text += fmt::format("  {}\n", example);
    return text;
}

}  // namespace

std::span<const CommandInfo> all_commands() { return kCommands; }

const CommandInfo& info_of(Command command) { return kCommands[static_cast<std::size_t>(command)]; }

std::string_view scene_help() { return kScene; }

std::string_view exit_code_help() { return kExitCodes; }

std::string_view command_name(Command command) { return info_of(command).name; }

std::string program_help() {
    std::string text = "Pathlight, an interactive path tracer that learns where light comes from.\n\nUsage:\n";
    for (const CommandInfo& info : kCommands) {
        const std::string name = info.id == Command::View ? "[view]" : std::string(info.name);
        text += fmt::format("  pathlight {}{}{}\n", name, info.arguments.empty() ? "" : " ", info.arguments);
    }
    text += "  pathlight help [SUBCOMMAND]\n\n";
    for (const CommandInfo& info : kCommands)
        text += in_columns(fmt::format("  {}", info.name), info.summary.substr(0, info.summary.find('\n')));
    text += fmt::format(
        "\n{}\nOptions: pathlight help SUBCOMMAND; all: pathlight SUBCOMMAND --help-all. Also: --list-methods,\n"
        "--list-views, --version, --licenses.\n\n{}",
        kScene, kExitCodes);
    return text;
}

std::string command_help(Command command, bool is_whole) {
    const CommandInfo& info = info_of(command);
    const bool has_scene = info.inputs == Inputs::Scene || info.inputs == Inputs::Scenes;
    const std::string usage =
        fmt::format("pathlight {}{}{} [OPTIONS]", info.name, info.arguments.empty() ? "" : " ", info.arguments);
    return fmt::format("{}\n\nUsage: {}\n{}{}{}\n{}{}", info.summary, usage,
                       has_scene ? fmt::format("\n{}", kScene) : "", options_help(command, is_whole),
                       rest_help(command, is_whole), kExitCodes, examples_help(info));
}

std::string licenses_text() {
    return fmt::format(
        "{}Copyright 2026 The pathlight authors\nLicensed under the Apache License, Version 2.0, which is at the end "
        "of this text.\n\n{}\n{}",
        "pathlight " PL_VERSION "\n", third_party_text(), license_text());
}

std::string method_list(bool json) {
    std::string text;
    for (const MethodInfo& info : all_methods()) {
        if (json)
            text += event_line("method", {{"name", info.name},
                                          {"label", info.label},
                                          {"summary", info.summary},
                                          {"uses_field", info.uses_field},
                                          {"learns", info.learns}});
        else
            text += fmt::format("{:<15} {}\n", info.name, info.summary);
    }
    return text;
}

std::string view_list(bool json) {
    std::string text;
    for (const ViewInfo& info : all_views()) {
        if (json)
            text += event_line("view", {{"name", info.name},
                                        {"label", info.label},
                                        {"summary", info.summary},
                                        {"needs_learning", info.needs_tables}});
        else
            text += fmt::format("{:<15} {}\n", info.name, info.summary);
    }
    return text;
}

}  // namespace pl
