// Requests and edits queued by the window for the render thread, and the flag that interrupts a pass for them.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

#include "core/session/edits.h"
#include "ui/worker/requests.h"

namespace pl::ui {

// Edits queued for the render thread: of each kind, and of each material and forgotten volume, only the newest is kept.

/// A change to the session, or to the film that is shown.
using WorkerEdit = std::variant<SessionEdit, MethodId, View>;

/// The session edit of this kind, or null.
template <class Edit>
const Edit* find_edit(const WorkerEdit& edit) {
    const auto* change = std::get_if<SessionEdit>(&edit);
    return change != nullptr ? std::get_if<Edit>(change) : nullptr;
}

class EditQueue {
public:
    /// Replaces an edit of the same kind, of materials one of the same material; a scene replaces all edits of materials
    /// before it. The new edit goes to the end, so that a camera that follows a scene is applied after it.
    void push(WorkerEdit edit) {
        std::erase_if(edits_, [&](const WorkerEdit& other) { return replaces(edit, other); });
        edits_.push_back(std::move(edit));
    }

    bool empty() const { return edits_.empty(); }

    /// All edits in order; the queue is empty afterwards.
    std::vector<WorkerEdit> take() { return std::exchange(edits_, {}); }

private:
    static bool replaces(const WorkerEdit& edit, const WorkerEdit& other) {
        if (const auto* old = find_edit<EditMaterial>(other)) {
            const auto* material = find_edit<EditMaterial>(edit);
            return material != nullptr ? material->index == old->index : find_edit<EditScene>(edit) != nullptr;
        }
        if (const auto* old = find_edit<EditForgetVolume>(other)) {
            const auto* forget = find_edit<EditForgetVolume>(edit);
            if (forget != nullptr) return forget->volume == old->volume && forget->method == old->method;
            return find_edit<EditScene>(edit) != nullptr || find_edit<EditForget>(edit) != nullptr;
        }
        if (edit.index() != other.index()) return false;
        const auto* change = std::get_if<SessionEdit>(&edit);
        return change == nullptr || change->index() == std::get<SessionEdit>(other).index();
    }

    std::vector<WorkerEdit> edits_;
};

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
    /// Raised while it has to stop for an edit: frames of the state before are late.
    const StopFlag* edit_flag() const { return &has_edit_; }
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
    StopFlag has_edit_{false};
};

}  // namespace pl::ui
