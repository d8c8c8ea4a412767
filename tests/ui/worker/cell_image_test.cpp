#include "ui/worker/cell_image.h"

#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Cell image: is current until camera, size or placement change") {
    SessionBench bench;
    CellRenderer cells;
    CHECK_FALSE(cells.is_current(bench.session));
    CHECK_FALSE(cells.image(bench.session));
    REQUIRE(cells.render(bench.session, nullptr));
    CHECK(cells.is_current(bench.session));
    REQUIRE(cells.image(bench.session));
    CHECK(cells.image(bench.session)->width == 16);
    cells.invalidate();
    CHECK_FALSE(cells.image(bench.session));
    REQUIRE(cells.render(bench.session, nullptr));
    CHECK(cells.image(bench.session));
}

TEST_CASE("Cell image: a pass that is stopped leaves no image, and films of other views alone") {
    SessionBench bench;
    bench.render(kLearning, 2);
    CellRenderer cells;
    const StopFlag stop{true};
    CHECK_FALSE(cells.render(bench.session, &stop));
    CHECK_FALSE(cells.image(bench.session));
    REQUIRE(cells.render(bench.session, nullptr));
    CHECK(bench.session.passes(kLearning) == 2);
}

TEST_CASE("Render worker: cells belong to the camera of the frame") {
    Bench bench;
    RenderWorker worker(bench.setup());
    REQUIRE(frame_of(worker, 0));
    CHECK_FALSE(worker.latest()->cells);
    worker.set_cells_wanted(true);
    REQUIRE(eventually([&] { return worker.latest()->cells != nullptr; }));
    const auto cells = worker.latest()->cells;
    CHECK(cells->width == kSize);
    const std::uint64_t generation = worker.submit(EditCamera{camera_at(1.0f)});
    REQUIRE(eventually([&] {
        const auto frame = worker.latest();
        return frame->generation >= generation && frame->cells;
    }));
    CHECK(worker.latest()->cells != cells);
    // The cells are a film of their own.
    CHECK(worker.latest()->snapshot.slot.view == View::Beauty);
    worker.set_cells_wanted(false);
    CHECK(eventually([&] { return !worker.latest()->cells; }));
}
