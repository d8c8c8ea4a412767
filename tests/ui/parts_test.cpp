#include <fstream>

#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "ui/edit_queue.h"
#include "ui/layout.h"
#include "ui/motion_resolution.h"
#include "ui/numbered_names.h"
#include "ui/ui_trace.h"

using namespace pl;

TEST_CASE("Edit queue: of each kind only the newest is left, in order of its arrival") {
    EditQueue queue;
    CHECK(queue.empty());
    CameraDescription first;
    first.fov_deg = 10.0f;
    CameraDescription second;
    second.fov_deg = 20.0f;
    queue.push(EditCamera{first});
    queue.push(EditScene{nullptr});
    queue.push(EditMethod{MethodId::Precomputed});
    queue.push(EditCamera{second});
    queue.push(EditMethod{MethodId::Reinforcement});
    const auto edits = queue.take();
    CHECK(queue.empty());
    REQUIRE(edits.size() == 3);
    // A camera that follows a scene must be applied after it: a new scene brings its own.
    CHECK(std::holds_alternative<EditScene>(edits[0]));
    REQUIRE(std::holds_alternative<EditCamera>(edits[1]));
    CHECK(std::get<EditCamera>(edits[1]).camera.fov_deg == 20.0f);
    CHECK(std::get<EditMethod>(edits[2]).method == MethodId::Reinforcement);
}

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

TEST_CASE("Layout: panels, picture and bars fill the window without overlap") {
    const Layout layout = make_layout(1440.0f, 900.0f, 16.0f, true, false);
    CHECK(layout.left.x == 0.0f);
    CHECK(layout.view.x == layout.left.width);
    CHECK(layout.right.x == layout.view.x + layout.view.width);
    CHECK(layout.right.x + layout.right.width == 1440.0f);
    for (const Rect& rect : {layout.left, layout.view, layout.right}) {
        CHECK(rect.y == layout.menu.height);
        CHECK(rect.y + rect.height == layout.status.y);
    }
    CHECK(layout.status.y + layout.status.height == 900.0f);
    const Layout bare = make_layout(1440.0f, 900.0f, 16.0f, false, false);
    CHECK(bare.view.width == 1440.0f);
    CHECK(bare.view.height == 900.0f);
    CHECK(bare.left.width == 0.0f);
}

TEST_CASE("Layout: in a narrow window the panels shrink, then float over the picture") {
    const Layout narrow = make_layout(1024.0f, 700.0f, 16.0f, true, false);
    CHECK(narrow.left.width < 18.0f * 16.0f);
    CHECK(narrow.right.width < 25.0f * 16.0f);
    CHECK(narrow.view.width > 400.0f);
    CHECK(narrow.view.width == narrow.clear.width);
    const Layout floating = make_layout(800.0f, 600.0f, 16.0f, true, false);
    CHECK(floating.view.width == 800.0f);
    CHECK(floating.clear.width < 800.0f);
    for (const float width : {1.0f, 100.0f, 400.0f, 640.0f}) {
        const Layout tiny = make_layout(width, 20.0f, 16.0f, true, false);
        CHECK(tiny.left.height >= 1.0f);
        CHECK(tiny.left.width + tiny.right.width <= width);
        CHECK(tiny.clear.width >= 0.0f);
    }
}

TEST_CASE("Layout: the picture keeps its shape, and is shown pixel by pixel where it nearly fits") {
    const Rect view{100.0f, 50.0f, 800.0f, 600.0f};
    const Rect wide = place_image(view, 1600, 800);
    CHECK(wide.width == 800.0f);
    CHECK(wide.height == 400.0f);
    CHECK(wide.y == 150.0f);
    const Rect near = place_image(view, 590, 590);
    CHECK(near.width == 590.0f);
    CHECK(near.height == 590.0f);
    const Rect small = place_image(view, 60, 60);
    CHECK(small.width == 600.0f);
    CHECK(place_image(view, 0, 0).width == 0.0f);
    CHECK(fit_image(view, 512, 512).width == 600);
    CHECK(fit_image(view, 512, 512).height == 600);
    CHECK(fit_image(view, 1600, 900).width == 800);
    CHECK(fit_image(view, 1600, 900).height == 450);
    CHECK(fit_image({0, 0, 10, 10}, 1, 1).width == 64);
}

TEST_CASE("Numbered names: no file is ever hit twice") {
    const test::TemporaryFolder folder;
    const std::filesystem::path& dir = folder.path();
    std::ofstream(dir / "box-0001.png") << "x";
    std::ofstream(dir / "box-0003.exr") << "x";
    NumberedNames names;
    CHECK(names.next(dir, "box", {".exr", ".png"}) == dir / "box-0002");
    // Not written yet, and still taken.
    CHECK(names.next(dir, "box", {".exr", ".png"}) == dir / "box-0004");
    CHECK(file_name_part("my scene/a.b") == "my-scene-a-b");
    CHECK(file_name_part("") == "picture");
}

TEST_CASE("UI trace: percentiles interpolate, latencies run from a move to the picture that shows it") {
    CHECK(percentile({}, 0.5) == 0.0);
    CHECK(percentile({3.0}, 0.95) == 3.0);
    CHECK(percentile({4.0, 1.0, 3.0, 2.0}, 0.5) == Approx(2.5));
    CHECK(percentile({4.0, 1.0, 3.0, 2.0}, 1.0) == 4.0);

    const test::TemporaryFolder folder;
    UiTrace trace(folder.path() / "trace.jsonl");
    trace.camera_moved(1.0, 5);
    trace.camera_moved(1.1, 6);                        // same motion
    trace.frame_shown(1.02, {0.004, 0.003, -1.0}, 4);  // does not show them yet
    trace.frame_shown(1.05, {0.004, 0.003, 0.016}, 5);
    trace.backend_asked(1.18, 7);
    trace.frame_shown(1.20, {0.006, 0.003, 0.016}, 7);
    trace.backend_asked(1.30, 8);  // its picture never comes
    trace.frame_shown(1.40, {0.006, 0.003, 0.016}, 7);
    const std::string summary = trace.finish();
    CHECK_THAT(summary, test::contains("first picture after a rest   p50   50.00 ms"));
    CHECK_THAT(summary, test::contains("input to picture             p50   75.00 ms"));
    CHECK_THAT(summary, test::contains("n 4"));
    CHECK_THAT(summary, test::contains("switch of back ends          p50   20.00 ms"));
    CHECK_THAT(summary, test::contains("max   20.00 ms   n 1"));
}
