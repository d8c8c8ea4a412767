#include "ui/draw/cell_tint.h"

#include "core/kernel/film/heat_color.h"
#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Cell tint: pixels take the color of their volume's value, others stay") {
    const CellImage cells{3, 1, {0xff112233u, 0xff445566u, 0xff778899u}};
    const std::vector<std::uint32_t> colors{0xff445566u, 0xff112233u};
    const std::vector<float> positions{0.0f, 1.0f};
    const CellImage tinted = tint_cells(cells, colors, positions);
    const auto argb = [](float position) {
        const ByteColor c = heat_color(position);
        return 0xff000000u | static_cast<std::uint32_t>(c.r) << 16 | static_cast<std::uint32_t>(c.g) << 8 | c.b;
    };
    CHECK(tinted.width == 3);
    CHECK(tinted.argb == std::vector<std::uint32_t>{argb(1.0f), argb(0.0f), 0xff778899u});
}

TEST_CASE("Cell tint: a field without training samples is uniform, its entropy the largest") {
    SessionBench bench;
    bench.render(kLearning, 1);
    FieldHistoryRecorder recorder;
    recorder.set_limit(1);
    REQUIRE(recorder.observe(bench.session, MethodId::Reinforcement));
    const FieldKeyFrame& frame = *recorder.history()->frames.front();
    const std::vector<float> shares = entropy_shares(frame);
    REQUIRE(shares.size() == frame.volumes());
    // The fake back end leaves the probabilities as they are.
    for (const float share : shares) CHECK(share == Approx(1.0f).epsilon(1.0e-5));
}
