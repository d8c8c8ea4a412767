// Options as values: of the command line and of scene files.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/io/camera_file.h"
#include "core/io/image.h"
#include "core/io/load_settings.h"
#include "core/scene/description.h"
#include "core/session/choices.h"

namespace pl {

enum class Command : std::uint32_t {
    View,
    Render,
    Replay,
    Info,
    Convert,
    Devices,
    Inspect,
    Trace,
    Compare,
    Reference,
    Bench,
    Report,
    Score,
    SelfTest
};

/// A point in the scene; its normal, if given, selects a side of the surface.
struct ScenePoint {
    glm::vec3 position{0.0f};
    std::optional<glm::vec3> normal;
};

/// Samples of one pixel by their numbers in the picture, both ends included.
struct SampleNumbers {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
};

/// What a PNG of a learned hemisphere shows.
enum class HemisphereDisplay { Disc, Lobe, Dome, Flowers };

template <>
inline constexpr auto kChoices<HemisphereDisplay> = std::to_array<ChoiceInfo<HemisphereDisplay>>({
    {HemisphereDisplay::Disc, "disc", "Disc", "the hemisphere as an equal-area disc"},
    {HemisphereDisplay::Lobe, "lobe", "Lobe", "in the scene, as long as its density"},
    {HemisphereDisplay::Dome, "dome", "Glass dome", "in the scene, to see through"},
    {HemisphereDisplay::Flowers, "flowers", "Flowers", "in the scene, the lobes of every n-th volume"},
});

/// A part of a picture, rows counted from the top.
struct PixelWindow {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// No suite, no protocol.
inline constexpr std::string_view kNoPreset = "none";

struct Options {
    std::string scene;                ///< name or path; empty if none was given
    std::vector<std::string> inputs;  ///< positional arguments of subcommands that do not take one scene
    LoadSettings load;                ///< choices for opening the scene
    std::string output;

    RenderSettings render;  ///< final only after resolve_options(): camera and size depend on the scene
    DisplaySettings display;
    std::string backend = "auto";
    int threads = 0;  ///< 0: all
    std::optional<std::uint32_t> spp;
    std::optional<double> time_limit_seconds;
    std::optional<double> target_error;     ///< of Metrics::relmse
    std::optional<PixelWindow> crop;        ///< the part of the picture that is rendered; `render` is of this part
    int width = 0;                          ///< 0: not given
    int height = 0;                         ///< 0: not given
    CameraChoice camera;                    ///< given parts; the others are the scene's
    std::string camera_path;                ///< replay: file of its cameras
    int frames = 0;                         ///< replay: 0: 24 from each camera to the next
    ImageKind frame_kind = ImageKind::Png;  ///< replay

    std::vector<MethodId> methods;       ///< bench: all to compare; empty: every one
    std::vector<Representation> fields;  ///< bench: all to compare; empty: as in each scene's settings
    std::vector<std::string> backends;   ///< bench: empty: all that are available
    int seeds = 10;                      ///< bench: runs of each method, back end and scene
    std::uint32_t reference_spp = 4096;  ///< bench: samples per pixel in each half of references that it makes
    std::string reference_folder;        ///< bench: empty: its own
    std::string gate;                    ///< bench: earlier results to compare the new ones with
    double tolerance_percent = 10.0;     ///< bench: slowdown against the gate's results that passes
    std::string suite{kNoPreset};        ///< bench: of scenes
    std::string scenes_folder;           ///< bench: of the suite
    std::string protocol{kNoPreset};     ///< bench: preset of options
    bool quick = false;                  ///< bench: preset of a short bench
    double measure_percent = 1.0;        ///< bench: time for measuring, relative to the charged time

    bool flip = false;               ///< compare: also FLIP
    double pixels_per_degree = 0.0;  ///< compare: of the display that FLIP assumes; 0: not given

    std::string load_field;  ///< file of a learned field to continue with
    std::string save_field;  ///< file for the learned field

    std::string checkpoint_file;               ///< render: file for its state
    std::optional<double> checkpoint_seconds;  ///< between two of them
    std::string resume_file;                   ///< file of a state to go on from

    std::optional<ScenePoint> at;
    std::optional<glm::ivec2> pixel;
    std::optional<SampleNumbers> samples;               ///< trace: numbers of the pixel's samples
    bool why = false;                                   ///< trace: the noise of the pixel
    std::uint32_t why_samples = 4096;                   ///< paths by each method for it
    bool truth = false;                                 ///< inspect: also the light that reaches the volume
    std::uint32_t truth_samples = 256;                  ///< paths per cell for it
    bool history = false;                               ///< inspect: figures over the passes in place of cells
    HemisphereDisplay drawn = HemisphereDisplay::Disc;  ///< inspect: of cells, in a PNG

    std::string stats_file;
    std::string diagnostics_file;  ///< trace: picture of the places of diagnostics
    std::string gain_file;         ///< trace: where the method of a picture gains or loses
    std::string log_file;
    bool json = false;
    bool quiet = false;
    int verbosity = 0;
    bool no_progress = false;

    std::string script;  ///< viewer: file of scripted input
    std::string
        remember;  ///< viewer: folder for the window's state, or "off"; empty: by the system, off with a script
    std::string ui_trace;   ///< viewer: file of frame times
    bool software = false;  ///< viewer: no graphics card
    std::optional<glm::ivec2> window;
    float ui_scale = 0.0f;  ///< viewer: of text and controls; 0: by the screen

    /// Limit of samples per pixel: 64 unless another limit ends the rendering.
    std::uint32_t spp_limit() const {
        constexpr std::uint32_t kDefaultSpp = 64;
        constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();
        return spp.value_or(time_limit_seconds || target_error ? kNever : kDefaultSpp);
    }
};

}  // namespace pl
