#include "cuda/frame_copies.h"

#include "cuda/runtime/launch.h"

namespace pl::cuda {

ArrivingFrame::~ArrivingFrame() {
    try {
        arrived.wait("waiting for a frame");
    } catch (const Error&) {
        // A lost device no longer writes to the memory.
    }
}

std::shared_ptr<ArrivingFrame> SpareFrames::take(std::size_t bytes) {
    std::unique_ptr<ArrivingFrame> frame;
    {
        const std::lock_guard lock(mutex_);
        if (!spare_.empty()) {
            frame = std::move(spare_.back());
            spare_.pop_back();
        }
    }
    if (!frame || frame->memory.bytes() < bytes) {
        frame.reset();
        frame.reset(new ArrivingFrame{PinnedMemory(bytes), Event()});
    }
    const auto give_back = [self = shared_from_this()](ArrivingFrame* shown) {
        self->put_back(std::unique_ptr<ArrivingFrame>(shown));
    };
    return {frame.release(), give_back};
}

void SpareFrames::put_back(std::unique_ptr<ArrivingFrame> frame) {
    constexpr std::size_t kMostSpare = 3;  // one displayed, one passed to the window, one being copied
    const std::lock_guard lock(mutex_);
    if (spare_.size() < kMostSpare) spare_.push_back(std::move(frame));
}

DisplayFrame FrameCopies::start(const FilmView& film, const FrameStyle& style, const Stream& stream) {
    copied_.hold_back(stream);  // the copy of the previous frame may still read pixels_
    if (curve_ != style.curve) upload_codes(style.curve, stream);
    if (pixels_.size() < film.pixels.count) {
        copies_.wait("copying a frame");
        pixels_ = DeviceArray<std::uint32_t>(film.pixels.count);
    }
    const Span<std::uint32_t> pixels{pixels_.data(), film.pixels.count};
    const std::shared_ptr<ArrivingFrame> frame = spare_->take(pixels.count * sizeof(std::uint32_t));
    launch(kShowFilm, one_thread_each(pixels.count), stream, "show_film", film, style,
           ToneCodes{view_of(std::as_const(codes_))}, pixels);
    made_.record(stream);
    made_.hold_back(copies_);
    copy_to_host(frame->memory.data(), pixels.data, pixels.count * sizeof(std::uint32_t), copies_);
    frame->arrived.record(copies_);
    copied_.record(copies_);
    return {static_cast<int>(film.width), static_cast<int>(film.height), [frame] {
                frame->arrived.wait("copying a frame");
                return static_cast<const std::uint32_t*>(frame->memory.data());
            }};
}

/// The codes are in pageable memory, so the runtime has staged them when the call returns.
void FrameCopies::upload_codes(ToneCurve curve, const Stream& stream) {
    const ToneTable table(curve);
    const ToneCodes codes = table.view();
    if (codes_.size() == 0) codes_ = DeviceArray<std::uint8_t>(codes.codes.count);
    curve_.reset();
    copy_to_device(codes_.data(), codes.codes.data, codes.codes.count, stream);
    stream.wait("uploading a tone curve");
    curve_ = curve;
}

}  // namespace pl::cuda
