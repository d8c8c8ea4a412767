// The window's interface to the render thread: the window sends edits and requests, and takes published frames. Every
// public function may be called from any thread and returns at once.
#pragma once

#include <thread>

#include "ui/worker/render_loop.h"

namespace pl::ui {

class RenderWorker {
public:
    explicit RenderWorker(WorkerSetup setup);
    ~RenderWorker();
    RenderWorker(const RenderWorker&) = delete;
    RenderWorker& operator=(const RenderWorker&) = delete;

    /// Queues an edit and returns its number: frames that show it have at least this generation.
    std::uint64_t submit(WorkerEdit edit) { return inbox_.submit(std::move(edit)); }
    /// The same for edits that no frame may show apart.
    std::uint64_t submit_together(std::vector<WorkerEdit> edits) { return inbox_.submit_together(std::move(edits)); }
    /// Requests another back end; returns a number like submit(). If it cannot be used, a message reports the reason,
    /// and nothing changes.
    std::uint64_t switch_backend(const std::string& name);
    /// The back end requested last, or the one in use if that could not be used.
    std::string wanted_backend() const { return inbox_.wanted_backend(); }
    /// While the camera moves, pictures may be coarse; afterwards they are complete again.
    void set_moving(bool moving) { set(&Requests::moving, moving); }
    void set_low_resolution_allowed(bool allowed) { set(&Requests::low_resolution, allowed); }
    void set_preview_allowed(bool allowed) { set(&Requests::preview, allowed); }
    void set_paused(bool paused) { set(&Requests::paused, paused); }
    /// One more pass while paused.
    void step();
    void set_limits(SampleLimits limits) { set(&Requests::limits, limits); }
    /// Exposure and curve of frames from now on; interrupts a pass at rest, which then resumes.
    void set_display(const DisplaySettings& display);
    /// Whether frames carry the values of the film, which take time to fetch from a device.
    void set_values_wanted(bool wanted) { want(&Requests::values, wanted); }
    /// Whether frames carry a denoised display of the first samples.
    void set_denoised_wanted(bool wanted) { want(&Requests::denoised, wanted); }
    /// The reference for runs of the same picture from now on; null for none.
    void set_reference(std::shared_ptr<const LiveReference> reference) {
        set(&Requests::reference, std::move(reference));
    }
    /// Lets two runs render in turns of equal charged time; empty ends it.
    void set_turns(const std::optional<TurnSides>& sides) { set(&Requests::turns, sides, Interrupts::Pass); }
    /// Whether frames carry the image of the volumes' cells.
    void set_cells_wanted(bool wanted) { set(&Requests::cells, wanted); }
    /// Requests the surface under a point of the image, in [0,1)^2 from the top left.
    void request_pick(Vec2f image_point);
    /// Requests the volumes that serve these places.
    void request_volumes(std::vector<SurfacePlace> places);
    /// Requests the learned field of the method, after the pass under way.
    void request_learned() { ask(&OneShotRequests::learned); }
    /// Requests the input of find_diagnostics(), after the pass under way.
    void request_diagnostics() { ask(&OneShotRequests::diagnostics); }
    /// Requests the input of trace_pixel(), after the pass under way.
    void request_paths() { ask(&OneShotRequests::paths); }
    /// Requests the input of tile_gains(), after the pass under way.
    void request_gain() { ask(&OneShotRequests::gain); }
    /// Further volumes whose inspections frames carry.
    void set_pins(std::vector<std::int32_t> volumes) { set(&Requests::pins, std::move(volumes)); }
    /// Memory for key frames of the field from now on; 0 gives them up.
    void set_history_limit(std::size_t bytes) { set(&Requests::history_bytes, bytes); }
    /// The volume whose inspection frames carry; kNoVolume for none.
    void select_volume(std::int32_t volume) { set(&Requests::volume, volume, Interrupts::ShownPass); }

    std::shared_ptr<const PublishedFrame> latest() { return outbox_.latest(); }
    /// Number of frames published so far.
    std::uint64_t frame_count() const { return outbox_.frame_count(); }
    WorkerStatus status() const { return outbox_.status(); }
    /// Error against time of everything rendered so far; never null.
    std::shared_ptr<const LiveRunSet> runs() const { return outbox_.runs(); }
    std::vector<WorkerMessage> take_messages() { return outbox_.take_messages(); }
    /// The newest answer of its kind, once.
    template <class Kind>
    std::optional<Kind> take() {
        return outbox_.take<Kind>();
    }
    /// Key frames of the field; never null.
    std::shared_ptr<const FieldHistory> history() const { return outbox_.history(); }
    /// The error that ended the thread, or null. Only a session that cannot be made ends it.
    std::exception_ptr failure() const { return outbox_.failure(); }

private:
    using Interrupts = Inbox::Interrupts;

    template <class Value>
    void set(Value Requests::*request, Value value, Interrupts interrupts = Interrupts::Nothing) {
        inbox_.request([&](Requests& requests) {
            requests.*request = std::move(value);
            return interrupts;
        });
    }
    /// A frame that has what is newly wanted is made at once.
    void want(bool Requests::*part, bool wanted) {
        inbox_.request([&](Requests& requests) {
            const bool is_new = wanted && !(requests.*part);
            requests.*part = wanted;
            return is_new ? Interrupts::ShownPass : Interrupts::Nothing;
        });
    }
    void ask(bool OneShotRequests::*question) {
        inbox_.request([&](Requests& requests) {
            requests.once.*question = true;
            return Interrupts::Nothing;
        });
    }

    WorkerSetup setup_;
    Inbox inbox_;
    Outbox outbox_;
    RenderLoop loop_;     ///< only the render thread touches it
    std::thread thread_;  ///< last: starts after all other members are made
};

}  // namespace pl::ui
