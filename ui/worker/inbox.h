// Requests and edits queued by the window for the render thread, and the flag that interrupts a pass for them.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "ui/worker/edit_queue.h"
#include "ui/worker/requests.h"

namespace pl::ui {

class Inbox {
public:
    /// The passes that a request stops. Passes of a moving camera are always finished: otherwise continuous motion
    /// would show no picture.
    enum class Interrupts {
        Nothing,
        Pass,       ///< a pass at rest
        ShownPass,  ///< a pass at rest of a film that already has one: another frame of it is requested
    };

    explicit Inbox(Requests first) : requests_(std::move(first)) {}

    // By any thread.

    /// Queues an edit and returns its number.
    std::uint64_t submit(WorkerEdit edit);
    /// Queues edits of which the render thread takes all or none; returns the number of them all.
    std::uint64_t submit_together(std::vector<WorkerEdit> edits);
    /// Changes the requests; returns their generation.
    std::uint64_t request(const std::function<Interrupts(Requests&)>& change);
    /// Requests the end of the render thread.
    void quit();
    std::string wanted_backend() const;

    // By the render thread.

    /// Waits until there are edits or `has_work` of the newest requests, which are copied to `now`. False if the thread has to
    /// end. `has_work` is called with the mutex held.
    bool take(Requests& now, std::vector<WorkerEdit>& edits, const std::function<bool()>& has_work);
    /// Before a pass: whether it may be interrupted. If so, requests newer than those taken stop it at once.
    /// `backend` is the one in use.
    void begin_pass(bool may_be_interrupted, const Requests& now, const std::string& backend);
    /// Raised while a pass has to stop.
    const StopFlag* stop_flag() const { return &stop_; }
    /// Whether the film under way has a complete pass.
    void note_film(bool has_pass) { film_has_pass_.store(has_pass, std::memory_order_relaxed); }
    /// The request for this back end is settled with the one in use now; a newer request remains.
    void settle_backend(const std::string& asked, const std::string& in_use);

private:
    void interrupt(Interrupts interrupts);

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    bool quit_ = false;
    Requests requests_;
    EditQueue edits_;
    bool may_be_interrupted_ = false;
    std::atomic<bool> film_has_pass_{false};
    StopFlag stop_{false};
};

}  // namespace pl::ui
