#include "app/options/groups.h"

#include <fmt/format.h>

namespace pl {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

// clang-format off
constexpr auto kPictureOptions = std::to_array<OptionSpec>({
    {.name = "view", .flags = "--view", .value = "NAME", .group = kPicture,
     .help = "Quantity in the picture, explained by --list-views",
     .commands = kPictures, .in_scene_files = true, .parse = parse_view,
     .print = [](const Options& o) { return std::string(info_of(o.render.view).name); },
     .values = [] { return one_of(view_names()); }},
    {.name = "backend", .flags = "--backend", .value = "NAME", .group = kPicture,
     .help = "Back end: auto, cpu, cuda",
     .commands = kOneMethod, .in_scene_files = true, .parse = parse_backend,
     .print = [](const Options& o) { return o.backend; }},
    {.name = "backend", .flags = "--backend", .value = "NAME", .group = kCompared,
     .help = "Back end to test: cpu, cuda (default: all that are available)",
     .commands = CommandSet(Command::SelfTest), .parse = parse_backend},
    {.name = "threads", .flags = "-t,--threads", .value = "N", .group = kPicture,
     .help = "CPU threads (default: all); the picture does not depend on their number",
     .commands = kThreaded, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.threads = static_cast<int>(parse_whole(text, 1, 1024)); },
     .print = [](const Options& o) { return o.threads == 0 ? "" : std::to_string(o.threads); }},
    {.name = "size", .flags = "--size", .value = "WxH", .group = kPicture,
     .help = "Picture size in pixels (default 512x512, or the scene's)",
     .commands = kPaths, .in_scene_files = true, .parse = parse_picture_size,
     .print = [](const Options& o) { return fmt::format("{}x{}", o.render.width, o.render.height); }},
    {.name = "width", .flags = "--width", .value = "N", .group = kPicture,
     .help = "Picture width; alone, the height keeps the scene's aspect",
     .is_expert = true, .commands = kPaths, .in_scene_files = true, .parse = parse_side<&Options::width>},
    {.name = "height", .flags = "--height", .value = "N", .group = kPicture,
     .help = "Picture height; alone, the width keeps the scene's aspect",
     .is_expert = true, .commands = kPaths, .in_scene_files = true, .parse = parse_side<&Options::height>},
    {.name = "crop", .flags = "--crop", .value = "X,Y,W,H", .group = kPicture,
     .help = "Only this window of the picture, in pixels from its top left corner: a picture of W x H pixels, of the camera that "
             "shows this part alone, with random numbers of its own",
     .commands = CommandSet(Command::Render, Command::Inspect, Command::Trace, Command::Reference, Command::Bench),
     .parse = parse_crop},
    {.name = "seed", .flags = "--seed", .value = "N", .group = kPicture,
     .help = "Seed of the random numbers (default 1): same seed, same bits",
     .commands = kPaths, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.render.seed = parse_whole(text, 0, kNoLimit); },
     .print = [](const Options& o) { return std::to_string(o.render.seed); }},
    {.name = "max-depth", .flags = "--max-depth", .value = "N", .group = kPicture,
     .help = "Most vertices on a path (default 64), a safety net: Russian roulette ends paths",
     .commands = kPaths, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.render.max_depth = static_cast<int>(parse_whole(text, 1, 65536)); },
     .print = [](const Options& o) { return std::to_string(o.render.max_depth); }},
    {.name = "nee", .flags = "--nee", .value = "on|off", .group = kPicture,
     .help = "Next-event estimation: also sample lights, weighted by multiple importance sampling (default "
             "on)",
     .commands = kWithScene, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.render.next_event = parse_switch(text); },
     .print = [](const Options& o) { return std::string(o.render.next_event ? "on" : "off"); }},
    choosing<&Options::render, &RenderSettings::roulette>(
    {.name = "roulette", .flags = "--roulette", .value = "NAME", .group = kPicture, .help = "Rule of Russian roulette",
     .is_expert = true, .commands = kSampling, .in_scene_files = true}),
    choosing<&Options::render, &RenderSettings::guiding>(
    {.name = "guiding", .flags = "--guiding", .value = "NAME", .group = kPicture,
     .help = "Guided methods with light samples",
     .is_expert = true, .commands = CommandSet(Command::View, Command::Render, Command::Replay, Command::Trace), .in_scene_files = true}),
    {.name = "define", .flags = "-D,--define", .value = "NAME=VALUE", .group = kPicture,
     .help = "Give a knob of the scene ('info' lists them), or the $NAME of a Mitsuba scene, this value; may be given several times",
     .commands = kOpening, .repeatable = true, .parse = parse_parameter, .print = print_parameters},
    {.name = "materials", .flags = "--materials", .value = "FILE", .group = kPicture,
     .help = "JSON file with values of materials, as the viewer writes it when a command is copied; they replace those "
             "of the scene",
     .is_expert = true, .commands = kOpening, .parse = [](Options& o, Text text) { o.load.materials = text; },
     .print = [](const Options& o) { return o.load.materials.string(); }},
    {.name = "default-light", .flags = "--default-light", .value = "on|off", .group = kPicture,
     .help = "Light a scene that has no light with a sky and a soft sun (default on); no scene with a light changes",
     .is_expert = true, .commands = kOpening, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.load.default_light = parse_switch(text); }, .print = print_default_light},
    {.name = "exposure", .flags = "--exposure", .value = "EV", .group = kPicture,
     .help = "Display only: factor 2^EV (default 0)",
     .commands = kPictures, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.display.exposure_ev = static_cast<float>(parse_real(text, -64, 64)); },
     .print = [](const Options& o) { return print_float(o.display.exposure_ev); }},
    choosing<&Options::display, &DisplaySettings::curve>(
    {.name = "tonemap", .flags = "--tonemap", .value = "NAME", .group = kPicture,
     .help = "Tone curve, display only", .is_expert = true, .commands = kPictures, .in_scene_files = true}),
});
// clang-format on

}  // namespace

std::span<const OptionSpec> picture_options() { return kPictureOptions; }

}  // namespace pl
