#include "app/options/groups.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {
namespace {

void refuse_save_field(Options&, const std::string&) {
    throw Error(ErrorKind::Usage, "the viewer saves the learned field when Ctrl+Shift+S is pressed");
}

// clang-format off
constexpr auto kLearnValues = std::to_array<OptionSpec>({
    {.name = "refine", .flags = "", .value = "SHARE|auto", .group = kField,
     .help = "Volumes that reinforcement may add, as a share of those placed, 0 to 1: after 8 and 16 passes it "
             "divides volumes that many paths look up and whose neighbors disagree; within the budget, unless "
             "--volumes is given. auto (default): up to 1, also after 48, 96 and so on, as far as there are "
             "training samples enough for them; 0 with --volumes",
     .commands = kPaths, .parse = parse_refine,
     .print = [](const Options& o) { return print_refine(o.render.field.refine_share); }},
    {.name = "passes", .flags = "", .value = "N", .group = kField,
     .help = "Passes that train the field of reinforcement; later ones sample from it as it is then (default: all train it)",
     .commands = kPaths,
     .parse = [](Options& o, Text text) { o.render.learn_passes = parse_whole(text, 1, 1000000000); },
     .print = [](const Options& o) {
         return o.render.learn_passes == kEveryPass ? "" : std::to_string(o.render.learn_passes);
     }},
    choosing<&Options::render, &RenderSettings::field, &FieldSettings::learning, &LearningSettings::target>(
    {.name = "target", .flags = "", .value = "NAME", .group = kField,
     .help = "Target of reinforcement's training samples; tables alone learn from others than the first", .commands = kPaths}),
    choosing<&Options::render, &RenderSettings::field, &FieldSettings::learning, &LearningSettings::light>(
    {.name = "from", .flags = "", .value = "NAME", .group = kField,
     .help = "With next-event estimation, light in reinforcement's training samples", .commands = kPaths}),
    choosing<&Options::render, &RenderSettings::field, &FieldSettings::rate>(
    {.name = "rate", .flags = "", .value = "NAME", .group = kField, .help = "Step of an update", .commands = kPaths}),
    {.name = "probes", .flags = "", .value = "N", .group = kField,
     .help = "Paths that fill each cell of the map of precomputed, a square number from 1 to 1024 (default 1); more pay in long runs",
     .commands = kPaths, .parse = parse_probes,
     .print = [](const Options& o) { return std::to_string(o.render.field.precompute_samples); }},
});
// clang-format on

/// "NAME=VALUE", or several with commas between.
void parse_learning(Options& options, const std::string& text) {
    for (const std::string& item : split(text, ',')) {
        const std::size_t equals = item.find('=');
        const std::string name = item.substr(0, equals);
        const auto known = std::ranges::find(kLearnValues, name, &OptionSpec::name);
        if (known == kLearnValues.end())
            fail_choice(names_in(kLearnValues, [](const OptionSpec& value) { return value.name; }), name);
        if (equals == std::string::npos) fail_value("NAME=VALUE, such as passes=16", item);
        apply_option(*known, options, item.substr(equals + 1));
    }
}

std::string print_learning(const Options& options) {
    std::string text;
    for (const OptionSpec& value : kLearnValues)
        if (const std::string own = value.print(options); !own.empty())
            text += fmt::format("{}={}\n", value.name, own);
    return text;
}

std::string describe_learning() {
    std::string text;
    for (const OptionSpec& value : kLearnValues)
        text += fmt::format("\n{}={}: {}", value.name, value.value, value.help_text());
    return text;
}

// clang-format off
constexpr auto kFieldOptions = std::to_array<OptionSpec>({
    choosing<&Options::render, &RenderSettings::field, &FieldSettings::representation>(
    {.name = "field", .flags = "--field", .value = "NAME", .group = kField,
     .help = "How reinforcement represents what it learns", .commands = kSampling, .in_scene_files = true}),
    {.name = "volumes", .flags = "--volumes", .value = "N", .group = kField,
     .help = "Number of radiance volumes (default: what the budget holds, at most 1000)",
     .is_expert = true, .commands = kPaths, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.render.field.volumes = static_cast<int>(parse_whole(text, 1, 1000000)); },
     .print = [](const Options& o) {
         return o.render.field.volumes == 0 ? "" : std::to_string(o.render.field.volumes);
     }},
    {.name = "field-budget", .flags = "--field-budget", .value = "MB", .group = kField,
     .help = "Memory of one method's learned field (default 16)",
     .is_expert = true, .commands = kPaths, .in_scene_files = true, .parse = parse_field_budget,
     .print = [](const Options& o) { return print_real(o.render.field.budget_megabytes); }},
    {.name = "bins", .flags = "--bins", .value = "N", .group = kField,
     .help = "Directions per volume, a square number from 4 to 1024 (default 256)",
     .is_expert = true, .commands = kPaths, .in_scene_files = true, .parse = parse_bins,
     .print = [](const Options& o) { return std::to_string(o.render.field.bins); }},
    {.name = "bsdf-fraction", .flags = "--bsdf-fraction", .value = "X|learned", .group = kField,
     .help = "Share of directions sampled from the BSDF instead of the field, 0.1 to 1; learned (default): "
             "each volume learns its own, precomputed takes 0.5",
     .is_expert = true, .commands = kPaths, .in_scene_files = true, .parse = parse_bsdf_fraction,
     .print = [](const Options& o) { return print_bsdf_fraction(o.render.mixture); }},
    {.name = "learn", .flags = "--learn", .value = "NAME=VALUE,..", .group = kField,
     .help = "How the field is learned; may be given several times",
     .is_expert = true, .commands = kPaths, .repeatable = true, .in_scene_files = true, .parse = parse_learning,
     .print = print_learning, .values = describe_learning},
    {.name = "load-field", .flags = "--load-field", .value = "FILE", .group = kField,
     .help = "Continue with a field that was saved for this scene: it brings method, volumes, bins and learned "
             "radiance. Timings count this run only. 'inspect' then trains only if --spp or --time-limit is "
             "given",
     .is_expert = true, .commands = kSampling, .parse = parse_text<&Options::load_field>,
     .print = [](const Options& o) { return o.load_field; }},
    {.name = "save-field", .flags = "--save-field", .value = "FILE", .group = kField,
     .help = "Write the learned field, also when interrupted; a run that loads it continues exactly there",
     .is_expert = true, .commands = kFiles, .parse = parse_text<&Options::save_field>},
    {.name = "save-field", .flags = "--save-field", .value = "FILE", .group = kHidden, .help = "",
     .is_expert = true, .commands = CommandSet(Command::View), .parse = refuse_save_field},
});
// clang-format on

}  // namespace

std::span<const OptionSpec> field_options() { return kFieldOptions; }

std::span<const OptionSpec> learn_values() { return kLearnValues; }

}  // namespace pl
