// `pathlight view`: the window, with what it may not know itself: files, back ends, the command line.
#include "app/commands.h"
#include "core/base/error.h"

#if PL_VIEWER

#include <algorithm>
#include <map>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/field_files.h"
#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/picture_file.h"
#include "app/selftest/self_test.h"
#include "app/viewer_references.h"
#include "core/io/field_file.h"
#include "core/io/load_scene.h"
#include "cuda/availability.h"
#include "ui/viewer.h"

namespace pl {
namespace {

/// The scenes that were opened, for the functions that the viewer calls from any of its threads.
class OpenedScenes {
public:
    void add(const std::string& name, std::shared_ptr<const SceneDescription> scene) {
        const std::lock_guard lock(mutex_);
        scenes_[name] = std::move(scene);
    }
    std::shared_ptr<const SceneDescription> find(const std::string& name) const {
        const std::lock_guard lock(mutex_);
        return scenes_.at(name);
    }

private:
    mutable std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const SceneDescription>> scenes_;
};

/// The window needs a core for itself, where there are several.
int viewer_threads(int asked) {
    return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

/// Knobs were given for the scene that was named with them, and are not those of others.
KnobValues knobs_of(const std::string& scene, const Options& opened) {
    return scene == opened.scene ? opened.knobs : KnobValues{};
}

/// `first_backend` is what the options' choice came to.
std::string command_of(const ViewerPicture& picture, const SceneDescription& scene, const Options& opened,
                       const std::string& first_backend) {
    const Options defaults = scene_defaults(picture.scene, scene);
    Options shown = defaults;
    shown.knobs = knobs_of(picture.scene, opened);
    shown.output = scene.source.stem().string() + ".png";
    shown.render = picture.settings;
    shown.display = picture.display;
    shown.backend = picture.backend == first_backend ? opened.backend : picture.backend;
    shown.threads = opened.threads;
    if (picture.limits.spp > 0) shown.spp = picture.limits.spp;
    if (picture.limits.seconds > 0.0) shown.time_limit_seconds = picture.limits.seconds;
    return command_text(shown, defaults);
}

ImageMetadata metadata_of(const ViewerPicture& picture, const Snapshot& snapshot, const std::string& command) {
    ImageMetadata metadata{{"Software", "pathlight " PL_VERSION},
                           {"scene", picture.scene},
                           {"method", std::string(info_of(snapshot.slot.method).name)},
                           {"view", std::string(info_of(snapshot.slot.view).name)},
                           {"backend", picture.backend},
                           {"spp", std::to_string(snapshot.passes)},
                           {"command", command}};
    if (!picture.edited_materials.empty())
        metadata.emplace_back("edited materials", fmt::format("{}", fmt::join(picture.edited_materials, ", ")));
    return metadata;
}

bool has_size(const CommandLine& line) {
    return std::any_of(line.given.begin(), line.given.end(), [](const GivenOption& given) {
        return given.spec->name == "size" || given.spec->name == "width" || given.spec->name == "height";
    });
}

/// Everything but the functions.
ViewerOptions viewer_options(const CommandLine& line, const Options& options, const LoadedScene& loaded) {
    ViewerOptions viewer;
    viewer.settings = options.render;
    viewer.display = options.display;
    viewer.limits = {.spp = options.spp.value_or(0), .seconds = options.time_limit_seconds.value_or(0.0)};
    viewer.scene_name = options.scene;
    viewer.scene = loaded.scene;
    viewer.load_seconds = loaded.load_seconds;
    viewer.camera_from_scene = false;  // resolved already
    viewer.size_from_window = !has_size(line);
    if (options.window) {
        viewer.width = options.window->x;
        viewer.height = options.window->y;
    }
    viewer.software = options.software;
    viewer.font = find_assets_dir() / "fonts" / "roboto-medium-latin.ttf";
    if (!options.script.empty()) viewer.script = options.script;
    if (!options.ui_trace.empty()) viewer.ui_trace = options.ui_trace;
    return viewer;
}

/// The first one is made here, so that one that is not there is told before a window opens.
void add_backends(ViewerOptions& viewer, const Options& options) {
    const int threads = viewer_threads(options.threads);
    const auto made = std::make_shared<std::unique_ptr<RenderBackend>>(make_backend(options.backend, threads));
    const std::string first = (*made)->info().name;
    BackendChoice cuda{.name = "cuda", .device = "", .unavailable = cuda_unavailable_reason()};
    if (cuda.unavailable.empty()) cuda.device = cuda_devices().front().name;
    viewer.first_backend = first;
    viewer.backends = {{.name = "cpu", .device = make_backend("cpu", threads)->info().device, .unavailable = ""},
                       cuda};
    viewer.make_backend = [made, first, threads](const std::string& name) {
        return name == first && *made ? std::move(*made) : make_backend(name, threads);
    };
}

/// What the viewer asks of the program. All arguments outlive it.
void add_functions(ViewerOptions& viewer, OpenedScenes& scenes, const Options& options, Console& console) {
    viewer.load_scene = [&](const std::string& name) {
        const auto scene = open_scene(name, knobs_of(name, options), console).scene;
        scenes.add(name, scene);
        return scene;
    };
    viewer.command_line = [&](const ViewerPicture& picture) {
        return command_of(picture, *scenes.find(picture.scene), options, viewer.first_backend);
    };
    viewer.save_image = [&](const std::filesystem::path& path, const Snapshot& snapshot,
                            const ViewerPicture& picture) {
        const std::string command = command_of(picture, *scenes.find(picture.scene), options, viewer.first_backend);
        save_picture(path, snapshot, picture.display, metadata_of(picture, snapshot, command));
    };
    viewer.load_field = [&](const std::filesystem::path& path, const OpenScene& scene) {
        const auto field = std::make_shared<LearnedField>(read_field(path));
        try {
            require_learned_in(*scene.description, *field);
        } catch (const Error& error) {
            throw Error(error.kind(), fmt::format("{}: {}", path.string(), error.what()));
        }
        fit_to_run(*field, options.render.field);
        return field;
    };
    viewer.save_field = write_field;
    viewer.find_reference = [](const OpenScene& scene, const RenderSettings& settings) {
        return find_viewer_reference(kViewerReferences, *scene.description, settings);
    };
    viewer.make_reference = [&](const OpenScene& scene, const RenderSettings& settings, const JobMonitor& monitor) {
        return make_viewer_reference(kViewerReferences, scene.name, scene.description, settings,
                                     viewer_threads(options.threads), monitor);
    };
    viewer.run_self_test = [&](const JobMonitor& monitor, const std::function<void(const SelfCheck&)>& told) {
        (void)run_self_test(available_backends(), viewer_threads(options.threads), told, monitor.stop);
    };
    viewer.save_screen = [](const std::filesystem::path& path, const ScreenPixels& pixels) {
        write_png8(path, {.width = pixels.width, .height = pixels.height, .rgb = pixels.rgb});
    };
}

}  // namespace

int run_view(const CommandLine& line, Console& console) {
    const LoadedScene loaded = open_scene(line.options.scene, line.options.knobs, console);
    FieldFiles fields(line.options);
    const Options options = resolve_options(line, *loaded.scene, fields.loaded());
    OpenedScenes scenes;
    scenes.add(options.scene, loaded.scene);

    ViewerOptions viewer = viewer_options(line, options, loaded);
    add_backends(viewer, options);
    add_functions(viewer, scenes, options, console);
    viewer.field = fields.take(*loaded.scene, options);
    try {
        return run_viewer(viewer);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Unavailable) throw;
        throw Error(ErrorKind::Unavailable,
                    fmt::format("{}; without a display: pathlight render {} -o {}.png", error.what(), options.scene,
                                loaded.scene->source.stem().string()));
    }
}

}  // namespace pl

#else

namespace pl {

int run_view(const CommandLine& line, Console&) {
    throw Error(ErrorKind::Unavailable,
                "this build has no viewer (it needs SDL2 and Dear ImGui); without one: pathlight render " +
                    line.options.scene + " -o picture.png");
}

}  // namespace pl

#endif
