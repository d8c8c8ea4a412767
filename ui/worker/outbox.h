// Results of the render thread for the window: the newest frame, status, runs, messages and answers.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <vector>

#include "core/measure/live_runs.h"
#include "ui/worker/field_history.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

class Outbox {
public:
    explicit Outbox(WorkerStatus status) : status_(std::move(status)) {}

    // By any thread; take_...() returns an answer once.

    std::shared_ptr<const PublishedFrame> latest();
    std::uint64_t frame_count() const { return frame_count_.load(std::memory_order_acquire); }
    WorkerStatus status() const;
    std::shared_ptr<const LiveRunSet> runs() const;
    std::vector<WorkerMessage> take_messages();
    std::optional<PickAnswer> take_pick();
    std::optional<LearnedAnswer> take_learned();
    std::optional<DiagnosticsAnswer> take_diagnostics();
    std::optional<PathsAnswer> take_paths();
    std::optional<GainAnswer> take_gain();
    std::shared_ptr<const FieldHistory> history() const;  ///< never null
    std::exception_ptr failure() const;

    // By the render thread.

    /// Numbers the frame and puts it in the place of the last one.
    void publish(std::shared_ptr<PublishedFrame> frame);
    /// Whether the window has taken the newest frame.
    bool is_frame_taken() const;
    void set_status(const WorkerStatus& status);
    void set_runs(std::shared_ptr<const LiveRunSet> runs);
    void report(WorkerMessage message);
    void answer(PickAnswer answer);
    void answer(LearnedAnswer answer);
    void answer(DiagnosticsAnswer answer);
    void answer(PathsAnswer answer);
    void answer(GainAnswer answer);
    void set_history(std::shared_ptr<const FieldHistory> history);
    /// The error that ended the thread.
    void fail(std::exception_ptr failure);

private:
    mutable std::mutex mutex_;
    WorkerStatus status_;
    std::shared_ptr<const LiveRunSet> runs_;
    std::vector<WorkerMessage> messages_;
    std::optional<PickAnswer> pick_;
    std::optional<LearnedAnswer> learned_;
    std::optional<DiagnosticsAnswer> diagnostics_;
    std::optional<PathsAnswer> paths_;
    std::optional<GainAnswer> gain_;
    std::shared_ptr<const FieldHistory> history_ = std::make_shared<const FieldHistory>();
    std::shared_ptr<const PublishedFrame> frame_;
    bool is_frame_taken_ = true;
    std::atomic<std::uint64_t> frame_count_{0};
    std::exception_ptr failure_;
};

}  // namespace pl::ui
