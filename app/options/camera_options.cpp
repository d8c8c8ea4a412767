#include "app/options/groups.h"

#include "core/io/camera_file.h"

namespace pl {
namespace {

void parse_frames(Options& options, const std::string& text) {
    options.frames = static_cast<int>(parse_whole(text, 2, 1000000));
}

// clang-format off
constexpr auto kCameraOptions = std::to_array<OptionSpec>({
    {.name = "camera", .flags = "--camera", .value = "FILE", .group = kCamera,
     .help = "JSON file {\"eye\": [x,y,z], \"target\": [x,y,z], \"up\": [x,y,z], \"fov_deg\": vertical, "
             "\"aperture_radius\": r, \"focus_distance\": d, \"shift_x\": x, \"shift_y\": y}; overrides the scene's camera, and the "
             "options below override both",
     .is_expert = true, .commands = kPaths, .parse = [](Options& o, Text text) { o.camera = load_camera_file(text); }},
    {.name = "scene-camera", .flags = "--scene-camera", .value = "NAME", .group = kCamera,
     .help = "Camera that the scene's file lists, by its name or its number from 1, see 'info' (default: the first)",
     .commands = kOpening, .parse = [](Options& o, Text text) { o.load.camera = text; },
     .print = [](const Options& o) { return o.load.camera; }},
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
    {.name = "aperture", .flags = "--aperture", .value = "R", .group = kCamera,
     .help = "Radius of the lens; 0 is a pinhole, which is sharp everywhere",
     .is_expert = true, .commands = kPaths, .parse = parse_aperture,
     .print = [](const Options& o) { return print_float(o.render.camera.aperture_radius); }},
    {.name = "focus", .flags = "--focus", .value = "D", .group = kCamera,
     .help = "Distance of the plane in focus, along the view",
     .is_expert = true, .commands = kPaths, .parse = parse_focus,
     .print = [](const Options& o) { return print_float(o.render.camera.focus_distance); }},
    {.name = "shift-x", .flags = "--shift-x", .value = "X", .group = kCamera,
     .help = "Shift of the picture to the right, in its heights, with the camera in place, as of an architect's lens",
     .is_expert = true, .commands = kPaths, .parse = [](Options& o, Text text) { o.camera.shift_x = parse_float(text); },
     .print = [](const Options& o) { return print_float(o.render.camera.shift.x); }},
    {.name = "shift-y", .flags = "--shift-y", .value = "Y", .group = kCamera, .help = "The same upwards",
     .is_expert = true, .commands = kPaths, .parse = [](Options& o, Text text) { o.camera.shift_y = parse_float(text); },
     .print = [](const Options& o) { return print_float(o.render.camera.shift.y); }},
});
// clang-format on

}  // namespace

std::span<const OptionSpec> camera_options() { return kCameraOptions; }

}  // namespace pl
