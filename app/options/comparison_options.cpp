#include "app/options/groups.h"

#include <algorithm>

#include "app/suite.h"
#include "core/inspect/incident_light.h"

namespace pl {
namespace {

/// One of the names of a table.
void parse_name(std::string& name, const std::vector<std::string>& known, Text text) {
    if (std::ranges::find(known, text) == known.end()) fail_choice(known, text);
    name = text;
}

// clang-format off
constexpr auto kComparisonOptions = std::to_array<OptionSpec>({
    {.name = "at", .flags = "--at", .value = "X,Y,Z[,NX,NY,NZ]", .group = kPlace,
     .help = "The nearest volume whose normal agrees; a point without a normal is moved to the closest "
             "surface, on the side that it lies on",
     .commands = CommandSet(Command::Inspect), .parse = parse_at},
    {.name = "pixel", .flags = "--pixel", .value = "X,Y", .group = kPlace,
     .help = "The volume that serves the surface seen there; 0,0 is the top left pixel",
     .commands = CommandSet(Command::Inspect), .parse = parse_pixel},
    {.name = "pixel", .flags = "--pixel", .value = "X,Y", .group = kPlace,
     .help = "The pixel of the path; 0,0 is the top left one",
     .commands = CommandSet(Command::Trace), .parse = parse_pixel},
    {.name = "sample", .flags = "--sample", .value = "N[-M]", .group = kPlace,
     .help = "The sample of that pixel, from 0 on; of N to M all, the brightest first",
     .commands = CommandSet(Command::Trace), .parse = parse_samples},
    {.name = "why", .flags = "--why", .value = "", .group = kPlace,
     .help = "The noise of that pixel by technique, by number of bounces and by light, and whether guiding gains there: by "
             "further paths of default and of the method, after it has been trained by --spp passes",
     .commands = CommandSet(Command::Trace), .parse = parse_flag<&Options::why>},
    {.name = "why-samples", .flags = "--why-samples", .value = "N", .group = kPlace,
     .help = "Paths by each method for --why, at least 256 (default 4096)",
     .is_expert = true, .commands = CommandSet(Command::Trace),
     .parse = [](Options& o, Text text) { o.why_samples = static_cast<std::uint32_t>(parse_whole(text, 256, 100000000)); }},
    {.name = "diagnostics", .flags = "--diagnostics", .value = "FILE", .group = kPlace,
     .help = "Locate invalid samples, escaped paths, lookup misses and clamped training samples of the whole picture by tracing "
             "its paths again: .png marks their pixels in the picture, .exr and .pfm hold their counts per pixel; --json has numbers",
     .commands = CommandSet(Command::Trace), .parse = parse_text<&Options::diagnostics_file>},
    {.name = "gain", .flags = "--gain", .value = "FILE", .group = kPlace,
     .help = "Where a guided method gains or loses against default, tile by tile of the whole picture: renders default for the "
             "same time, and compares their noise. .json: numbers; .png: the picture with a mark for each tile",
     .commands = CommandSet(Command::Trace), .parse = parse_text<&Options::gain_file>},
    {.name = "truth", .flags = "--truth", .value = "", .group = kPlace,
     .help = "Also the light that reaches the volume, by paths of default from there: beside the learned radiance, with "
             "the divergence of the learned densities from it",
     .commands = CommandSet(Command::Inspect), .parse = parse_flag<&Options::truth>},
    {.name = "truth-samples", .flags = "--truth-samples", .value = "N", .group = kPlace,
     .help = "Paths through every cell for --truth, at least 32 (default 256)",
     .is_expert = true, .commands = CommandSet(Command::Inspect),
     .parse = [](Options& o, Text text) { o.truth_samples = static_cast<std::uint32_t>(parse_whole(text, kLightGroups, 1000000)); }},
    {.name = "history", .flags = "--history", .value = "", .group = kPlace,
     .help = "Key frames of the field: divergences from the light that reaches the volume, variance factor and "
             "difference to the last frame, over the passes",
     .commands = CommandSet(Command::Inspect), .parse = parse_flag<&Options::history>},
    choosing<&Options::drawn>(
    {.name = "drawn", .flags = "--drawn", .value = "NAME", .group = kPlace,
     .help = "Display in a PNG", .commands = CommandSet(Command::Inspect)}),

    {.name = "method", .flags = "--method", .value = "NAME", .group = kPicture,
     .help = "Sampling of directions (default unless given), explained by --list-methods",
     .commands = kOneMethod, .in_scene_files = true, .parse = parse_method,
     .print = [](const Options& o) { return std::string(info_of(o.render.method).name); },
     .values = [] { return one_of(method_names()); }},
    {.name = "method", .flags = "--method", .value = "NAME,..", .group = kCompared,
     .help = "Methods to compare, separated by commas (default: all); the first one is the baseline of the "
             "others",
     .commands = CommandSet(Command::Bench), .parse = parse_methods},
    {.name = "field", .flags = "--field", .value = "NAME,..", .group = kCompared,
     .help = "Representations of what reinforcement learns to compare (default: that of each scene's settings)",
     .commands = CommandSet(Command::Bench), .parse = parse_representations, .print = print_representations,
     .values = [] { return describe_choices<Representation>(); }},
    {.name = "backend", .flags = "--backend", .value = "NAME,..", .group = kCompared,
     .help = "Back ends to compare: cpu, cuda (default: all that are available)",
     .commands = CommandSet(Command::Bench), .parse = parse_backends},
    {.name = "suite", .flags = "--suite", .value = "NAME", .group = kCompared,
     .help = "Scenes of this suite in place of SCENE..., as far as the folder of --scenes has them",
     .commands = CommandSet(Command::Bench),
     .parse = [](Options& o, Text text) { parse_name(o.suite, suite_names(), text); },
     .print = [](const Options& o) { return o.suite; }, .values = describe_suites},
    {.name = "scenes", .flags = "--scenes", .value = "DIR", .group = kCompared,
     .help = "Folder with the scenes of the suite, which may lie in folders of it",
     .commands = CommandSet(Command::Bench), .parse = parse_text<&Options::scenes_folder>},
    {.name = "protocol", .flags = "--protocol", .value = "NAME", .group = kCompared,
     .help = "Options by which others have measured; those that are given go over them",
     .commands = CommandSet(Command::Bench),
     .parse = [](Options& o, Text text) { parse_name(o.protocol, protocol_names(), text); },
     .print = [](const Options& o) { return o.protocol; }, .values = describe_protocols},
    {.name = "quick", .flags = "--quick", .value = "", .group = kCompared,
     .help = "A short bench: three scenes of a suite, and these options, over those of a protocol and under those that are given",
     .commands = CommandSet(Command::Bench), .parse = parse_flag<&Options::quick>, .values = describe_quick},
    {.name = "seeds", .flags = "--seeds", .value = "N", .group = kCompared,
     .help = "Runs of each method on each scene and back end (default 10); intervals need at least 5",
     .commands = CommandSet(Command::Bench),
     .parse = [](Options& o, Text text) { o.seeds = static_cast<int>(parse_whole(text, 1, 100000)); }},
    {.name = "reference", .flags = "--reference", .value = "DIR", .group = kCompared,
     .help = "Folder of references; a missing one is an error (default: DIR/references, made as needed)",
     .is_expert = true, .commands = CommandSet(Command::Bench), .parse = parse_text<&Options::reference_folder>},
    {.name = "reference-spp", .flags = "--reference-spp", .value = "N", .group = kCompared,
     .help = "Samples per pixel in each half of references made here (default 4096)",
     .is_expert = true, .commands = CommandSet(Command::Bench),
     .parse = [](Options& o, Text text) {
         o.reference_spp = static_cast<std::uint32_t>(parse_whole(text, 1, 1000000000));
     }},
    {.name = "gate", .flags = "--gate", .value = "FILE", .group = kOutcome,
     .help = "Exit with 5 if a method takes longer to the same error than in this earlier results.json: by "
             "more than the tolerance even at the low end of its interval",
     .is_expert = true, .commands = CommandSet(Command::Bench), .parse = parse_text<&Options::gate>},
    {.name = "tolerance", .flags = "--tolerance", .value = "PERCENT", .group = kOutcome,
     .help = "Tolerance of the gate (default 10)",
     .is_expert = true, .commands = CommandSet(Command::Bench),
     .parse = [](Options& o, Text text) { o.tolerance_percent = parse_real(text, 0.0, 1.0e6); }},
    {.name = "measure-share", .flags = "--measure-share", .value = "PERCENT", .group = kOutcome,
     .help = "Time for measuring, on top of and relative to the charged time (default 1); points of a run are "
             "left out to keep within it, except for the first and the last",
     .is_expert = true, .commands = CommandSet(Command::Bench),
     .parse = [](Options& o, Text text) { o.measure_percent = parse_real(text, 0.0, 1.0e9); },
     .print = [](const Options& o) { return print_real(o.measure_percent); }},
});
// clang-format on

}  // namespace

std::span<const OptionSpec> comparison_options() { return kComparisonOptions; }

}  // namespace pl
