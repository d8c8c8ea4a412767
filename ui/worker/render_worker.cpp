#include "ui/worker/render_worker.h"

namespace pl::ui {
namespace {

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

void RenderWorker::step() {
    inbox_.request([](Requests& requests) {
        ++requests.once.steps;
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

void RenderWorker::request_pick(Vec2f image_point) {
    inbox_.request([&](Requests& requests) {
        requests.once.pick = image_point;
        return Interrupts::Pass;
    });
}

void RenderWorker::request_volumes(std::vector<SurfacePlace> places) {
    inbox_.request([&](Requests& requests) {
        requests.once.places = std::move(places);
        return Interrupts::Pass;
    });
}

}  // namespace pl::ui
