#include "app/options/groups.h"

namespace pl {
namespace {

void parse_spp(Options& options, const std::string& text) {
    options.spp = static_cast<std::uint32_t>(parse_whole(text, 1, 1000000000));
}

// clang-format off
constexpr auto kLimitOptions = std::to_array<OptionSpec>({
    {.name = "spp", .flags = "--spp,--samples", .value = "N", .group = kStop,
     .help = "Samples per pixel (default 64 unless another limit is given; in the viewer none)",
     .commands = CommandSet(Command::View, Command::Render, Command::Inspect), .in_scene_files = true,
     .parse = parse_spp,
     .print = [](const Options& o) { return o.spp ? std::to_string(*o.spp) : ""; }},
    {.name = "spp", .flags = "--spp,--samples", .value = "N", .group = kStop,
     .help = "Samples per pixel of each picture (default 64 unless another limit is given)",
     .commands = CommandSet(Command::Replay), .parse = parse_spp,
     .print = [](const Options& o) { return o.spp ? std::to_string(*o.spp) : ""; }},
    {.name = "seconds-per-frame", .flags = "--seconds-per-frame,--time-limit", .value = "SECONDS", .group = kStop,
     .help = "Seconds of work for each picture, checked after each pass; at least one pass is made",
     .commands = CommandSet(Command::Replay), .parse = parse_time_limit,
     .print = [](const Options& o) { return o.time_limit_seconds ? print_real(*o.time_limit_seconds) : ""; }},
    {.name = "spp", .flags = "--spp,--samples", .value = "N", .group = kStop,
     .help = "With --why: passes that train the field before; with --diagnostics and --gain: samples per pixel (default 64)",
     .commands = CommandSet(Command::Trace), .parse = parse_spp},
    {.name = "spp", .flags = "--spp,--samples", .value = "N", .group = kStop,
     .help = "Samples per pixel in each half (default 4096 unless a time limit is given)",
     .commands = CommandSet(Command::Reference), .parse = parse_spp},
    {.name = "spp", .flags = "--spp,--samples", .value = "N", .group = kStop,
     .help = "Samples per pixel of a run (default 64 unless a time limit or a target error is given)",
     .commands = CommandSet(Command::Bench), .parse = parse_spp,
     .print = [](const Options& o) { return o.spp ? std::to_string(*o.spp) : ""; }},
    {.name = "target-error", .flags = "--target-error", .value = "X", .group = kStop,
     .help = "A relMSE at which runs end; the time to it is reported",
     .commands = CommandSet(Command::Bench), .parse = parse_target_error,
     .print = [](const Options& o) { return o.target_error ? print_real(*o.target_error) : ""; }},
    {.name = "time-limit", .flags = "--time-limit", .value = "SECONDS", .group = kStop,
     .help = "Seconds of work after loading, checked after each pass; at least one pass is made",
     .commands = CommandSet(Command::View, Command::Render, Command::Inspect, Command::Reference, Command::Bench),
     .in_scene_files = true, .parse = parse_time_limit,
     .print = [](const Options& o) { return o.time_limit_seconds ? print_real(*o.time_limit_seconds) : ""; }},
    {.name = "target-error", .flags = "--target-error", .value = "X", .group = kStop,
     .help = "A relMSE of the picture's own noise, estimated from two halves of its samples and trusted from 16 samples "
             "per pixel on. Exit with 5 if another limit is reached first",
     .commands = CommandSet(Command::Render), .in_scene_files = true, .parse = parse_target_error,
     .print = [](const Options& o) { return o.target_error ? print_real(*o.target_error) : ""; }},
    {.name = "target-error", .flags = "--target-error", .value = "X", .group = kStop,
     .help = "A relMSE of each picture's own noise, estimated from two halves of its samples and trusted from 16 "
             "samples per pixel on. Exit with 5 if pictures reach another limit first",
     .commands = CommandSet(Command::Replay), .parse = parse_target_error,
     .print = [](const Options& o) { return o.target_error ? print_real(*o.target_error) : ""; }},
    {.name = "target-error", .flags = "--target-error", .value = "X", .group = kOutcome,
     .help = "Exit with 5 if relMSE is above this",
     .commands = CommandSet(Command::Compare), .parse = parse_target_error},
    {.name = "flip", .flags = "--flip", .value = "", .group = kOutcome,
     .help = "Also FLIP, the visible difference when a display flips between both pictures: 0 none, 1 the "
             "largest; radiance above 1 is white there",
     .commands = CommandSet(Command::Compare), .parse = parse_flag<&Options::flip>},
    {.name = "pixels-per-degree", .flags = "--pixels-per-degree", .value = "N", .group = kOutcome,
     .help = "With --flip, resolution of the display as the eye sees it (default 67: a 0.7 m wide 4K display "
             "from 0.7 m)",
     .is_expert = true, .commands = CommandSet(Command::Compare),
     .parse = [](Options& o, Text text) { o.pixels_per_degree = parse_real(text, 1.0, 1000.0); }},
});
// clang-format on

}  // namespace

std::span<const OptionSpec> limit_options() { return kLimitOptions; }

namespace {

// clang-format off
constexpr auto kProgramOptions = std::to_array<OptionSpec>({
    {.name = "json", .flags = "--json", .value = "", .group = kMessages,
     .help = "One JSON object per line on standard output instead of text",
     .commands = kEverywhere, .parse = parse_flag<&Options::json>},
    {.name = "quiet", .flags = "-q,--quiet", .value = "", .group = kMessages, .help = "Errors only",
     .commands = kEverywhere, .parse = parse_flag<&Options::quiet>},
    {.name = "verbose", .flags = "-v,--verbose", .value = "", .group = kMessages, .help = "More messages",
     .is_expert = true, .commands = kEverywhere, .parse = [](Options& o, Text) { ++o.verbosity; }},
    {.name = "log-file", .flags = "--log-file", .value = "FILE", .group = kMessages,
     .help = "Append all messages to a file as well",
     .is_expert = true, .commands = kEverywhere, .parse = parse_text<&Options::log_file>},
    {.name = "no-progress", .flags = "--no-progress", .value = "", .group = kMessages,
     .help = "No progress bar, no progress lines",
     .is_expert = true, .commands = kWorking, .parse = parse_flag<&Options::no_progress>},
    // Other renderers need it. Here no command but view opens a window.
    {.name = "headless", .flags = "--headless,--no-gui", .value = "", .group = kHidden, .help = "",
     .commands = kHeadless, .parse = [](Options&, Text) {}},

    {.name = "window", .flags = "--window", .value = "WxH", .group = kViewer, .help = "Window size (default: what fits the screen, at most 1440x900 times the scale)",
     .commands = CommandSet(Command::View), .parse = parse_window},
    {.name = "ui-scale", .flags = "--ui-scale", .value = "N", .group = kViewer,
     .help = "Size of text and controls, 0.75 to 2 (default: by the screen)",
     .commands = CommandSet(Command::View), .parse = parse_ui_scale},
    {.name = "remember", .flags = "--remember", .value = "FOLDER|off", .group = kViewer,
     .help = "Where the window's size, layout and displays are remembered (default: the system's folder for "
             "settings; off with --script)",
     .is_expert = true, .commands = CommandSet(Command::View), .parse = parse_remember},
    {.name = "software", .flags = "--software", .value = "", .group = kViewer,
     .help = "Draw the window without a graphics card",
     .commands = CommandSet(Command::View), .parse = parse_flag<&Options::software>},
    {.name = "script", .flags = "--script", .value = "FILE", .group = kViewer,
     .help = "Feed the window with input from a file; needs no display",
     .is_expert = true, .commands = CommandSet(Command::View), .parse = parse_text<&Options::script>},
    {.name = "ui-trace", .flags = "--ui-trace", .value = "FILE", .group = kViewer,
     .help = "Write the time of every frame of the window",
     .is_expert = true, .commands = CommandSet(Command::View), .parse = parse_text<&Options::ui_trace>},
});
// clang-format on

}  // namespace

std::span<const OptionSpec> program_options() { return kProgramOptions; }

}  // namespace pl
