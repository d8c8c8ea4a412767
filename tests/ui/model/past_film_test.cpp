// The film of the past, with pixels as the window would give them.
#include "ui/model/past_film.h"

#include "core/io/picture_file.h"
#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "tests/ui/installed_programs.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

struct FilmBench : FileBench {
    ViewerModel model;

    FilmBench() : model(with_learning(options), small_scene(), options.settings, 0.0) {
        model.time().set_keeps(true);
        REQUIRE(run_until(model, [&] { return model.time().history()->frames.size() >= 5; }));
        model.render().set_paused(true);
        REQUIRE(run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
    }

    /// Frames of the window: each picture is as wide as its key frame has passes.
    bool draw_until(const std::function<bool()>& condition) {
        return run_until(model, [&] {
            if (model.past_film().wants_pixels()) {
                const int width = static_cast<int>(model.time().frame()->passes());
                model.past_film().add({width, 1, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width))});
            }
            return condition();
        });
    }

private:
    static const ViewerOptions& with_learning(ViewerOptions& options) {
        options.settings.method = MethodId::Reinforcement;
        return options;
    }
};

}  // namespace

TEST_CASE(
    "Past film: one picture of the window for each key frame, in their order, also with lobes of many volumes") {
    InstalledPrograms installed;  // no ffmpeg
    FilmBench bench;
    ViewerModel& model = bench.model;
    model.flowers().set_shown(true);
    const auto frames = model.time().history()->frames;
    model.past_film().begin();
    CHECK(model.busy());
    REQUIRE(bench.draw_until([&] { return !model.past_film().written(); }));
    REQUIRE(bench.draw_until([&] { return !model.busy(); }));
    CHECK_FALSE(model.time().shown());
    const std::filesystem::path folder = bench.options.screenshot_dir / "small-past-0001";
    CHECK(told(model, "the frames are in " + folder.string() + "; ffmpeg, which is not installed"));
    for (std::size_t i = 0; i < frames.size(); ++i)
        CHECK(read_png8(frame_file(folder, static_cast<int>(i), ImageKind::Png)).width ==
              static_cast<int>(frames[i]->passes()));
}

TEST_CASE("Past film: Esc stops it, and so does another time") {
    FilmBench bench;
    ViewerModel& model = bench.model;
    model.past_film().begin();
    REQUIRE(bench.draw_until([&] { return model.past_film().written() == 2; }));
    model.cancel();
    CHECK_FALSE(model.past_film().written());
    CHECK(told(model, "stopped: 2 frames are in "));
    model.past_film().begin();
    model.time().show(std::nullopt);
    model.update(bench.clock += 1.0);
    CHECK_FALSE(model.past_film().written());
}

TEST_CASE("Past film: without a past it says how to have one") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.past_film().begin();
    CHECK_FALSE(model.past_film().written());
    CHECK(told(model, "'keep the past' takes key frames"));
}
