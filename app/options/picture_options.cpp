#include <fmt/format.h>

#include "app/options/groups.h"

namespace pl {
namespace {

void parse_frames(Options& options, const std::string& text) {
    options.frames = static_cast<int>(parse_whole(text, 2, 1000000));
}

// clang-format off
constexpr auto kCameraOptions = std::to_array<OptionSpec>({
    {.name = "camera", .flags = "--camera", .value = "FILE|NAME|JSON", .group = kCamera,
     .help = "Parts of the camera, of a .json file or as its text: {\"eye\": [x,y,z], \"target\": [x,y,z], \"up\": [x,y,z], "
             "\"fov_deg\": vertical, \"aperture_radius\": r, \"focus_distance\": d, \"shift_x\": x, \"shift_y\": y}, where the shift "
             "moves the picture in its heights; or a camera that the scene's file lists, by its name or its number from 1, see "
             "'info'. May be given several times; the options below go over it",
     .commands = kPaths, .repeatable = true, .parse = parse_camera, .print = print_camera},
    {.name = "camera", .flags = "--camera", .value = "NAME", .group = kCamera,
     .help = "Camera that the scene's file lists, by its name or its number from 1, see 'info' (default: the first)",
     .commands = CommandSet(Command::Info, Command::Convert), .parse = [](Options& o, Text text) { o.load.camera = text; }},
    {.name = "path", .flags = "--path", .value = "FILE", .group = kCamera,
     .help = "JSON file {\"schema\": \"pathlight.cameras/1\", \"cameras\": [{\"eye\": ...}, ...]}, such as the viewer's "
             "bookmarks: the camera moves through them, in equal times from each to the next",
     .commands = CommandSet(Command::Replay), .parse = parse_text<&Options::camera_path>,
     .print = [](const Options& o) { return o.camera_path; }},
    {.name = "frames", .flags = "--frames", .value = "N", .group = kCamera,
     .help = "Pictures along the path, evenly spaced (default: 24 from each camera to the next)",
     .commands = CommandSet(Command::Replay), .parse = parse_frames,
     .print = [](const Options& o) { return o.frames > 0 ? std::to_string(o.frames) : ""; }},
    {.name = "up-axis", .flags = "--up-axis", .value = "NAME", .group = kCamera,
     .help = "Vertical axis of scenes without a camera, and of the default light",
     .is_expert = true, .commands = kOpening, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.load.up_axis = parse_choice<UpAxis>(text); },
     .print = [](const Options& o) { return o.load.up_axis ? std::string(name_of(*o.load.up_axis)) : ""; },
     .values = [] { return describe_choices<UpAxis>(UpAxis::Auto); }},
    {.name = "eye", .flags = "--eye", .value = "X,Y,Z", .group = kCamera, .help = "Position of the camera",
     .commands = kPaths, .parse = [](Options& o, Text text) { o.camera.eye = parse_vector(text); },
     .print = [](const Options& o) { return print_vector(o.render.camera.eye); }},
    {.name = "target", .flags = "--target", .value = "X,Y,Z", .group = kCamera,
     .help = "Point in the middle of the picture",
     .commands = kPaths, .parse = [](Options& o, Text text) { o.camera.target = parse_vector(text); },
     .print = [](const Options& o) { return print_vector(o.render.camera.target); }},
    {.name = "up", .flags = "--up", .value = "X,Y,Z", .group = kCamera,
     .help = "Direction that points up in the picture",
     .is_expert = true, .commands = kPaths, .parse = [](Options& o, Text text) { o.camera.up = parse_vector(text); },
     .print = [](const Options& o) { return print_vector(o.render.camera.up); }},
    {.name = "fov", .flags = "--fov", .value = "DEG", .group = kCamera, .help = "Full vertical angle of view",
     .commands = kPaths, .parse = parse_fov,
     .print = [](const Options& o) { return print_float(o.render.camera.fov_deg); }},
});
// clang-format on

}  // namespace

std::span<const OptionSpec> camera_options() { return kCameraOptions; }

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
     .is_expert = true, .commands = kPaths, .in_scene_files = true}),
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
