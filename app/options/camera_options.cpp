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

}  // namespace pl
