// Frames for the window: made on the device behind the pass that is queued, copied in a stream of their own while the next
// pass runs.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/session/backend.h"
#include "cuda/kernels/kernels.h"
#include "cuda/runtime/device_array.h"

namespace pl::cuda {

/// Where a frame arrives. Ends only once the device writes there no more.
struct ArrivingFrame {
    PinnedMemory memory;
    Event arrived;

    ~ArrivingFrame();
};

/// Frames that nobody shows any longer, for the next copies: pinned memory is dear to get. Outlives the back end, because
/// the window may keep a frame for longer.
class SpareFrames : public std::enable_shared_from_this<SpareFrames> {
public:
    /// One with room for this many bytes; it comes back by itself when its last owner lets go.
    std::shared_ptr<ArrivingFrame> take(std::size_t bytes);

private:
    void put_back(std::unique_ptr<ArrivingFrame> frame);

    std::mutex mutex_;
    std::vector<std::unique_ptr<ArrivingFrame>> spare_;
};

class FrameCopies {
public:
    /// Queues the making of a frame in `stream` and its copy in another; waits for neither.
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
