// The data passed from the render thread to the window: immutable after publishing, shared by reference.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnose/diagnostics.h"
#include "core/diagnose/pixel_paths.h"
#include "core/scene/default_light.h"
#include "core/scene/pack_scene.h"
#include "core/session/shown_range.h"
#include "ui/viewer.h"

namespace pl::ui {

/// The radiance volume that serves each pixel, as display colors of color_of_id(); see ui/worker/cell_image.h.
struct CellImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint32_t> argb;
};

/// Properties of a scene that take a look at all of its triangles.
struct SceneFacts {
    float diagonal = 0.0f;  ///< of its bounds
    SceneLight light = SceneLight::Own;
};

inline SceneFacts facts_of(const SceneDescription& scene) {
    return {.diagonal = bounds_of(scene).diagonal(), .light = light_of(scene)};
}

/// A picture in place of the one of the settings, while the camera moves.
enum class Preview {
    None,
    LightSamples,  ///< the same picture with light samples
    RadianceMap,   ///< the learned radiance, interpolated
};

/// "none", "light samples", "radiance map".
const char* name_of(Preview preview);

struct PublishedFrame {
    DisplayFrame picture;   ///< the film in 8 bits, by `display`; may still be in transfer
    DisplayFrame denoised;  ///< the same for the eye, see Denoiser; without width: none was made
    double denoise_seconds = 0.0;
    DisplaySettings display;
    Snapshot snapshot;             ///< with pixels only if has_values()
    RenderSettings settings;       ///< with the width and height of the full picture
    std::uint64_t serial = 0;      ///< number of the frame, from 1
    std::uint64_t generation = 0;  ///< of the newest edit that this picture shows
    int divider = 1;               ///< width and height of the snapshot are divided by this
    Preview preview = Preview::None;
    std::size_t side = 0;  ///< in turns: 1 if it is of the second side
    BackendInfo backend;
    std::shared_ptr<const SceneDescription> description;
    std::shared_ptr<const HostScene> scene;
    SceneFacts facts;                                ///< of `description`
    ShownRange range;                                ///< of the snapshot
    std::shared_ptr<const CellImage> cells;          ///< null if not requested, or of another camera pose
    std::shared_ptr<const VolumeInspection> volume;  ///< of the selected volume; null if there is nothing to show
    std::vector<std::shared_ptr<const VolumeInspection>> pins;  ///< of the pinned volumes, in their order

    /// Whether the snapshot has the values of the film.
    bool has_values() const { return !snapshot.pixels.empty(); }
};

/// Whether a frame has the values of a view in heat colors, whose range the window chooses.
inline bool shows_heat(const PublishedFrame& frame) {
    return frame.has_values() && is_heat_map(frame.snapshot.slot.view);
}

/// The film as it is now, with its values if they are wanted; `facts` is left to the caller, who may know them already. The film has
/// a pass.
PublishedFrame frame_of_film(Session& session, FilmSlot slot, const DisplaySettings& display, bool with_values);

enum class WorkerState { Starting, Rendering, Precomputing, Paused, Done, Failed };
const char* name_of(WorkerState state);

/// Two runs that render in turns of equal time.
struct TurnSides {
    std::array<MethodId, 2> methods{};
    /// Of the second run, where they are others than those of the session: another session renders it then.
    std::shared_ptr<const RenderSettings> second{};

    friend bool operator==(const TurnSides&, const TurnSides&) = default;
};
struct TurnsStatus {
    TurnSides sides{};
    std::array<std::uint32_t, 2> passes{};
    std::array<double, 2> seconds{};  ///< work_seconds() of each
    bool catching_up = false;         ///< one works alone until both have had the same time
};

/// Changes with every pass; cheap to copy.
struct WorkerStatus {
    WorkerState state = WorkerState::Starting;
    std::uint32_t passes = 0;
    std::uint64_t all_passes = 0;  ///< of every film, since the start
    int divider = 1;
    double seconds = 0.0;              ///< work_seconds()
    std::optional<TurnsStatus> turns;  ///< then passes and seconds are those of the first side
    std::uint64_t generation = 0;
    std::uint64_t placement = 0;  ///< changes when numbers of volumes lose their meaning; refinement keeps them
    std::uint64_t picture = 0;    ///< picture_key() of the film, as RunLabel::picture; 0 while the camera moves
    std::shared_ptr<const SceneDescription> scene;  ///< with the materials as edited; never null
    std::optional<FieldStatus> field;
    std::string backend;                             ///< name of the one in use
    std::shared_ptr<const BackendChoices> backends;  ///< never null
};

/// A point of a surface, by which the volume that serves it is found again.
struct SurfacePlace {
    Vec3f position{0.0f};
    Vec3f normal{0.0f};

    friend bool operator==(const SurfacePlace&, const SurfacePlace&) = default;
};
struct FoundVolume {
    SurfacePlace at;
    std::int32_t volume = kNoVolume;  ///< kNoVolume: none serves the place
};

/// A message for the user.
struct WorkerMessage {
    bool is_error = false;
    std::string text;
};

/// Answer to a question of the window about the session.
template <class Value>
struct Answer {
    Value value{};                 ///< empty if there is none
    std::string reason{};          ///< for the lack of it
    std::uint64_t generation = 0;  ///< of the newest edit that the picture shows
    std::uint64_t placement = 0;   ///< of numbers of volumes in the value, see WorkerStatus::placement
};
/// To RenderWorker::request_pick.
using PickAnswer = Answer<std::optional<PickedPoint>>;
/// To RenderWorker::request_volumes, in the order of the places.
using VolumesAnswer = Answer<std::vector<FoundVolume>>;
/// To RenderWorker::request_learned.
using LearnedAnswer = Answer<std::shared_ptr<const LearnedField>>;
/// To RenderWorker::request_diagnostics; empty if the view traces no paths.
using DiagnosticsAnswer = Answer<std::optional<diagnose::DiagnosticsInput>>;
/// To RenderWorker::request_paths, for the picture; empty if its view traces no paths.
using PathsAnswer = Answer<std::shared_ptr<diagnose::PassPair>>;
/// To RenderWorker::request_gain: the pictures so far of default and of a guided method, with their halves; null if one of both has less
/// than two passes.
using GainAnswer = Answer<std::array<std::shared_ptr<const Snapshot>, 2>>;

}  // namespace pl::ui
