// Options: what a person has asked for on the command line and in a scene file, as values.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/scene/description.h"
#include "core/session/settings.h"

namespace pl {

enum class Command : std::uint32_t {
    View,
    Render,
    Info,
    Devices,
    Inspect,
    Compare,
    Reference,
    Bench,
    Report,
    SelfTest
};

/// Which of the camera's parts were given; the rest is the scene's.
struct CameraChoice {
    std::optional<glm::vec3> eye;
    std::optional<glm::vec3> target;
    std::optional<glm::vec3> up;
    std::optional<float> fov_deg;
    std::optional<float> aperture_radius;
    std::optional<float> focus_distance;
};

/// A place in the scene, and the side of a surface if a normal was given.
struct ScenePoint {
    glm::vec3 position{0.0f};
    std::optional<glm::vec3> normal;
};

struct Options {
    std::string scene;                ///< name or path; empty if none was given
    std::vector<std::string> inputs;  ///< of subcommands that take something else than one scene, in the order given
    KnobValues knobs;                 ///< of the scene, in the order given
    std::string output;

    RenderSettings render;  ///< final only after resolve_options(): camera and size depend on the scene
    DisplaySettings display;
    std::string backend = "auto";
    int threads = 0;  ///< 0: all
    std::optional<std::uint32_t> spp;
    std::optional<double> time_limit_seconds;
    std::optional<double> target_error;  ///< of Metrics::relmse
    int width = 0;                       ///< 0: not given
    int height = 0;                      ///< 0: not given
    CameraChoice camera;

    std::vector<MethodId> methods;       ///< bench: all to compare; empty: every one
    std::vector<std::string> backends;   ///< bench: empty: all that are available
    int seeds = 10;                      ///< bench: runs of each method, back end and scene
    std::uint32_t reference_spp = 4096;  ///< bench: samples per pixel in each half of references that it makes
    std::string reference_folder;        ///< bench: empty: its own; render: empty: the target is one of noise
    std::string gate;                    ///< bench: results to hold the new ones against
    double tolerance_percent = 10.0;     ///< bench: how much slower than the gate's is not a failure
    bool effects = false;                ///< bench: measure kernels of effects instead of methods
    double measure_percent = 1.0;        ///< bench: of the charged time, what measuring may take

    bool flip = false;               ///< compare: also what an eye would see
    double pixels_per_degree = 0.0;  ///< compare: of the display that FLIP supposes; 0: not given

    std::string load_field;  ///< file to go on from
    std::string save_field;  ///< file for what was learned

    std::optional<ScenePoint> at;
    std::optional<glm::ivec2> pixel;

    std::string stats_file;
    std::string diagnostics_file;  ///< render: picture of where something went wrong
    std::string log_file;
    bool json = false;
    bool quiet = false;
    int verbosity = 0;
    bool no_progress = false;

    std::string script;     ///< viewer: file of scripted input
    std::string ui_trace;   ///< viewer: file of frame times
    bool software = false;  ///< viewer: no graphics card
    std::optional<glm::ivec2> window;

    /// Samples per pixel after which to stop. 64 unless something else ends the rendering.
    std::uint32_t spp_limit() const {
        constexpr std::uint32_t kDefaultSpp = 64;
        constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();
        return spp.value_or(time_limit_seconds || target_error ? kNever : kDefaultSpp);
    }
};

}  // namespace pl
