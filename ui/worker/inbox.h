// Requests and edits on their way from the window to the render thread, and the flag that interrupts a pass for them.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "ui/worker/edit_queue.h"
#include "ui/worker/requests.h"

namespace pl {

class Inbox {
public:
    /// Which passes a request stops. Passes of a moving camera are always finished: else a hand that never rests would
    /// never see a picture.
    enum class Interrupts {
        Nothing,
        Pass,       ///< a pass at rest
        ShownPass,  ///< a pass at rest of a film that has a pass already: another frame of it is wanted
    };

    explicit Inbox(Requests first) : requests_(std::move(first)) {}

    // By any thread.

    /// Queues an edit and returns its number.
    std::uint64_t submit(WorkerEdit edit);
    /// Changes the requests; returns their generation.
    std::uint64_t request(const std::function<Interrupts(Requests&)>& change);
    /// The render thread has to end.
    void quit();
    std::string wanted_backend() const;

    // By the render thread.

    /// Waits until there are edits or `has_work` of the newest requests, which are copied to `now`. False if the thread has to
    /// end. `has_work` is called with the mutex held.
    bool take(Requests& now, std::vector<WorkerEdit>& edits, const std::function<bool()>& has_work);
    /// Before a pass: may it be interrupted? If so, requests that arrived since they were taken stop it at once. `backend` is
    /// the one in use.
    void begin_pass(bool may_be_interrupted, const Requests& now, const std::string& backend);
    /// Set while a pass has to stop.
    const StopFlag* stop_flag() const { return &stop_; }
    /// Does the film under way have a complete pass?
    void note_film(bool has_pass) { film_has_pass_.store(has_pass, std::memory_order_relaxed); }
    /// The request for this back end is settled, by whichever is in use now; a newer request stands.
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

}  // namespace pl
