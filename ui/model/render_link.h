// The window's interface to the render thread: its newest frames and status, reasons for it to rest, two runs in
// turns.
#pragma once

#include <bitset>
#include <memory>
#include <optional>
#include <string>

#include "core/session/snapshot.h"
#include "ui/model/jobs.h"
#include "ui/model/messages.h"
#include "ui/viewer.h"
#include "ui/worker/render_worker.h"

namespace pl::ui {

/// Camera paths per second of rendering, over intervals of half a second of the render clock.
class Throughput {
public:
    static constexpr double kIntervalSeconds = 0.5;

    /// A newer snapshot of a film, rendered by this back end. Another film, or one that was cleared, starts over.
    void observe(const Snapshot& snapshot, const std::string& backend);

    /// Million camera paths per second; 0 before the first pass.
    double mpaths_per_second() const { return mpaths_per_second_; }

private:
    double mpaths_per_second_ = 0.0;
    FilmSlot slot_;
    std::string backend_;
    std::uint64_t paths_ = 0;  ///< at the start of the interval
    double seconds_ = 0.0;     ///< on the render clock, at the start of the interval
};

class RenderLink {
public:
    /// Reasons for rendering to rest. Background work would slow down timed passes, so rendering and its clocks rest
    /// during it.
    enum class Hold { User, Reference, Diagnostics, SelfTest };

    explicit RenderLink(WorkerSetup setup) : worker_(std::move(setup)), status_(worker_.status()) {}

    /// Takes the newest frame and status; once per frame of the window. Throws the error that ended the render thread.
    void update();
    void take_frame();

    RenderWorker& worker() { return worker_; }
    const RenderWorker& worker() const { return worker_; }
    /// The newest frame of the run in the window; null before the first.
    const std::shared_ptr<const PublishedFrame>& frame() const { return frame_; }
    /// In turns the newest frame of the second side; may be null.
    const std::shared_ptr<const PublishedFrame>& second_frame() const { return second_frame_; }
    const WorkerStatus& status() const { return status_; }
    const Throughput& throughput() const { return throughput_; }

    /// Rendering rests as long as any reason holds.
    void hold(Hold reason, bool on);
    bool is_held(Hold reason) const { return holds_.test(static_cast<std::size_t>(reason)); }

    /// The two runs that render in turns; empty if none do.
    const std::optional<TurnSides>& turns() const { return turns_; }
    void begin_turns(const TurnSides& sides);
    /// Ends turns and continues with `method`: the last turn may have been the other method's. Nothing without turns.
    void end_turns(MethodId method);

private:
    RenderWorker worker_;
    WorkerStatus status_;
    std::shared_ptr<const PublishedFrame> frame_;
    std::shared_ptr<const PublishedFrame> second_frame_;
    std::shared_ptr<const PublishedFrame> latest_;  ///< the newer one of both
    Throughput throughput_;
    std::optional<TurnSides> turns_;
    std::bitset<5> holds_;
};

// The objects that the parts of the viewer model share: options, messages, file jobs, the render thread.

/// All outlive the parts that are given them.
struct ModelServices {
    const ViewerOptions& options;
    Messages& messages;
    Jobs& jobs;
    RenderLink& link;
};

}  // namespace pl::ui
