// The whole CUDA back end, run on the host: films, tables and counters have the bits of the CPU back
// end, since both run the same steps with the same random numbers. Rounding may differ on a device: see tests/parity.
#include "cuda/cuda_backend.h"

#include <algorithm>

#include "core/kernel/base/rng.h"
#include "core/measure/run_recorder.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "core/session/exact_backend.h"
#include "tests/cuda/cuda_session.h"
#include "tests/cuda/shim/control.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/image_scenes.h"
#include "tests/support/scenes/instanced_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"
#include "tests/support/session/variants.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Calls `call` with the number of each launch, until it is called with an empty function.
void on_launch(const std::function<void(int)>& call) {
    shim::observe({}, call ? shim::Observer([call](const void* kernel, std::size_t, shim::Queue*) {
                      if (kernel != nullptr) call(shim::launches());
                  })
                           : shim::Observer());
}

/// Renders `passes` passes, as many at once as the back end takes. The stop flag is set at every `interval`th launch, if it is
/// not 0.
State render_at_once(Session session, std::uint32_t passes, int interval = 0) {
    StopFlag stop = false;
    on_launch([&](int launch) { stop = interval > 0 && launch % interval == 0; });
    const FilmSlot slot = slot_of(session);
    while (session.passes(slot) < passes) {
        session.advance(slot, &stop, passes - session.passes(slot));
        stop = false;
    }
    on_launch({});
    return state_of(session);
}

std::vector<std::uint32_t> pixels_of(const DisplayFrame& frame) {
    const std::uint32_t* pixels = frame.pixels();
    return {pixels, pixels + frame.width * frame.height};
}

State render(Session session, std::uint32_t passes = 3) {
    render_passes(session, passes);
    return state_of(session);
}

}  // namespace

TEST_CASE("Every method gives the bits of the CPU back end") {
    for (const SceneDescription& scene : {shipped_scene("cornell"), shipped_scene("door"), shipped_scene("furnace"),
                                          every_effect(), room_of_instances(materials_of_meshes())}) {
        for (const Estimator estimator : kEstimators) {
            INFO(scene.name << ", " << estimator);
            const RenderSettings settings = small_settings(scene, estimator);
            const State expected = render(make_session(scene, settings));
            for (const int threads : {1, 3}) {
                shim::reset();
                shim::set_threads(threads);
                const State got = render(make_cuda_session(scene, settings));
                CHECK(same_film(got, expected));
                CHECK(same_events(got.snapshot.counters, expected.snapshot.counters));
                CHECK(same_bits(got.tables, expected.tables));
            }
        }
    }
    CHECK(shim::live_objects() == 0);
}

TEST_CASE("Every target, rate and rule of roulette gives the bits of the CPU back end") {
    shim::reset();
    const SceneDescription scene = shipped_scene("door");
    for (const Variant& variant : kVariants) {
        INFO(variant.name);
        const RenderSettings settings =
            variant.of(small_settings(scene, {MethodId::Reinforcement, variant.next_event}));
        if (!has_tables(settings.field.representation)) {
            CHECK_THAT(error_message(ErrorKind::Unavailable, [&] { render(make_cuda_session(scene, settings)); }),
                       contains("CUDA back end: expected a field of tables, got ") && contains("take --backend cpu"));
            continue;
        }
        CHECK(same_state(render(make_cuda_session(scene, settings)), render(make_session(scene, settings))));
    }
}

TEST_CASE("A film that guiding is given up in has the bits of the CPU back end, launches of any size") {
    constexpr std::uint32_t kPasses = 20;
    const SceneDescription scene = shipped_scene("door");
    for (const MethodId method : {MethodId::Precomputed, MethodId::Reinforcement}) {
        INFO(info_of(method).name);
        const RenderSettings settings = settings_without_gain(scene, method);
        Session expected = make_session(scene, settings);
        render_passes(expected, kPasses);
        REQUIRE(expected.guiding_status(slot_of(expected))->unguided_passes > 0);
        for (const int threads : {1, 3}) {
            shim::reset();
            shim::set_threads(threads);
            Session got = make_cuda_session(scene, settings);
            render_passes(got, kPasses);
            CHECK(same_state(state_of(got), state_of(expected)));
            CHECK(got.guiding_status(slot_of(got))->variance_ratio ==
                  expected.guiding_status(slot_of(expected))->variance_ratio);
        }
    }
}

TEST_CASE("A warm-up and the film after it have the bits of the CPU back end") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true}, 256, 256);
    settings.guiding = GuidingRule::Paying;
    Session expected = make_session(scene, settings);
    render_passes(expected, 4);
    shim::reset();
    shim::set_threads(3);
    Session got = make_cuda_session(scene, settings);
    render_passes(got, 4);
    CHECK(same_state(state_of(got), state_of(expected)));
    CHECK(got.guiding_status(slot_of(got))->variance_ratio ==
          expected.guiding_status(slot_of(expected))->variance_ratio);
}

TEST_CASE("Every view gives the bits of the CPU back end") {
    shim::reset();
    for (const SceneDescription& scene :
         {shipped_scene("cornell"), every_effect(), room_of_instances(materials_of_meshes())})
        for (const ViewInfo& view : all_views())
            for (const MethodInfo& method : all_methods()) {
                INFO(view.name << ", " << method.name);
                RenderSettings settings = small_settings(scene, {method.id, false});
                settings.view = view.id;
                const State expected = render(make_session(scene, settings));
                const State got = render(make_cuda_session(scene, settings));
                CHECK(same_film(got, expected));
                CHECK(same_events(got.snapshot.counters, expected.snapshot.counters));
            }
}

TEST_CASE("Invalid samples are counted at the pixels of the CPU back end") {
    shim::reset();
    BoxLook look;
    look.albedo.fill(glm::vec3{0.9f});
    look.emission[kFloor] = look.emission[kWallX1] = glm::vec3{2.5e38f};  // their sum overflows to infinity
    SceneDescription scene = box_scene(look);
    scene.camera.fov_deg = 90.0f;
    RenderSettings settings = small_settings(scene, {MethodId::Default, false});
    Session cpu = make_session(scene, settings);
    Session cuda = make_cuda_session(scene, settings);
    render_passes(cpu, 3);
    render_passes(cuda, 3);
    const FilmSlot slot{MethodId::Default, View::Beauty};
    const std::vector<std::uint32_t> counts = cuda.backend_access().invalid_samples(slot);
    CHECK(counts == cpu.backend_access().invalid_samples(slot));
    CHECK(std::count(counts.begin(), counts.end(), 0u) > 100);
    CHECK(std::count(counts.begin(), counts.end(), 1u) > 10);
}

TEST_CASE("Frames of every view have the bits of the CPU back end") {
    shim::reset();
    const SceneDescription scene = shipped_scene("door");
    for (const ViewInfo& view : all_views()) {
        RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
        settings.view = view.id;
        Session cpu = make_session(scene, settings);
        Session cuda = make_cuda_session(scene, settings);
        render_passes(cpu, 2);
        render_passes(cuda, 2);
        for (const ToneCurve curve : {ToneCurve::Clamp, ToneCurve::Reinhard, ToneCurve::Aces})
            for (const float ev : {-2.0f, 0.0f, 1.5f}) {
                INFO(view.name << ", curve " << static_cast<int>(curve) << ", exposure " << ev);
                const ShownFilm expected = cpu.show_film(slot_of(settings), {.exposure_ev = ev, .curve = curve});
                const ShownFilm got = cuda.show_film(slot_of(settings), {.exposure_ev = ev, .curve = curve});
                CHECK(got.range.high == expected.range.high);
                CHECK(pixels_of(got.frame) == pixels_of(expected.frame));
                CHECK(pixels_of(got.frame) == pixels_of(got.frame));  // repeated reads are allowed
            }
    }
}

TEST_CASE("A frame is that of its moment, however long it is on its way, and outlives its back end") {
    shim::reset();
    const SceneDescription scene = shipped_scene("cornell");
    const RenderSettings settings = small_settings(scene, {MethodId::Default, false});
    std::vector<DisplayFrame> frames;
    std::vector<std::vector<std::uint32_t>> expected;
    {
        Session cpu = make_session(scene, settings);
        Session cuda = make_cuda_session(scene, settings);
        for (int i = 0; i < 5; ++i) {
            render_passes(cpu, 1);
            render_passes(cuda, 1);
            expected.push_back(pixels_of(cpu.show_film(slot_of(settings), {}).frame));
            frames.push_back(cuda.show_film(slot_of(settings), {}).frame);
            if (i == 2) frames[0] = {};  // its memory is reused by a later frame
        }
        render_passes(cuda, 1);
    }
    for (std::size_t i = 1; i < frames.size(); ++i) CHECK(pixels_of(frames[i]) == expected[i]);
    CHECK(expected[1] != expected[4]);
    frames.clear();
    CHECK(shim::live_objects() == 0);
}

TEST_CASE("Launches of any size, stopped and resumed, give the same bits") {
    shim::reset();
    const SceneDescription scene = shipped_scene("cornell");
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true});
    const State expected = render(make_session(scene, settings), 2);

    Session session = make_cuda_session(scene, settings);
    StopFlag stop = true;
    CHECK(session.advance(slot_of(session), &stop) == Progress::Stopped);
    CHECK(session.passes(slot_of(session)) == 0);
    render_passes(session, 2);
    CHECK(same_state(state_of(session), expected));
}

TEST_CASE("Paths that wait for the next launch have the bits of the CPU back end, also when they are stopped there") {
    for (const SceneDescription& scene : {shipped_scene("door"), every_effect()})
        for (const Estimator estimator : kEstimators) {
            INFO(scene.name << ", " << estimator);
            const RenderSettings settings = small_settings(scene, estimator, 31, 23);
            const State expected = render(make_session(scene, settings), 6);
            for (const int interval : {0, 3, 1}) {
                shim::reset();
                CHECK(same_state(render_at_once(make_cuda_session(scene, settings, kShortLaunches), 6, interval),
                                 expected));
            }
            const int many = shim::launches();
            shim::reset();
            render_at_once(make_cuda_session(scene, settings), 6);
            CHECK(many > shim::launches());
        }
    CHECK(shim::live_objects() == 0);
}

TEST_CASE(
    "A session that is taken out where its passes are stopped goes on elsewhere with the bits of the CPU back end") {
    const SceneDescription scene = shipped_scene("cornell");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const RenderSettings settings = small_settings(scene, estimator, 31, 23);
        const State expected = render(make_session(scene, settings), 5);
        shim::reset();
        StopFlag stop = false;
        on_launch([&](int launch) { stop = launch % 3 == 0; });
        Session session = make_cuda_session(scene, settings, kShortLaunches);
        while (session.passes(slot_of(session)) < 5) {
            exact(session.backend_access()).settle_when_stopped();
            session.advance(slot_of(session), &stop);
            stop = false;
            SessionState state = session.save_state();
            session = make_cuda_session(scene, settings, kShortLaunches);
            session.restore_state(std::move(state));
        }
        on_launch({});
        CHECK(same_state(state_of(session), expected));
    }
}

TEST_CASE("Pixels and pending sums move to the host and back without changing a bit") {
    shim::reset();
    const SceneDescription scene = shipped_scene("cornell");
    const RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true});
    Session session = make_cuda_session(scene, settings);
    render_passes(session, 17);  // the last pass has left training samples
    const State before = state_of(session);
    ExactBackend& backend = exact(session.backend_access());
    std::vector<FilmPixel> pixels(100);
    backend.read_pixels(slot_of(session), 33, pixels);
    backend.write_pixels(slot_of(session), 33, pixels);
    std::uint64_t samples = 0;
    backend.change_pending(MethodId::Reinforcement, [&](PendingSums sums) {
        std::visit(
            [&](auto values) {
                samples +=
                    static_cast<std::uint64_t>(std::ranges::count_if(values, [](auto value) { return value != 0; }));
            },
            sums);
    });
    CHECK(samples > 0);
    CHECK(same_state(state_of(session), before));
}

TEST_CASE("Paths that wait are traced anew where another film came between, and pictures keep their bits") {
    shim::reset();
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings = small_settings(scene, {MethodId::Default, true}, 31, 23);
    const State expected = render(make_session(scene, settings), 2);
    Session session = make_cuda_session(scene, settings, kShortLaunches);
    StopFlag stop = false;
    on_launch([&](int) { stop = true; });
    CHECK(session.advance(slot_of(session), &stop) == Progress::Stopped);
    on_launch({});
    render_passes(session, {MethodId::Default, View::Normal}, 1);
    render_passes(session, 2);
    CHECK(same_state(state_of(session), expected));
}

TEST_CASE("Paths that wait do not go on in a pass by another stream of random numbers") {
    shim::reset();
    constexpr int kWidth = 31, kHeight = 23;
    const SceneDescription scene = shipped_scene("door");
    const auto packed = std::make_shared<const HostScene>(pack_scene(scene));
    const FilmSlot slot{MethodId::Default, View::Beauty};
    const PassRequest picture{.slot = slot,
                              .features = needed_effects(*packed),
                              .path = {},
                              .camera = make_camera(scene.camera, kWidth, kHeight)};
    StopFlag stop = false;
    PassRequest other = picture;
    other.path.stream = pl::Stream::Inspection;
    other.stop = &stop;
    const std::unique_ptr<RenderBackend> cpu = make_cpu_backend({.threads = 1});
    const std::unique_ptr<RenderBackend> cuda = make_cuda_backend(kShortLaunches);
    for (RenderBackend* backend : {cpu.get(), cuda.get()}) {
        backend->upload_scene(packed);
        backend->reset_film(slot, kWidth, kHeight);
    }
    on_launch([&](int) { stop = true; });
    CHECK(cuda->run_pass(other).paths == 0);
    on_launch({});
    CHECK(same_events(cuda->run_pass(picture), cpu->run_pass(picture)));
    CHECK(same_bits(cuda->read_film(slot).mean, cpu->read_film(slot).mean));
}

TEST_CASE("A measured run renders several passes in a launch, and measures the points of single ones") {
    constexpr std::uint32_t kPasses = 24;
    const SceneDescription scene = shipped_scene("cornell");
    const RenderSettings settings = small_settings(scene, {MethodId::Default, false}, 31, 23);
    const std::vector<Vec3f> black(31 * 23, Vec3f{0.0f});
    const RunLimits limits{.spp = kPasses, .measure_share = 1.0e9};
    const auto measure = [&](Session session) {
        return record_run(session, slot_of(session), limits, {black, black})->points;
    };
    const std::vector<RunPoint> expected = measure(make_session(scene, settings));
    shim::reset();
    const std::vector<RunPoint> got = measure(make_cuda_session(scene, settings));
    const int at_once = shim::launches();
    REQUIRE(got.size() == expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
        CHECK(got[i].spp == expected[i].spp);
        CHECK(got[i].metrics.rmse == expected[i].metrics.rmse);
        CHECK(got[i].noise == expected[i].noise);
        CHECK(same_events(got[i].counters, expected[i].counters));
    }
    shim::reset();
    render(make_cuda_session(scene, settings), kPasses);
    CHECK(at_once < shim::launches());
}

TEST_CASE("Several passes at once have the bits of single ones, in fewer launches") {
    constexpr std::uint32_t kPasses = 40;  // learners update less often than every pass after the first sixteen
    const SceneDescription scene = shipped_scene("cornell");
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        RenderSettings settings = small_settings(scene, estimator, 31, 23);
        const State expected = render(make_session(scene, settings), kPasses);
        for (const int interval : {0, 7}) {
            shim::reset();
            CHECK(same_state(render_at_once(make_cuda_session(scene, settings), kPasses, interval), expected));
        }
        shim::reset();
        render_at_once(make_cuda_session(scene, settings), kPasses);
        const int at_once = shim::launches();
        shim::reset();
        render(make_cuda_session(scene, settings), kPasses);
        CHECK(at_once < shim::launches());
    }
}

TEST_CASE("A field moves to the device and back in mid-learning without changing a bit") {
    shim::reset();
    const SceneDescription scene = shipped_scene("door");
    for (const auto& [method, representation] : {std::pair{MethodId::Precomputed, Representation::Table},
                                                 {MethodId::Reinforcement, Representation::Table},
                                                 {MethodId::Reinforcement, Representation::Neural}}) {
        RenderSettings settings = small_settings(scene, {method, false});
        settings.field.representation = representation;
        Session session = make_session(scene, settings);
        Session expected = make_session(scene, settings);
        const std::shared_ptr<RenderBackend> cpu = make_cpu_backend({.threads = 2});
        const std::shared_ptr<RenderBackend> other_cpu = make_cpu_backend({.threads = 1});
        const std::shared_ptr<RenderBackend> cuda = make_cuda_backend();
        session.advance(slot_of(session));
        expected.advance(slot_of(expected));
        session.apply(EditBackend{cuda});
        expected.apply(EditBackend{other_cpu});
        CHECK(same_state(state_of(session), state_of(expected)));
        render_passes(session, 2);
        render_passes(expected, 2);
        CHECK(same_state(state_of(session), state_of(expected)));
        session.apply(EditBackend{cpu});
        expected.apply(EditBackend{cpu});
        CHECK(session.backend().name == "cpu");
        CHECK(same_state(state_of(session), state_of(expected)));
    }
}

TEST_CASE("Invalid samples are counted and shown on the device too") {
    shim::reset();
    SceneDescription scene = shipped_scene("furnace");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    RenderSettings settings = small_settings(scene, {MethodId::Default, false});
    for (MaterialDescription& material : scene.materials) material.emission = Vec3f{nan};
    const State expected = render(make_session(scene, settings), 1);
    const State got = render(make_cuda_session(scene, settings), 1);
    CHECK(got.snapshot.counters.invalid_samples == expected.snapshot.counters.invalid_samples);
    CHECK(got.snapshot.counters.invalid_samples > 0);
    CHECK(got.snapshot.pixels[0].x != got.snapshot.pixels[0].x);
}
