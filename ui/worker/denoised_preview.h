// The picture of few samples as the window shows it: denoised, beside the picture itself.
#pragma once

#include <memory>

#include "core/inspect/denoise.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

class DenoisedPreview {
public:
    /// From as many samples on the picture is shown as it is.
    static constexpr std::uint32_t kEnoughPasses = 16;

    /// Gives a frame with values the denoised display of its picture; nothing to views other than the picture. On devices neither: they
    /// have the samples before the processor has traced the first surfaces. False if `stop` was set meanwhile: then the frame is as before.
    bool add_to(PublishedFrame& frame, const Session& session, const StopFlag& stop);
    /// Seconds that a frame of this many pixels takes, as the last one did.
    double seconds_for(int width, int height) const { return pixel_seconds_ * width * height; }

private:
    /// Of the first surfaces.
    struct Key {
        std::uint64_t films = 0;  ///< FilmOrigin::generation: edits of scene, camera and size empty them
        std::shared_ptr<const HostScene> scene{};
        int width = 0;
        int height = 0;

        friend bool operator==(const Key&, const Key&) = default;
    };

    Denoiser denoiser_;
    FirstHits hits_;
    Key key_;
    double pixel_seconds_ = 0.0;
};

}  // namespace pl::ui
