#include "app/options/groups.h"

namespace pl {
namespace {

// clang-format off
constexpr auto kOutputOptions = std::to_array<OptionSpec>({
    {.name = "output", .flags = "-o,--output,--outfile", .value = "FILE", .group = kOutput,
     .help = "Picture to write; its suffix decides the kind: .exr and .pfm linear, .png tone mapped. -: a PNG to standard "
             "output; exr:- and pfm:- likewise",
     .commands = CommandSet(Command::Render), .parse = parse_text<&Options::output>,
     .print = [](const Options& o) { return o.output; }},
    {.name = "output", .flags = "-o,--output,--outfile", .value = "FILE", .group = kOutput,
     .help = "File to write; its suffix decides the kind: .json, .csv or .png",
     .commands = CommandSet(Command::Inspect), .parse = parse_text<&Options::output>},
    {.name = "output", .flags = "-o,--output,--outfile", .value = "FILE", .group = kOutput,
     .help = "Also draw the paths as lines into this PNG, over the first surfaces",
     .commands = CommandSet(Command::Trace), .parse = parse_text<&Options::output>},
    {.name = "output", .flags = "-o,--output,--outfile", .value = "FILE", .group = kOutput,
     .help = "Scene file to write, a new .json; mesh and images go to a new folder beside it, named like it with -parts",
     .commands = CommandSet(Command::Convert), .parse = parse_text<&Options::output>},
    {.name = "output", .flags = "-o,--output,--outfile", .value = "DIR", .group = kOutput,
     .help = "Folder of references; it may hold those of other pictures",
     .commands = CommandSet(Command::Reference), .parse = parse_text<&Options::output>},
    {.name = "output", .flags = "-o,--output,--outfile", .value = "DIR", .group = kOutput,
     .help = "Folder of this bench; an interrupted bench continues",
     .commands = CommandSet(Command::Bench), .parse = parse_text<&Options::output>},
    {.name = "output", .flags = "-o,--output,--outfile", .value = "DIR", .group = kOutput,
     .help = "Folder of the pictures, made if it is missing: frame_0001.png and so on. Files of these names are replaced",
     .commands = CommandSet(Command::Replay), .parse = parse_text<&Options::output>,
     .print = [](const Options& o) { return o.output; }},
    choosing<&Options::frame_kind>(
    {.name = "format", .flags = "--format", .value = "NAME", .group = kOutput,
     .help = "Kind of the pictures", .commands = CommandSet(Command::Replay)}),
    {.name = "stats", .flags = "--stats", .value = "FILE", .group = kOutput,
     .help = "Write counts and timings as JSON",
     .commands = kWithStats, .parse = parse_text<&Options::stats_file>},
    {.name = "checkpoint", .flags = "--checkpoint", .value = "FILE", .group = kOutput,
     .help = "Write the state of the rendering now and then, when it is interrupted, and at its end. The same command with "
             "--resume FILE goes on from there, to the same bits",
     .is_expert = true, .commands = CommandSet(Command::Render), .parse = parse_text<&Options::checkpoint_file>},
    {.name = "checkpoint-every", .flags = "--checkpoint-every", .value = "SECONDS", .group = kOutput,
     .help = "Least time between two checkpoints of a rendering (default 600)",
     .is_expert = true, .commands = CommandSet(Command::Render), .parse = parse_checkpoint_interval},
    {.name = "resume", .flags = "--resume", .value = "FILE", .group = kOutput,
     .help = "Go on from a checkpoint of the same scene, settings and back end; threads, processes and limits may differ",
     .is_expert = true, .commands = CommandSet(Command::Render), .parse = parse_text<&Options::resume_file>},
});
// clang-format on

}  // namespace

std::span<const OptionSpec> output_options() { return kOutputOptions; }

}  // namespace pl
