#include "ui/worker/render_worker.h"

namespace pl::ui {
namespace {

using Interrupts = Inbox::Interrupts;

Requests first_requests(const WorkerSetup& setup) {
    return {.display = setup.display, .limits = setup.limits, .backend = setup.first_backend};
}

WorkerStatus first_status(const WorkerSetup& setup) {
    WorkerStatus status;
    status.backend = setup.first_backend;
    status.scene = setup.scene;
    status.backends = std::make_shared<const BackendChoices>(setup.backends);
    return status;
}

}  // namespace

const char* name_of(WorkerState state) {
    switch (state) {
    case WorkerState::Starting: return "starting";
    case WorkerState::Rendering: return "rendering";
    case WorkerState::Precomputing: return "precomputing";
    case WorkerState::Paused: return "paused";
    case WorkerState::Done: return "done";
    case WorkerState::Failed: return "failed";
    }
    return "";
}

RenderWorker::RenderWorker(WorkerSetup setup)
    : setup_(std::move(setup)), inbox_(first_requests(setup_)), outbox_(first_status(setup_)),
      loop_(setup_, inbox_, outbox_), thread_([this] { loop_.run(setup_); }) {}

RenderWorker::~RenderWorker() {
    inbox_.quit();
    thread_.join();
}

std::uint64_t RenderWorker::switch_backend(const std::string& name) {
    return inbox_.request([&](Requests& requests) {
        requests.backend = name;
        ++requests.generation;
        return Interrupts::Pass;
    });
}

void RenderWorker::set_moving(bool moving) {
    inbox_.request([&](Requests& requests) {
        requests.moving = moving;
        return Interrupts::Nothing;
    });
}

void RenderWorker::set_low_resolution_allowed(bool allowed) {
    inbox_.request([&](Requests& requests) {
        requests.low_resolution = allowed;
        return Interrupts::Nothing;
    });
}

void RenderWorker::set_preview_allowed(bool allowed) {
    inbox_.request([&](Requests& requests) {
        requests.preview = allowed;
        return Interrupts::Nothing;
    });
}

void RenderWorker::set_paused(bool paused) {
    inbox_.request([&](Requests& requests) {
        requests.paused = paused;
        return Interrupts::Nothing;
    });
}

void RenderWorker::step() {
    inbox_.request([](Requests& requests) {
        ++requests.once.steps;
        return Interrupts::Nothing;
    });
}

void RenderWorker::set_limits(SampleLimits limits) {
    inbox_.request([&](Requests& requests) {
        requests.limits = limits;
        return Interrupts::Nothing;
    });
}

void RenderWorker::set_display(const DisplaySettings& display) {
    inbox_.request([&](Requests& requests) {
        const bool is_other = display != requests.display;
        requests.display = display;
        return is_other ? Interrupts::ShownPass : Interrupts::Nothing;
    });
}

void RenderWorker::set_values_wanted(bool wanted) {
    inbox_.request([&](Requests& requests) {
        const bool is_new = wanted && !requests.values;
        requests.values = wanted;
        return is_new ? Interrupts::ShownPass : Interrupts::Nothing;
    });
}

void RenderWorker::set_reference(std::shared_ptr<const LiveReference> reference) {
    inbox_.request([&](Requests& requests) {
        requests.reference = std::move(reference);
        return Interrupts::Nothing;
    });
}

void RenderWorker::set_turns(std::optional<TurnMethods> methods) {
    inbox_.request([&](Requests& requests) {
        requests.turns = methods;
        return Interrupts::Pass;
    });
}

void RenderWorker::set_cells_wanted(bool wanted) {
    inbox_.request([&](Requests& requests) {
        requests.cells = wanted;
        return Interrupts::Nothing;
    });
}

void RenderWorker::request_pick(Vec2f image_point) {
    inbox_.request([&](Requests& requests) {
        requests.once.pick = image_point;
        return Interrupts::Pass;
    });
}

void RenderWorker::request_learned() {
    inbox_.request([](Requests& requests) {
        requests.once.learned = true;
        return Interrupts::Nothing;
    });
}

void RenderWorker::request_diagnostics() {
    inbox_.request([](Requests& requests) {
        requests.once.diagnostics = true;
        return Interrupts::Nothing;
    });
}

void RenderWorker::request_paths() {
    inbox_.request([](Requests& requests) {
        requests.once.paths = true;
        return Interrupts::Nothing;
    });
}

void RenderWorker::request_gain() {
    inbox_.request([](Requests& requests) {
        requests.once.gain = true;
        return Interrupts::Nothing;
    });
}

void RenderWorker::set_pins(std::vector<std::int32_t> volumes) {
    inbox_.request([&](Requests& requests) {
        requests.pins = std::move(volumes);
        return Interrupts::Nothing;
    });
}

void RenderWorker::set_history_limit(std::size_t bytes) {
    inbox_.request([&](Requests& requests) {
        requests.history_bytes = bytes;
        return Interrupts::Nothing;
    });
}

void RenderWorker::select_volume(std::int32_t volume) {
    inbox_.request([&](Requests& requests) {
        requests.volume = volume;
        return Interrupts::Nothing;
    });
}

}  // namespace pl::ui
