// Every runtime call fails in turn, once or permanently: the error is clear, nothing leaks or hangs, and the session
// continues on the CPU.
#include "core/base/error.h"
#include "cuda/cuda_backend.h"
#include "tests/cuda/shim/control.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"

using namespace pl;
using namespace pl::test;

namespace {

RenderSettings small_settings(const SceneDescription& scene) {
    RenderSettings settings = settings_for(scene, {MethodId::Reinforcement, false}, 9, 7);
    settings.field.volumes = 10;
    settings.field.bins = 16;
    return settings;
}

/// Runs a session with typical edits. Returns the message of the error that ended it; empty if there was none.
std::string use(const SceneDescription& scene, const RenderSettings& settings) {
    try {
        Session session(make_cuda_backend(), std::make_shared<const SceneDescription>(scene), settings);
        render_passes(session, 2);
        const FilmSlot cells{settings.method, View::Voronoi};
        render_passes(session, cells, 1);
        session.snapshot(cells);
        session.show_film(cells, {.curve = ToneCurve::Aces}).frame.pixels();
        const FilmSlot depth{settings.method, View::Depth};
        render_passes(session, depth, 1);
        session.show_film(depth, {}).frame.pixels();
        session.export_field(settings.method);
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Unavailable);
        return error.what();
    }
    return "";
}

constexpr const char* kCalls[] = {
    "cudaMalloc",           "cudaMallocHost",           "cudaMemcpyAsync",     "cudaMemsetAsync",
    "cudaLaunchKernel",     "cudaEventCreateWithFlags", "cudaEventRecord",     "cudaStreamCreateWithFlags",
    "cudaEventElapsedTime", "cudaStreamSynchronize",    "cudaStreamWaitEvent", "cudaEventSynchronize",
};

}  // namespace

TEST_CASE("Whatever call fails, the error says so and nothing leaks") {
    const SceneDescription scene = shipped_scene("furnace");
    const RenderSettings settings = small_settings(scene);
    for (const std::string call : kCalls)
        for (const bool lasting : {false, true}) {
            int failures = 0;
            // Permanent failures fail at the same calls: every third suffices.
            for (int successes = 0; successes < 400; successes += lasting ? 3 : 1) {
                shim::reset();
                shim::fail(call, cudaErrorMemoryAllocation, successes, lasting);
                const std::string error = use(scene, settings);
                shim::reset();
                REQUIRE(shim::live_objects() == 0);
                if (error.empty()) break;  // the call was not reached: each has failed once
                ++failures;
                INFO(call << " number " << successes << ": " << error);
                REQUIRE_THAT(error, contains("CUDA: ") && contains("out of memory") && contains(" failed: "));
            }
            INFO(call);
            CHECK(failures > 0);
            CHECK(failures < 400);
        }
}

TEST_CASE("Without a device the back end says why") {
    shim::reset();
    shim::set_devices(0, cudaErrorInsufficientDriver);
    std::string text;
    try {
        make_cuda_backend();
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Unavailable);
        text = error.what();
    }
    shim::reset();
    CHECK_THAT(text, contains("CUDA: ") && contains("driver"));
}

TEST_CASE("After a fault of a kernel the program has to be restarted, and every retry says so") {
    const SceneDescription scene = shipped_scene("furnace");
    const RenderSettings settings = small_settings(scene);
    for (const cudaError_t fault : {cudaErrorIllegalAddress, cudaErrorLaunchTimeout, cudaErrorLaunchFailure}) {
        shim::reset();
        shim::fail("cudaStreamSynchronize", fault, 5, true);
        CHECK_THAT(use(scene, settings), contains("restart the program to use the GPU again"));
        const std::string again = use(scene, settings);
        CHECK_THAT(again, contains("restart the program") && !contains("no code for the first device"));
    }
    shim::reset();
    shim::fail("cudaMalloc", cudaErrorMemoryAllocation);
    CHECK_THAT(use(scene, settings), !contains("restart"));
    shim::reset();
}

TEST_CASE("The CPU takes over: the field is kept if it can be fetched, else learned anew") {
    const SceneDescription scene = shipped_scene("furnace");
    const RenderSettings settings = small_settings(scene);
    for (const bool lost : {false, true}) {
        shim::reset();
        Session session(make_cuda_backend(), std::make_shared<const SceneDescription>(scene), settings);
        render_passes(session, 2);
        const HostTables before = state_of(session).tables;
        shim::fail("cudaLaunchKernel", cudaErrorLaunchFailure, 0, lost);
        CHECK_THROWS_AS(session.advance(slot_of(session)), Error);

        const std::shared_ptr<RenderBackend> cpu = make_cpu_backend({.threads = 1});
        if (lost) CHECK_THROWS_AS(session.apply(EditBackend{cpu}), Error);
        session.apply(EditBackend{cpu, lost});
        CHECK(session.backend().name == "cpu");
        CHECK(same_bits(state_of(session).tables.visits, before.visits) != lost);
        render_passes(session, 2);
        CHECK(session.passes(slot_of(session)) == 2);
        CHECK(session.field_status(session.settings().method)->passes == (lost ? 2 : 4));
    }
    shim::reset();
    CHECK(shim::live_objects() == 0);
}
