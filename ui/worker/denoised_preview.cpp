#include "ui/worker/denoised_preview.h"

#include "core/base/parallel.h"
#include "core/base/timer.h"
#include "core/kernel/film/frame_pixel.h"
#include "core/session/session.h"

namespace pl::ui {

bool DenoisedPreview::add_to(PublishedFrame& frame, const Session& session, const StopFlag& stop) {
    const Snapshot& snapshot = frame.snapshot;
    if (snapshot.slot.view != View::Beauty || snapshot.passes >= kEnoughPasses || frame.backend.name != "cpu")
        return true;
    const Stopwatch watch;
    const Key key{session.film_origin(snapshot.slot).generation, frame.scene, snapshot.width, snapshot.height};
    if (!(key == key_)) {
        key_ = {};
        hits_ = find_first_hits(*frame.scene, snapshot.camera, key.width, key.height, &stop);
        if (stop) return false;
        key_ = key;
    }
    const std::span<const Vec3f> smoothed = denoiser_.denoise(snapshot.pixels, hits_, snapshot.passes, &stop);
    if (stop) return false;
    const FrameStyle style = frame_style(snapshot.slot.view, frame.display, frame.range);
    const ToneTable codes(style.curve);
    auto pixels = std::make_shared<std::vector<std::uint32_t>>(smoothed.size());
    for_indices(static_cast<std::uint32_t>(smoothed.size()), usable_threads(),
                [&](std::size_t i) { (*pixels)[i] = frame_pixel(smoothed[i], style, codes.view()); });
    frame.denoised = {.width = key.width, .height = key.height, .pixels = [pixels] { return pixels->data(); }};
    frame.denoise_seconds = watch.seconds();
    pixel_seconds_ = frame.denoise_seconds / static_cast<double>(hits_.count());
    return true;
}

}  // namespace pl::ui
