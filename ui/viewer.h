// The viewer: a window in which a session runs. The program makes back ends, loads scenes and writes the command line;
// the viewer does everything else.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/io/image.h"
#include "core/measure/live_runs.h"
#include "core/scene/description.h"
#include "core/session/backend.h"
#include "core/session/learned_field.h"
#include "core/session/settings.h"
#include "core/session/snapshot.h"

namespace pl::ui {

/// Rendering rests when the first one is reached. 0: no such limit.
struct SampleLimits {
    std::uint32_t spp = 0;
    double seconds = 0.0;  ///< placing, precomputing, learning and rendering; see work_seconds()

    friend bool operator==(const SampleLimits&, const SampleLimits&) = default;
};

/// The time of limits and displays: all work but loading and building.
inline double work_seconds(const Clocks& clocks) {
    return clocks.place + clocks.precompute + clocks.learn + clocks.render;
}

/// A back end that the viewer can run on, or the reason why it cannot; one that failed may be tried again.
struct BackendChoice {
    std::string name;         ///< as make_backend takes it: "cpu", "cuda"
    std::string device;       ///< name of the processor; empty while unknown
    std::string unavailable;  ///< why it cannot be used; empty if it can
    std::string failed{};     ///< reason of its failure in its last use; empty if it has not failed
};
using BackendChoices = std::vector<BackendChoice>;

/// A scene to be loaded, with the values of its knobs; the others have their defaults.
struct SceneRequest {
    std::string name;  ///< a known scene, or a file
    KnobValues knobs{};

    friend bool operator==(const SceneRequest&, const SceneRequest&) = default;
};

/// The pictures of a camera path.
struct ViewerSequence {
    std::filesystem::path folder;   ///< of the pictures
    std::filesystem::path cameras;  ///< file of the path
    int frames = 0;
    ImageKind kind = ImageKind::Png;
    SampleLimits limits;  ///< of each
};

/// The settings of the viewer that a saved file or a command line repeats.
struct ViewerPicture {
    SceneRequest scene;                                   ///< with the knobs that are not at their defaults
    std::shared_ptr<const SceneDescription> description;  ///< as loaded; never null
    std::string backend;                                  ///< name as make_backend takes it
    RenderSettings settings;
    DisplaySettings display;
    SampleLimits limits;
    std::uint32_t spp = 0;  ///< samples per pixel so far
    std::string field{};  ///< file with the learned field that a picture like this one continues from; empty for none
    std::string materials{};  ///< file with the materials of the window; empty if they are as in the scene's files
    std::vector<std::string> edited_materials{};  ///< names of those that are not as in the scene's files
    std::optional<ViewerSequence> sequence{};     ///< in place of a single picture
};

/// The scene that is open, with the materials that were changed in the window.
struct OpenScene {
    std::string name;                                     ///< as load_scene takes it
    std::shared_ptr<const SceneDescription> description;  ///< never null
};

/// A stored reference.
struct StoredReference {
    LiveReference halves;
    std::array<std::uint32_t, 2> spp{};  ///< samples per pixel of each half
    double noise_relmse = 0.0;           ///< of the mean of both
};

/// Between work in the background and the window. `progress` may be called from any thread of the work.
struct JobMonitor {
    const StopFlag* stop = nullptr;
    std::function<void(double share, const std::string& detail)> progress;
};

/// Window and scale of its text as the user asked for them; 0: by the screen.
struct WindowOptions {
    int width = 0;
    int height = 0;
    float ui_scale = 0.0f;
};

struct ViewerOptions {
    RenderSettings settings;
    DisplaySettings display;
    SampleLimits limits;
    std::string scene_name;                 ///< as load_scene takes it, at the start
    std::vector<std::string> scenes{};      ///< names that the dialog offers
    std::filesystem::path scenes_folder{};  ///< of their pictures, NAME/NAME.png, with what they show as text "about"
    /// The scene if it is loaded already; otherwise it is loaded before the window opens.
    std::shared_ptr<const SceneDescription> scene;
    double load_seconds = 0.0;                  ///< of `scene`
    std::shared_ptr<const LearnedField> field;  ///< to continue from; null for none. Fits `settings`
    bool camera_from_scene = true;              ///< start from the scene's camera instead of settings.camera
    bool size_from_window = true;  ///< settings.width : height is a shape only; the window decides the size

    WindowOptions window;
    bool software = false;       ///< do not look for an accelerated renderer
    std::filesystem::path font;  ///< .ttf; the built-in font if it is missing
    std::filesystem::path screenshot_dir = ".";
    std::filesystem::path reference_dir = "references";  ///< of stored references; found and made there
    bool remember = true;                                ///< state of the window, between starts
    bool is_free = false;                   ///< nothing was asked for: a first start shows what the program is about
    std::filesystem::path remember_folder;  ///< of viewer.json; empty: the system's folder for such files
    std::optional<std::filesystem::path> script;    ///< scripted input, see ui/script/script.h
    std::optional<std::filesystem::path> ui_trace;  ///< one JSON object per UI frame; percentiles on stderr
    const StopFlag* stop = nullptr;                 ///< raised: the window is closed

    /// In the order of the key that steps through them. One should be "cpu": it takes over when another fails.
    BackendChoices backends{{"cpu", "", ""}};
    std::string first_backend = "cpu";
    /// Called on the render thread when a back end is first selected; no other uses it while that one runs. Throws
    /// Error(Unavailable). Should leave one hardware thread to the window if there are several.
    BackendFactory make_backend;
    /// The same for any thread: for references and the self test, beside the picture of the window.
    BackendFactory make_side_backend;
    /// A scene by name. Throws Error: Input with file and line, Usage for an unknown knob or a value out of its range.
    /// Called on helper threads after the start.
    std::function<std::shared_ptr<const SceneDescription>(const SceneRequest& request)> load_scene;
    /// The shell command that renders the picture; may be empty. Called on any thread.
    std::function<std::string(const ViewerPicture&)> command_line;
};

/// Runs until the window is closed; returns 0. Throws Error: Unavailable without display or back end, Input for a bad
/// scene or script, Runtime if a scripted expectation fails.
int run_viewer(const ViewerOptions& options);

}  // namespace pl::ui
