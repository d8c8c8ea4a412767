// A render worker over fake back ends, for tests.
#pragma once

#include <future>

#include "tests/ui/fake_backend.h"
#include "ui/worker/render_worker.h"

namespace pl::test {
using namespace pl::ui;

inline constexpr int kSize = 64;

struct Bench {
    FakeDevices devices;
    std::shared_ptr<FakeControl> control = devices.cpu;

    WorkerSetup setup(MethodId method = MethodId::Default, SampleLimits limits = {}) {
        RenderSettings settings{.method = method, .next_event = false};
        settings.width = kSize;
        settings.height = kSize;
        settings.camera = small_scene()->camera;
        settings.field.volumes = 16;
        settings.field.bins = 16;
        return {.make_backend = devices.maker(),
                .backends = {{"cpu", "", ""}, {"cuda", "", ""}},
                .first_backend = "cpu",
                .scene = small_scene(),
                .settings = settings,
                .limits = limits,
                .load_seconds = 0.0};
    }
};

inline CameraDescription camera_at(float x) {
    CameraDescription camera = small_scene()->camera;
    camera.eye.x = x;
    return camera;
}

/// The pixel of a frame for a value that is the same in all channels.
inline std::uint32_t gray_pixel(float value, const DisplaySettings& display) {
    return frame_pixel(Vec3f{value}, frame_style(View::Beauty, display, {}), ToneTable(display.curve).view());
}

/// The newest frame that shows this edit, once it is there.
inline std::shared_ptr<const PublishedFrame> frame_of(RenderWorker& worker, std::uint64_t generation) {
    std::shared_ptr<const PublishedFrame> frame;
    const bool found = eventually([&] {
        frame = worker.latest();
        return frame && frame->generation >= generation;
    });
    return found ? frame : nullptr;
}

/// Pauses the worker and waits until it rests.
inline bool rests(RenderWorker& worker) {
    worker.set_paused(true);
    return eventually([&] { return worker.status().state == WorkerState::Paused; });
}

/// Waits for a message that contains the text; all others before it are dropped.
inline bool is_told(RenderWorker& worker, const std::string& text) {
    return eventually([&] {
        for (const WorkerMessage& message : worker.take_messages())
            if (message.text.find(text) != std::string::npos) return true;
        return false;
    });
}

inline bool has_learned(RenderWorker& worker, std::uint64_t passes) {
    return eventually([&] {
        const WorkerStatus status = worker.status();
        return status.field && status.field->passes >= passes;
    });
}

/// A worker with a field learned on CUDA.
inline void learn_on_cuda(RenderWorker& worker) {
    REQUIRE(has_learned(worker, 5));
    REQUIRE(frame_of(worker, worker.switch_backend("cuda")));
    REQUIRE(has_learned(worker, 10));
}

/// Destroys a worker on another thread, so that a test need not wait for its end.
template <class Release>
bool ends_after(std::unique_ptr<RenderWorker> worker, Release&& release) {
    std::future<void> end = std::async(std::launch::async, [&] { worker.reset(); });
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    release();
    return end.wait_for(std::chrono::seconds(10)) == std::future_status::ready;
}

}  // namespace pl::test
