#include <algorithm>
#include <cmath>
#include <limits>

#include "core/kernel/inspect/views.h"
#include "tests/catch.hpp"
#include "ui/picture.h"

using namespace pl;

namespace {

float exact_code(ToneCurve curve, float x) { return 255.0f * encode_srgb(apply_curve(curve, x)); }

std::uint32_t gray(std::uint32_t code) { return 0xff000000u | code << 16 | code << 8 | code; }

Snapshot snapshot_of(int width, int height, Vec3f value) {
    Snapshot snapshot;
    snapshot.width = width;
    snapshot.height = height;
    snapshot.pixels.assign(static_cast<std::size_t>(width * height), value);
    return snapshot;
}

}  // namespace

TEST_CASE("Tone table: within its promised error of exact rounding, and monotone") {
    for (const ToneCurve curve : {ToneCurve::Clamp, ToneCurve::Reinhard, ToneCurve::Aces}) {
        const ToneTable table(curve);
        int last = 0;
        float worst = 0.0f;
        // Every third float step of a table entry, over more than the table's range.
        for (float x = 1.0e-6f; x < 1.0e6f; x *= 1.0001f) {
            const int code = table(x);
            CHECK(code >= last);
            last = code;
            worst = std::max(worst, std::fabs(static_cast<float>(code) - exact_code(curve, x)));
        }
        INFO("curve " << static_cast<int>(curve) << ", worst error " << worst);
        CHECK(worst <= 0.5f + ToneTable::kMaxError);
        CHECK(last == 255);
    }
}

TEST_CASE("Tone table: the ends are exact") {
    for (const ToneCurve curve : {ToneCurve::Clamp, ToneCurve::Reinhard, ToneCurve::Aces}) {
        const ToneTable table(curve);
        CHECK(table(0.0f) == 0);
        CHECK(table(-1.0f) == 0);
        CHECK(table(-kInfinity) == 0);
        CHECK(table(std::numeric_limits<float>::denorm_min()) == 0);
        CHECK(table(std::numeric_limits<float>::max()) == 255);
        CHECK(table(kInfinity) == 255);
    }
    CHECK(ToneTable(ToneCurve::Clamp)(1.0f) == 255);
}

TEST_CASE("Picture: exposure scales, invalid pixels are marked, rows respect the pitch") {
    const ToneTable table(ToneCurve::Clamp);
    Snapshot snapshot = snapshot_of(3, 2, Vec3f{0.25f});
    snapshot.pixels[4].y = std::numeric_limits<float>::quiet_NaN();
    constexpr std::uint32_t kUntouched = 0x12345678u;
    std::vector<std::uint32_t> out(2 * 5, kUntouched);
    write_picture(snapshot, 2.0f, table, {}, out.data(), 5);
    const auto code = static_cast<std::uint32_t>(std::lround(exact_code(ToneCurve::Clamp, 0.5f)));
    CHECK(out[0] == gray(code));
    CHECK(out[2] == gray(code));
    CHECK(out[3] == kUntouched);
    CHECK(out[5] == gray(code));
    CHECK(out[6] == 0xffff00ffu);
    CHECK(out[9] == kUntouched);
}

TEST_CASE("Picture: cells are blended by opacity and the selected one is outlined") {
    const ToneTable table(ToneCurve::Clamp);
    Snapshot cells = snapshot_of(6, 5, color_of_id(1));
    for (int y = 1; y < 4; ++y)
        for (int x = 1; x < 4; ++x) cells.pixels[static_cast<std::size_t>(y * 6 + x)] = color_of_id(2);
    const CellImage image = make_cell_image(cells, table);
    CHECK(image.argb[0] == cell_color(1, table));
    CHECK(cell_color(1, table) != cell_color(2, table));

    const Snapshot black = snapshot_of(6, 5, Vec3f{0.0f});
    std::vector<std::uint32_t> out(30);
    write_picture(black, 1.0f, table, {&image, 1.0f, std::nullopt}, out.data(), 6);
    CHECK(out == image.argb);
    write_picture(black, 1.0f, table, {&image, 0.0f, std::nullopt}, out.data(), 6);
    CHECK(out == std::vector<std::uint32_t>(30, gray(0)));

    const Snapshot dim = snapshot_of(6, 5, Vec3f{0.25f});
    write_picture(dim, 1.0f, table, {&image, 0.0f, cell_color(2, table)}, out.data(), 6);
    const std::uint32_t plain = gray(table(0.25f));
    CHECK(out[1 * 6 + 1] == 0xffffffffu);  // border of the cell
    CHECK(out[2 * 6 + 2] == plain);        // its inside
    CHECK(out[0 * 6 + 1] == 0xff000000u);  // around it
    CHECK(out[0 * 6 + 5] == plain);        // elsewhere
}

TEST_CASE("Picture: cells of another size are not laid over") {
    const ToneTable table(ToneCurve::Clamp);
    const CellImage image = make_cell_image(snapshot_of(2, 2, color_of_id(1)), table);
    const Snapshot black = snapshot_of(3, 2, Vec3f{0.0f});
    std::vector<std::uint32_t> out(6);
    write_picture(black, 1.0f, table, {&image, 1.0f, cell_color(1, table)}, out.data(), 3);
    CHECK(out == std::vector<std::uint32_t>(6, gray(0)));
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

TEST_CASE("Picture: heat maps have their colors, and invalid pixels theirs") {
    Snapshot snapshot = snapshot_of(3, 1, Vec3f{4.0f});
    snapshot.slot.view = View::Entropy;
    snapshot.pixels[1] = Vec3f{kNan};
    snapshot.pixels[2] = Vec3f{8.0f};
    std::vector<std::uint32_t> out(3);
    write_picture(snapshot, 1.0f / 8.0f, ToneTable(ToneCurve::Clamp), {}, out.data(), 3);
    CHECK(out == std::vector<std::uint32_t>{0xff078c93u, 0xffff00ffu, 0xfff8eb7au});
}
