// `pathlight view`: the window, with back ends, scenes and the command line as the program knows them.
#include <algorithm>

#include <fmt/format.h>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/parse_values.h"
#include "app/state_files.h"
#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/load_scene.h"
#include "cuda/availability.h"
#include "ui/viewer.h"

namespace pl {
namespace {

/// Leaves one core to the window where there are several. Throws Error(Unavailable).
std::unique_ptr<RenderBackend> make_beside_window(const std::string& name, int threads) {
    return make_own_backend(name, threads > 0 ? threads : std::max(1, usable_share() - 1));
}

/// Vertical axis, camera, parameters and materials, by the command line, belong to the scene that it names, not to
/// scenes opened later. Parameters of the scene that are knobs come with the request.
LoadSettings load_settings_of(const ui::SceneRequest& scene, const Options& opened) {
    LoadSettings settings{.default_light = opened.load.default_light};
    for (const auto& [name, value] : scene.knobs) settings.parameters.emplace_back(name, print_float(value));
    if (scene.name == opened.scene) {
        settings.up_axis = opened.load.up_axis;
        settings.camera = opened.load.camera;
        if (suffix_of(scene.name) == ".xml") settings.parameters = opened.load.parameters;
        settings.materials = opened.load.materials;
    }
    return settings;
}

void show_sequence(const ui::ViewerSequence& sequence, Options& shown) {
    shown.camera_path = sequence.cameras.string();
    shown.output = sequence.folder.string();
    shown.frames = sequence.frames;
    shown.frame_kind = sequence.kind;
    shown.spp.reset();
    shown.time_limit_seconds.reset();
    if (sequence.limits.spp > 0) shown.spp = sequence.limits.spp;
    if (sequence.limits.seconds > 0.0) shown.time_limit_seconds = sequence.limits.seconds;
}

/// `first_backend` is the back end that the options' choice selected.
std::string command_of(const ui::ViewerPicture& picture, const Options& opened, const std::string& first_backend) {
    const Options defaults = scene_defaults(picture.scene.name, *picture.description);
    Options shown = defaults;
    shown.load = load_settings_of(picture.scene, opened);
    if (!picture.materials.empty()) shown.load.materials = picture.materials;
    shown.output = picture.description->source.stem().string() + ".png";
    shown.render = picture.settings;
    shown.display = picture.display;
    shown.backend = picture.backend == first_backend ? opened.backend : picture.backend;
    shown.threads = opened.threads;
    if (picture.spp > 0) shown.spp = picture.spp;
    shown.load_field = picture.field;
    if (!picture.sequence) return command_text(Command::Render, shown, defaults);
    show_sequence(*picture.sequence, shown);
    return command_text(Command::Replay, shown, defaults);
}

/// Whether the command line asks for no picture of its own.
bool is_free(const CommandLine& line) {
    return !line.has_scene && std::ranges::none_of(line.given, [](const GivenOption& given) {
        return given.spec->print != nullptr || given.spec->name == "load-field";
    });
}

/// All members but the functions.
ui::ViewerOptions viewer_options(const CommandLine& line, const Options& options, const LoadedScene& loaded) {
    ui::ViewerOptions viewer;
    viewer.settings = options.render;
    viewer.display = options.display;
    viewer.limits = {.spp = options.spp.value_or(0), .seconds = options.time_limit_seconds.value_or(0.0)};
    viewer.scene_name = options.scene;
    viewer.scenes = list_scenes(find_assets_dir());
    viewer.scenes_folder = find_assets_dir() / "scenes";
    viewer.scene = loaded.scene;
    viewer.load_seconds = loaded.load_seconds;
    viewer.camera_from_scene = false;  // resolved already
    viewer.size_from_window =
        !(is_given(line.given, "size") || is_given(line.given, "width") || is_given(line.given, "height"));
    if (options.window) viewer.window = {.width = options.window->x, .height = options.window->y};
    viewer.window.ui_scale = options.ui_scale;
    viewer.software = options.software;
    viewer.is_free = is_free(line);
    viewer.font = find_assets_dir() / "fonts" / "roboto-medium-latin.ttf";
    viewer.remember = options.remember.empty() ? options.script.empty() : options.remember != "off";
    if (viewer.remember) viewer.remember_folder = options.remember;
    if (!options.script.empty()) viewer.script = options.script;
    if (!options.ui_trace.empty()) viewer.ui_trace = options.ui_trace;
    return viewer;
}

/// Makes back ends for the viewer, in its worker: the context of a device takes up to a second, in which the window is there already.
/// That there is no device is told before a window opens.
class ViewerBackends {
public:
    explicit ViewerBackends(const Options& options)
        : threads_(options.threads), first_name_(backend_name(options.backend)) {}

    const std::string& first_name() const { return first_name_; }
    /// For the picture of the window, which all ranks of a job share.
    std::unique_ptr<RenderBackend> make_shared(const std::string& name) const {
        return make_backend(name, threads_, make_beside_window);
    }
    std::unique_ptr<RenderBackend> make_own(const std::string& name) const {
        return make_beside_window(name, threads_);
    }
    ui::BackendChoices choices() const {
        ui::BackendChoice cuda{.name = "cuda", .device = "", .unavailable = cuda_unavailable_reason()};
        if (cuda.unavailable.empty()) cuda.device = cuda_devices().front().name;
        return {{.name = "cpu", .device = make_own("cpu")->info().device, .unavailable = ""}, cuda};
    }

private:
    int threads_;
    std::string first_name_;
};

/// The viewer's calls into the program. All arguments outlive it.
void add_functions(ui::ViewerOptions& viewer, ViewerBackends& backends, const Options& options) {
    viewer.make_backend = [&](const std::string& name) { return backends.make_shared(name); };
    viewer.make_side_backend = [&](const std::string& name) { return backends.make_own(name); };
    viewer.load_scene = [&](const ui::SceneRequest& request) {
        return std::make_shared<const SceneDescription>(
            load_scene(request.name, find_assets_dir(), load_settings_of(request, options)));
    };
    viewer.command_line = [&](const ui::ViewerPicture& picture) {
        return command_of(picture, options, backends.first_name());
    };
}

}  // namespace

int run_view(const CommandLine& line, Console& console) {
    const LoadedScene loaded = open_scene(line.options.scene, line.options.load, console);
    FieldFiles fields(line.options);
    const Options options = resolve_options(line, *loaded.scene, fields.loaded());
    ViewerBackends backends(options);
    ui::ViewerOptions viewer = viewer_options(line, options, loaded);
    viewer.first_backend = backends.first_name();
    viewer.backends = backends.choices();
    add_functions(viewer, backends, options);
    viewer.field = fields.take(*loaded.scene, options);
    const InterruptGuard interrupt;
    viewer.stop = interrupt.flag();
    try {
        const int code = ui::run_viewer(viewer);
        return interrupt.raised() ? kExitInterrupted : code;
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Unavailable) throw;
        throw Error(ErrorKind::Unavailable,
                    fmt::format("{}; without a display: pathlight render {} -o {}.png", error.what(), options.scene,
                                loaded.scene->source.stem().string()));
    }
}

}  // namespace pl
