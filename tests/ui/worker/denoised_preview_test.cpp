// The denoised display of few samples: beside the picture, whose bits it leaves alone, and only where it is wanted.
#include "ui/worker/denoised_preview.h"

#include "tests/support/catch.hpp"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::test;

namespace {

/// The frame of a film of this many samples.
std::shared_ptr<const PublishedFrame> frame_after(Bench& bench, std::uint32_t spp, bool denoised,
                                                  std::optional<TurnSides> turns = {}) {
    RenderWorker worker(bench.setup(MethodId::Default, {.spp = spp}));
    worker.set_denoised_wanted(denoised);
    worker.set_turns(turns);
    std::shared_ptr<const PublishedFrame> frame;
    REQUIRE(eventually([&] {
        frame = worker.latest();
        return frame && frame->snapshot.passes == spp &&
               (turns || frame->denoised.width > 0 || !denoised || spp >= DenoisedPreview::kEnoughPasses);
    }));
    return frame;
}

}  // namespace

TEST_CASE("Denoised preview: a display beside the picture, below 16 samples") {
    Bench bench;
    const auto plain = frame_after(bench, 4, false);
    const auto frame = frame_after(bench, 4, true);
    CHECK(plain->denoised.width == 0);
    REQUIRE(frame->denoised.width == kSize);
    REQUIRE(frame->denoised.height == kSize);
    CHECK(frame->denoised.pixels() != frame->picture.pixels());
    CHECK(frame->denoise_seconds > 0.0);
    for (int i = 0; i < kSize * kSize; ++i) REQUIRE(frame->picture.pixels()[i] == plain->picture.pixels()[i]);
    CHECK(frame_after(bench, DenoisedPreview::kEnoughPasses, true)->denoised.width == 0);
}

TEST_CASE("Denoised preview: none in turns of two methods, of data views and on devices") {
    Bench bench;
    CHECK(frame_after(bench, 4, true, TurnSides{.methods = {MethodId::Default, MethodId::Reinforcement}})
              ->denoised.width == 0);
    RenderWorker worker(bench.setup());
    worker.set_denoised_wanted(true);
    auto frame = frame_of(worker, worker.submit(View::Normal));
    REQUIRE(frame);
    CHECK(frame->denoised.width == 0);
    worker.submit(View::Beauty);
    frame = frame_of(worker, worker.switch_backend("cuda"));
    REQUIRE(frame);
    CHECK(frame->backend.name == "cuda");
    CHECK(frame->denoised.width == 0);
}

TEST_CASE("Denoised preview: invalid pixels stay marked") {
    Bench bench;
    auto scene = std::make_shared<SceneDescription>(*small_scene());
    RenderSettings settings{};
    settings.width = settings.height = kSize;
    settings.camera = scene->camera;
    Session session(bench.devices.maker()("cpu"), scene, settings);
    session.advance(slot_of(settings));
    PublishedFrame frame = frame_of_film(session, slot_of(settings), {}, true);
    frame.backend.name = "cpu";
    frame.snapshot.pixels[100] = Vec3f{kNan};
    DenoisedPreview preview;
    // A stopped one leaves nothing behind.
    CHECK_FALSE(preview.add_to(frame, session, StopFlag{true}));
    CHECK(frame.denoised.width == 0);
    CHECK(preview.add_to(frame, session, StopFlag{false}));
    REQUIRE(frame.denoised.width == kSize);
    CHECK(frame.denoised.pixels()[100] == kInvalidPixel);
    CHECK(frame.denoised.pixels()[101] != kInvalidPixel);
}
