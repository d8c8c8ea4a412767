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
    {.name = "target-error", .flags = "--target-error", .value = "X", .group = kHidden, .help = "",
     .commands = CommandSet(Command::View, Command::Inspect),
     .parse = [](Options&, Text) { fail_not_yet("stop by --spp or --time-limit"); }},
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

}  // namespace pl
