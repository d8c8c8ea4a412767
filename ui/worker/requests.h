// The requests of the window to the render thread: state that holds until it is changed, and requests that are
// answered once.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/measure/live_runs.h"
#include "ui/viewer.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

/// Requests that are complete once carried out.
struct OneShotRequests {
    int steps = 0;                       ///< passes while paused
    std::optional<Vec2f> pick;           ///< point of the image, in [0,1)^2 from the top left
    std::vector<SurfacePlace> places{};  ///< whose volumes are asked for
    bool learned = false;                ///< the learned field
    bool diagnostics = false;            ///< the input of find_diagnostics()
    bool paths = false;                  ///< the input of trace_pixel()
    bool gain = false;                   ///< the input of tile_gains()

    /// Whether one is to be answered.
    bool has_question() const { return pick || !places.empty() || learned || diagnostics || paths || gain; }
};

struct Requests {
    bool moving = false;  ///< the camera moves
    bool paused = false;
    bool low_resolution = true;  ///< pictures may be coarse while the camera moves
    bool preview = true;         ///< then pictures may also be a preview, see MotionPreview
    bool cells = false;          ///< frames carry the image of the volumes' cells
    bool values = false;         ///< frames carry the values of the film
    bool denoised = false;       ///< frames carry a denoised display of the first samples
    DisplaySettings display{};
    SampleLimits limits{};
    std::int32_t volume = kNoVolume;   ///< selected for inspection
    std::vector<std::int32_t> pins{};  ///< further ones
    std::size_t history_bytes = 0;     ///< memory for key frames of the field; 0: none are taken
    std::optional<TurnSides> turns{};
    std::shared_ptr<const LiveReference> reference{};
    std::string backend{};
    std::uint64_t generation = 0;  ///< number of edits and switches of back ends so far
    OneShotRequests once{};

    /// Whether a film of this many passes and seconds has reached a limit.
    bool is_enough(std::uint32_t passes, double seconds) const {
        return (limits.spp > 0 && passes >= limits.spp) || (limits.seconds > 0.0 && seconds >= limits.seconds);
    }
};

}  // namespace pl::ui
