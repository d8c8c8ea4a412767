// Frames for the window: computed on the device after the queued pass, copied to the host in a second stream while
// the next pass runs.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/session/backend.h"
#include "cuda/kernels/kernels.h"
#include "cuda/runtime/device_array.h"

namespace pl::cuda {

/// Destination of a frame's copy. The destructor waits until the copy has completed.
struct ArrivingFrame {
    PinnedMemory memory;
    Event arrived;

    ~ArrivingFrame();
};

/// Pool of frames for later copies, since pinned memory is slow to allocate. Outlives the back end while the window
/// holds a frame.
class SpareFrames : public std::enable_shared_from_this<SpareFrames> {
public:
    /// A frame of at least `bytes` bytes. Returns to the pool when its last owner releases it.
    std::shared_ptr<ArrivingFrame> take(std::size_t bytes);

private:
    void put_back(std::unique_ptr<ArrivingFrame> frame);

    std::mutex mutex_;
    std::vector<std::unique_ptr<ArrivingFrame>> spare_;
};

class FrameCopies {
public:
    /// Queues the computation of a frame in `stream` and its copy in copies_. Does not block.
    DisplayFrame start(const FilmView& film, const FrameStyle& style, const Stream& stream);

private:
    void upload_codes(ToneCurve curve, const Stream& stream);

    Stream copies_;
    Event made_;
    Event copied_;
    std::optional<ToneCurve> curve_;  ///< of codes_
    DeviceArray<std::uint8_t> codes_;
    DeviceArray<std::uint32_t> pixels_;
    std::shared_ptr<SpareFrames> spare_ = std::make_shared<SpareFrames>();
};

}  // namespace pl::cuda
