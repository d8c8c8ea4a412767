// Results of the render thread for the window: the newest frame, status, runs, messages and answers.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "core/measure/live_runs.h"
#include "ui/worker/field_history.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

class Outbox {
public:
    explicit Outbox(WorkerStatus status) : status_(std::move(status)) {}

    // By any thread.

    std::shared_ptr<const PublishedFrame> latest();
    std::uint64_t frame_count() const { return frame_count_.load(std::memory_order_acquire); }
    WorkerStatus status() const;
    std::shared_ptr<const LiveRunSet> runs() const;
    std::vector<WorkerMessage> take_messages();
    /// The newest answer of its kind, once.
    template <class Kind>
    std::optional<Kind> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(std::get<std::optional<Kind>>(answers_), std::nullopt);
    }
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
    template <class Kind>
    void answer(Kind answer) {
        const std::lock_guard lock(mutex_);
        std::get<std::optional<Kind>>(answers_) = std::move(answer);
    }
    void set_history(std::shared_ptr<const FieldHistory> history);
    /// The error that ended the thread.
    void fail(std::exception_ptr failure);

private:
    mutable std::mutex mutex_;
    WorkerStatus status_;
    std::shared_ptr<const LiveRunSet> runs_;
    std::vector<WorkerMessage> messages_;
    std::tuple<std::optional<PickAnswer>, std::optional<VolumesAnswer>, std::optional<LearnedAnswer>,
               std::optional<DiagnosticsAnswer>, std::optional<PathsAnswer>, std::optional<GainAnswer>>
        answers_;
    std::shared_ptr<const FieldHistory> history_ = std::make_shared<const FieldHistory>();
    std::shared_ptr<const PublishedFrame> frame_;
    bool is_frame_taken_ = true;
    std::atomic<std::uint64_t> frame_count_{0};
    std::exception_ptr failure_;
};

}  // namespace pl::ui
