// Previews in motion: which one, what they leave of fields and pictures, and how long they stay.
#include "ui/worker/picture_size.h"

#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Motion resolution: takes the finest size that keeps the rate, and does not flicker") {
    constexpr double kTarget = MotionResolution::kTargetSeconds;
    MotionResolution motion;
    motion.observe(1,
                   8.0 * kTarget);  // a quarter of the width costs half the target, half the width twice of it
    CHECK(motion.divider() == 4);
    motion.observe(4, 0.5 * kTarget);
    CHECK(motion.divider() == 4);
    motion.observe(4, 1.1 * kTarget);  // within the dead band
    CHECK(motion.divider() == 4);
    motion.observe(4, 1.3 * kTarget);
    CHECK(motion.divider() == 8);
    motion.observe(8, 0.325 * kTarget);  // the finer size would miss the target again: stay
    CHECK(motion.divider() == 8);
    motion.observe(8, 0.19 * kTarget);
    CHECK(motion.divider() == 4);
    motion.observe(4, 0.01 * kTarget);
    CHECK(motion.divider() == 1);
    motion.observe(1, 1.0e9);
    CHECK(motion.divider() == MotionResolution::kMaxDivider);
    motion.observe(8, -1.0);
    CHECK(motion.divider() == MotionResolution::kMaxDivider);
}

TEST_CASE("Motion resolution: small pictures are not divided beyond recognition") {
    MotionResolution motion;
    motion.observe(1, 100.0);
    CHECK(motion.divider() == 8);
    CHECK(motion.divider_for(1280, 720) == 8);
    CHECK(motion.divider_for(512, 512) == 4);
    CHECK(motion.divider_for(200, 300) == 2);
    CHECK(motion.divider_for(64, 64) == 1);
    CHECK(divided(721, 4) == 180);
    CHECK(divided(3, 8) == 1);
}

TEST_CASE("Picture size: coarse in motion, whole at rest, and only a change empties films") {
    SessionBench bench(512);
    PictureSize size(512, 512);
    CHECK_FALSE(size.apply(bench.session, false));
    CHECK(size.is_whole());
    size.observe(1.0);  // far above the time of a frame
    CHECK(size.apply(bench.session, true));
    CHECK(size.divider() == 4);  // no side below MotionResolution::kMinLongSide
    CHECK(bench.session.settings().width == 128);
    CHECK_FALSE(size.apply(bench.session, true));
    CHECK(size.apply(bench.session, false));
    CHECK(bench.session.settings().height == 512);
    size.resize(300, 200);
    CHECK_FALSE(size.is_whole());
    CHECK(size.apply(bench.session, false));
    CHECK(size.is_whole());
    CHECK(bench.session.settings().width == 300);
    size.resize(300, 200);
    CHECK_FALSE(size.apply(bench.session, false));
}

TEST_CASE("Picture size: stays coarse until a frame has shown the last place of the camera") {
    PictureSize size(64, 64);
    Requests now;
    CHECK_FALSE(size.is_coarse(now));
    now.moving = true;
    CHECK(size.is_coarse(now));
    size.move_camera();
    now.moving = false;
    CHECK(size.is_coarse(now));
    now.low_resolution = false;
    CHECK_FALSE(size.is_coarse(now));
    now.low_resolution = true;
    size.note_frame();
    CHECK_FALSE(size.is_coarse(now));
}

TEST_CASE("Motion preview: light samples without a learned field, else its map, and none for other pictures") {
    SessionBench bench;
    Session& session = bench.session;
    CHECK(MotionPreview::choose(session, kDefault, Preview::None) == Preview::LightSamples);
    CHECK(MotionPreview::choose(session, kLearning, Preview::None) == Preview::None);
    CHECK(MotionPreview::choose(session, {MethodId::Default, View::Normal}, Preview::None) == Preview::None);
    bench.render(kLearning, 2);
    CHECK(MotionPreview::choose(session, kDefault, Preview::None) == Preview::RadianceMap);
    CHECK(MotionPreview::choose(session, kLearning, Preview::None) == Preview::None);
    session.apply(EditEstimator{64, true});
    CHECK(MotionPreview::choose(session, kDefault, Preview::None) == Preview::None);
    CHECK(MotionPreview::choose(session, kDefault, Preview::LightSamples) == Preview::LightSamples);
}

TEST_CASE("Motion preview: a map that is being precomputed is neither shown nor lost") {
    SessionBench bench(16, 4);
    bench.session.advance({MethodId::Precomputed, View::Beauty});
    REQUIRE(bench.session.field_status(MethodId::Precomputed)->records > 0);
    CHECK(MotionPreview::choose(bench.session, kDefault, Preview::None) == Preview::None);
}

TEST_CASE("Motion preview: light samples end with the estimator as it was, and no sample stays") {
    SessionBench bench;
    Session& session = bench.session;
    session.apply(EditEstimator{7, false, RouletteRule::Albedo, GuidingRule::Always});
    MotionPreview preview;
    CHECK(preview.apply(session, Preview::LightSamples));
    CHECK_FALSE(preview.apply(session, Preview::LightSamples));
    CHECK(session.settings().next_event);
    CHECK(session.settings().max_depth == 7);
    bench.render(kDefault, 3);
    CHECK(preview.apply(session, Preview::None));
    CHECK_FALSE(session.settings().next_event);
    CHECK(session.settings().max_depth == 7);
    CHECK(session.settings().roulette == RouletteRule::Albedo);
    CHECK(session.settings().guiding == GuidingRule::Always);
    CHECK(session.passes(kDefault) == 0);
}

TEST_CASE("Motion preview: the map is a film of its own, and does not train the field") {
    SessionBench bench;
    Session& session = bench.session;
    bench.render(kLearning, 2);
    bench.render(kDefault, 1);
    MotionPreview preview;
    CHECK_FALSE(preview.apply(session, Preview::RadianceMap));
    const FilmSlot map = preview.slot(session, kDefault);
    CHECK(map == FilmSlot{MethodId::Default, View::RadianceMap});
    const auto before = session.field_status(MethodId::Reinforcement)->passes;
    bench.render(map, 3);
    CHECK(session.field_status(MethodId::Reinforcement)->passes == before);
    CHECK(session.passes(kDefault) == 1);
    preview.apply(session, Preview::None);
    CHECK(preview.slot(session, kDefault) == kDefault);
}

TEST_CASE("Motion preview: stays on screen until the picture has passes or time enough") {
    SessionBench bench;
    MotionPreview preview;
    preview.apply(bench.session, Preview::LightSamples);
    CHECK_FALSE(preview.holds_back(1, 0.0));
    preview.note_frame();
    CHECK_FALSE(preview.holds_back(1, 0.0));  // frames of the preview itself
    preview.apply(bench.session, Preview::None);
    CHECK(preview.holds_back(1, 0.0));
    CHECK_FALSE(preview.holds_back(MotionPreview::kEnoughPasses, 0.0));
    CHECK_FALSE(preview.holds_back(1, MotionPreview::kEnoughSeconds));
    preview.release();
    CHECK_FALSE(preview.holds_back(1, 0.0));
}

TEST_CASE("Motion preview on the render thread: named in its frames and gone at rest, with the settings of then") {
    Bench bench;
    bench.control->pass_microseconds = 200;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    worker.set_moving(true);
    auto frame = frame_of(worker, worker.submit(EditCamera{camera_at(1.0f)}));
    REQUIRE(frame);
    CHECK(frame->preview == Preview::LightSamples);
    CHECK(frame->settings.next_event);
    CHECK(worker.status().picture == 0);
    worker.submit(EditEstimator{5, false});
    frame = frame_of(worker, worker.submit(EditCamera{camera_at(2.0f)}));
    REQUIRE(frame);
    CHECK(frame->preview == Preview::LightSamples);
    worker.set_moving(false);
    REQUIRE(eventually([&] {
        frame = worker.latest();
        return frame->preview == Preview::None;
    }));
    CHECK_FALSE(frame->settings.next_event);
    CHECK(frame->settings.max_depth == 5);
    CHECK(frame->snapshot.counters.paths == std::uint64_t{frame->snapshot.passes} * kSize * kSize);
    const bool has_enough = frame->snapshot.passes >= MotionPreview::kEnoughPasses ||
                            work_seconds(frame->snapshot.clocks) >= MotionPreview::kEnoughSeconds;
    CHECK(has_enough);
}

TEST_CASE("Motion preview on the render thread: it keeps what was learned, and can be switched off") {
    Bench bench;
    RenderWorker worker(bench.setup(MethodId::Reinforcement));
    REQUIRE(has_learned(worker, 5));
    worker.submit(MethodId::Default);
    worker.set_moving(true);
    auto frame = frame_of(worker, worker.submit(EditCamera{camera_at(1.0f)}));
    REQUIRE(frame);
    CHECK(frame->preview == Preview::RadianceMap);
    CHECK(frame->snapshot.slot.view == View::RadianceMap);
    worker.set_preview_allowed(false);
    frame = frame_of(worker, worker.submit(EditCamera{camera_at(2.0f)}));
    REQUIRE(frame);
    CHECK(frame->preview == Preview::None);
    worker.set_moving(false);
    worker.submit(MethodId::Reinforcement);
    REQUIRE(has_learned(worker, 5));
    CHECK(worker.status().field->passes >= 5);
}
