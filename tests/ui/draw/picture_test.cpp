#include "ui/draw/picture.h"

#include <cmath>

#include "core/kernel/film/heat_color.h"
#include "core/kernel/inspect/views.h"
#include "core/session/shown_range.h"
#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"
#include "ui/worker/cell_image.h"

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

namespace {

const ToneTable kTable(ToneCurve::Clamp);

std::uint32_t gray_code(std::uint32_t code) { return 0xff000000u | code << 16 | code << 8 | code; }

/// As a back end hands it over.
DisplayFrame frame_with(int width, int height, const std::vector<Vec3f>& values) {
    const auto pixels = std::make_shared<std::vector<std::uint32_t>>();
    for (const Vec3f& value : values) pixels->push_back(frame_pixel(value, {}, kTable.view()));
    return {width, height, [pixels] { return pixels->data(); }};
}
DisplayFrame frame_with(int width, int height, Vec3f value) {
    return frame_with(width, height, std::vector<Vec3f>(static_cast<std::size_t>(width * height), value));
}

}  // namespace

TEST_CASE("Picture: rows respect the pitch") {
    std::vector<Vec3f> values(6, Vec3f{0.25f});
    values[4].y = kNan;
    constexpr std::uint32_t kUntouched = 0x12345678u;
    std::vector<std::uint32_t> out(2 * 5, kUntouched);
    write_picture(frame_with(3, 2, values), {}, out.data(), 5);
    CHECK(out[0] == gray_code(kTable(0.25f)));
    CHECK(out[2] == gray_code(kTable(0.25f)));
    CHECK(out[3] == kUntouched);
    CHECK(out[5] == gray_code(kTable(0.25f)));
    CHECK(out[6] == kInvalidPixel);
    CHECK(out[9] == kUntouched);
}

TEST_CASE("Picture: cells are blended by opacity and the selected one is outlined") {
    std::vector<Vec3f> cells(30, color_of_id(1));
    for (std::size_t y = 1; y < 4; ++y)
        for (std::size_t x = 1; x < 4; ++x) cells[y * 6 + x] = color_of_id(2);
    const CellImage image = make_cell_image(frame_with(6, 5, cells));
    CHECK(image.argb[0] == cell_color(1, kTable.view()));
    CHECK(cell_color(1, kTable.view()) != cell_color(2, kTable.view()));

    const DisplayFrame black = frame_with(6, 5, Vec3f{0.0f});
    std::vector<std::uint32_t> out(30);
    write_picture(black, {std::make_shared<const CellImage>(image), 1.0f, std::nullopt}, out.data(), 6);
    CHECK(out == image.argb);
    write_picture(black, {std::make_shared<const CellImage>(image), 0.0f, std::nullopt}, out.data(), 6);
    CHECK(out == std::vector<std::uint32_t>(30, gray_code(0)));

    CellImage tint = image;
    tint.argb.assign(30, 0xff102030u);
    write_picture(
        black,
        {std::make_shared<const CellImage>(image), 1.0f, std::nullopt, std::make_shared<const CellImage>(tint)},
        out.data(), 6);
    CHECK(out == tint.argb);

    write_picture(frame_with(6, 5, Vec3f{0.25f}),
                  {std::make_shared<const CellImage>(image), 0.0f, cell_color(2, kTable.view())}, out.data(), 6);
    const std::uint32_t plain = gray_code(kTable(0.25f));
    CHECK(out[1 * 6 + 1] == 0xffffffffu);  // border of the cell
    CHECK(out[2 * 6 + 2] == plain);        // its inside
    CHECK(out[0 * 6 + 1] == 0xff000000u);  // around it
    CHECK(out[0 * 6 + 5] == plain);        // elsewhere
}

TEST_CASE("Picture: cells of another size are not laid over") {
    const CellImage image = make_cell_image(frame_with(2, 2, color_of_id(1)));
    std::vector<std::uint32_t> out(6);
    write_picture(frame_with(3, 2, Vec3f{0.0f}),
                  {std::make_shared<const CellImage>(image), 1.0f, cell_color(1, kTable.view())}, out.data(), 3);
    CHECK(out == std::vector<std::uint32_t>(6, gray_code(0)));
}

TEST_CASE("Picture: the colors of a heat map run from the lowest to the highest value of the range, linear or "
          "logarithmic") {
    Snapshot snapshot;
    snapshot.width = 2;
    snapshot.height = 1;
    snapshot.pixels = {Vec3f{0.1f}, Vec3f{1.0f}};
    const auto colors = [&](const ValueRange& range) {
        std::vector<std::uint32_t> pixels(2);
        write_heat(snapshot, range, pixels.data(), 2);
        return pixels;
    };
    const auto argb = [](float position) {
        const ByteColor c = heat_color(position);
        return 0xff000000u | static_cast<std::uint32_t>(c.r) << 16 | static_cast<std::uint32_t>(c.g) << 8 | c.b;
    };
    CHECK(colors({.low = 0.0f, .high = 1.0f}) == std::vector{argb(0.1f), argb(1.0f)});
    CHECK(colors({.low = 0.1f, .high = 1.0f}) == std::vector{argb(0.0f), argb(1.0f)});
    CHECK(colors({.scale = ColorScale::Logarithmic, .low = 0.01f, .high = 1.0f}) ==
          std::vector{argb(0.5f), argb(1.0f)});
}

TEST_CASE("Picture: exposure and curve are for radiance only") {
    const DisplaySettings asked{.exposure_ev = 2.0f, .curve = ToneCurve::Aces};
    for (const View view : {View::Beauty, View::Direct, View::RadianceMap})
        CHECK(display_of(view, asked).exposure_ev == 2.0f);
    for (const View view : {View::Normal, View::Albedo, View::Depth, View::Voronoi, View::Visits, View::Unvisited}) {
        CHECK(display_of(view, asked).exposure_ev == 0.0f);
        CHECK(display_of(view, asked).curve == ToneCurve::Clamp);
    }
}
