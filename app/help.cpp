#include "app/help.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/build_info.h"
#include "app/events.h"
#include "app/options.h"

namespace pl {
namespace {

constexpr std::array kCommands{
    CommandInfo{Command::View, "view", "[SCENE]",
                "Opens the viewer (default scene: cornell). The word 'view' may be left out."},
    CommandInfo{Command::Render, "render", "SCENE -o IMAGE", "Makes a picture without a display."},
    CommandInfo{
        Command::Replay, "replay", "SCENE --path FILE -o DIR",
        "Makes the pictures of a moving camera, frame by frame, without a display.\n"
        "FILE holds the cameras of the path, such as the viewer's bookmarks. Every frame gets the same time, or the\n"
        "same samples; what is learned stays from one to the next. An interrupted replay keeps its whole frames."},
    CommandInfo{Command::Info, "info", "SCENE",
                "Prints the contents of a scene, the effects that it needs and the kernel that serves it."},
    CommandInfo{Command::Convert, "convert", "SCENE -o FILE",
                "Writes a scene in the program's own format: FILE, a .json, with mesh and images in the folder FILE-parts.\n"
                "The new scene renders to the same bits as SCENE with the same options. Knobs are left out, their values\n"
                "stay; a default light is written as an environment map. Nothing is overwritten: both names have to be new."},
    CommandInfo{Command::Devices, "devices", "", "Lists the back ends, and why one is unavailable.", Inputs::Nothing},
    CommandInfo{Command::Inspect, "inspect", "SCENE (--at X,Y,Z[,NX,NY,NZ] | --pixel X,Y) -o FILE",
                "Trains, then writes the learned hemisphere at a point.\n"
                "Training takes --spp samples per pixel with method reinforcement; method precomputed\n"
                "only computes its radiance map. The suffix decides the kind of file: .json, .csv (one\n"
                "row per direction cell) or .png (the hemisphere as an equal-area disc)."},
    CommandInfo{Command::Trace, "trace", "SCENE --pixel X,Y (--sample N[-M] | --why)",
                "Prints one path of a picture: every vertex with its densities and weights.\n"
                "It is the path that 'render' with the same options traces, to the bit. A method that learns\n"
                "renders the samples before it first, so that the field is the one that the path sampled from.\n"
                "Of several samples a line each, the brightest first; with --json each whole path. --why: the noise\n"
                "of the pixel by technique and bounces, and whether guiding gains there."},
    CommandInfo{
        Command::Compare, "compare", "IMAGE REFERENCE",
        "Measures the error of a picture against another, in all metrics.\n"
        "Both are linear: .exr or .pfm. REFERENCE may be a folder of 'pathlight reference': it then has to hold the\n"
        "reference of the same scene, camera, size and depth as an .exr of 'pathlight render'.",
        Inputs::Pictures},
    CommandInfo{
        Command::Reference, "reference", "SCENE -o DIR",
        "Renders a converged picture in two independent halves, stored by a hash of its scene, camera and size.\n"
        "Continues a reference that is there: after an interruption, or for more samples. Renders by method default\n"
        "with next-event estimation unless given otherwise; the converged picture is the same."},
    CommandInfo{
        Command::Bench, "bench", "SCENE... -o DIR",
        "Measures accuracy against time: methods x back ends x scenes x seeds.\n"
        "Each run starts with an empty field. Time is placing, precomputing, learning and rendering; loading,\n"
        "building, uploading and measuring are not in it. The same command continues an interrupted bench.\n"
        "'report' makes a page of the folder.",
        Inputs::Scenes},
    CommandInfo{Command::Report, "report", "DIR",
                "Makes one HTML page of a bench folder, and its plots as SVG and PNG.\n"
                "The page is self-contained.",
                Inputs::Folder},
    CommandInfo{
        Command::SelfTest, "selftest", "",
        "Renders scenes whose radiance has a closed form, on every back end that is available.\n"
        "Each line has the expected and the measured value, and the share of the tolerance between them. Exit\n"
        "with 5 if a check fails.",
        Inputs::Nothing},
};

constexpr std::string_view kScene =
    "SCENE is a name (cornell, door, ...), an .obj, .gltf, .glb or Mitsuba .xml file, or a scene .json file.\n"
    "Settings of a scene file are defaults that options override.\n";

constexpr std::string_view kExitCodes =
    "Exit codes: 0 done, 1 run-time failure, 2 usage, 3 input missing or invalid, 4 back end, device or "
    "display\n"
    "unavailable, 5 a threshold was missed, 130 interrupted (a partial picture is written and marked).\n";

constexpr std::size_t kHelpColumn = 32;
constexpr std::size_t kLineWidth = 110;

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
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        if (column > kHelpColumn && column + 1 + word.size() > kLineWidth) new_line();
        if (column > kHelpColumn) {
            result += ' ';
            ++column;
        }
        result += word;
        column += word.size();
    }
    return result + "\n";
}

std::string options_help(Command command) {
    std::vector<std::string_view> groups;
    for (const OptionSpec& spec : option_table())
        if (std::find(groups.begin(), groups.end(), spec.group) == groups.end() && !spec.group.empty())
            groups.push_back(spec.group);
    std::string text;
    for (const std::string_view group : groups) {
        std::string lines;
        for (const OptionSpec& spec : option_table())
            if (spec.group == group && spec.commands.has(command)) lines += in_columns(option_head(spec), spec.help);
        if (!lines.empty()) text += fmt::format("\n{}:\n{}", group, lines);
    }
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
    text += "\n";
    for (const CommandInfo& info : kCommands)
        text += in_columns(fmt::format("  {}", info.name), info.summary.substr(0, info.summary.find('\n')));
    text += fmt::format("\n{}\nOptions: pathlight SUBCOMMAND --help. Also: --list-methods, --list-views, --version, "
                        "--licenses.\n\n{}",
                        kScene, kExitCodes);
    return text;
}

std::string command_help(Command command) {
    const CommandInfo& info = info_of(command);
    const std::string scene =
        info.inputs == Inputs::Scene || info.inputs == Inputs::Scenes ? fmt::format("\n{}", kScene) : "";
    return fmt::format("{}\n\nUsage: pathlight {} {} [OPTIONS]\n{}{}\n{}", info.summary, info.name, info.arguments,
                       scene, options_help(command), kExitCodes);
}

std::string version_text(bool verbose) {
    std::string text = "pathlight " PL_VERSION "\n";
    if (verbose) text += fmt::format("commit {}\n", commit_id());
    return text;
}

std::string licenses_text() {
    return fmt::format(
        "{}Copyright 2026 The pathlight authors\nLicensed under the Apache License, Version 2.0, which is at the end "
        "of this text.\n\n{}\n{}",
        version_text(false), third_party_text(), license_text());
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
