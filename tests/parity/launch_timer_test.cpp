// Which work is timed, and by which name; the times themselves are of the stand-in.
#include "tests/parity/launch_timer.h"

#include "cuda/cuda_backend.h"
#include "tests/cuda/shim/control.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::parity;
using namespace pl::test;

TEST_CASE("Launches and copies are timed by their names while a timer exists") {
    shim::reset();
    const SceneDescription scene = shipped_scene("cornell");
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true}, 8, 8);
    Session session(make_cuda_backend(), std::make_shared<const SceneDescription>(scene), settings);
    render_passes(session, 1);
    {
        const LaunchTimer timer;
        const int before = shim::launches();
        render_passes(session, 2);
        (void)session.show_film(slot_of(settings), {}).frame.pixels();
        const auto times = timer.times();
        std::uint64_t launches = 0;
        for (const auto& [kernel, time] : times) {
            INFO(kernel);
            CHECK(time.milliseconds >= 0.0);
            CHECK(time.work != Work::Other);
            CHECK((time.bytes > 0) == (time.work == Work::Copy));
            if (time.work != Work::Copy) launches += time.count;
        }
        CHECK(launches == static_cast<std::uint64_t>(shim::launches() - before));
        CHECK(times.at("run_step build_row").work == Work::Learn);
        CHECK(times.at("add_samples").work == Work::Publish);
        CHECK(times.at("show_film").count == 1);
        CHECK(times.at("copy").count > 0);
    }
    const int objects = shim::live_objects();
    render_passes(session, 1);
    CHECK(shim::live_objects() == objects);  // no events of a timer that is gone
}
