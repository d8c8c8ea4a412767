// Pixels of stored pictures, differences and error maps.
#include <cmath>

#include "core/kernel/base/half.h"
#include "core/kernel/film/frame_pixel.h"
#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_runs.h"
#include "ui/compare/half_image.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

/// The pixels of a plain picture of one half float, as written.
std::uint32_t shown(std::uint16_t half, const DisplaySettings& display) {
    std::uint32_t out[8] = {};
    write_half_picture(*plain_picture(half), HalfCodes(display), out, 4);
    return out[7];
}

}  // namespace

TEST_CASE("Stored pictures: exposure and curve apply to them as to frames") {
    for (const ToneCurve curve : {ToneCurve::Clamp, ToneCurve::Reinhard, ToneCurve::Aces})
        for (const float ev : {-2.0f, 0.0f, 3.0f}) {
            const DisplaySettings display{.exposure_ev = ev, .curve = curve};
            const ToneTable table(curve);
            const FrameStyle style{.scale = std::exp2(ev), .curve = curve};
            for (const std::uint16_t half : std::array<std::uint16_t, 5>{0x0000, 0x2e66, 0x3800, 0x3c00, 0x4d00})
                CHECK(shown(half, display) == frame_pixel(Vec3f{from_half(half)}, style, table.view()));
        }
    CHECK(shown(0x7e00, {}) == kInvalidPixel);
}

TEST_CASE("Difference: equal pictures are black, the sign does not matter") {
    std::uint32_t ab[8], ba[8], aa[8];
    const auto a = plain_picture(0x3c00), b = plain_picture(0x3800);  // 1 and 0.5
    write_difference(*a, *b, {}, ab, 4);
    write_difference(*b, *a, {}, ba, 4);
    write_difference(*a, *a, {}, aa, 4);
    CHECK(ab[3] == ba[3]);
    CHECK(ab[3] == shown(0x3800, {}));
    CHECK(aa[3] == 0xff000000u);
}

TEST_CASE("Error map: a pixel counts as in relMSE, and colors follow its logarithm") {
    // (1.5 - 1)^2 / (1 + 0.01)
    CHECK_THAT(pixel_error(Vec3f{1.5f}, Vec3f{1.0f}), WithinRel(std::sqrt(0.25 / 1.01), 1e-6));
    CHECK(pixel_error(Vec3f{1.0f}, Vec3f{1.0f}) == 0.0f);
    CHECK(std::isnan(pixel_error(Vec3f{NAN}, Vec3f{1.0f})));
    std::uint32_t same[8], off[8], invalid[8];
    write_error_map(*plain_picture(0x3c00), *plain_picture(0x3c00), same, 4);
    write_error_map(*plain_picture(0x5000), *plain_picture(0x3c00), off, 4);  // 32: beyond the end of the scale
    write_error_map(*plain_picture(0x7e00), *plain_picture(0x3c00), invalid, 4);
    const auto color = [](float share) {
        const ByteColor c = heat_color(share);
        return pack_pixel(c.r, c.g, c.b);
    };
    CHECK(same[0] == color(0.0f));
    CHECK(off[0] == color(1.0f));
    CHECK(invalid[0] == kInvalidPixel);
}
