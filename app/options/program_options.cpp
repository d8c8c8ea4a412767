#include "app/options/groups.h"

namespace pl {
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
