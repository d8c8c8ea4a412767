// The frame of a film: codes near exact rounding, exposure and range as one factor, invalid pixels marked.
#include "core/kernel/film/frame_pixel.h"

#include <algorithm>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr ToneCurve kCurves[] = {ToneCurve::Clamp, ToneCurve::Reinhard, ToneCurve::Aces};

float exact_code(ToneCurve curve, float x) { return 255.0f * encode_srgb(apply_curve(curve, x)); }

}  // namespace

TEST_CASE("Tone table: within its promised error of exact rounding, and monotone") {
    for (const ToneCurve curve : kCurves) {
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
        CHECK(worst <= 0.5f + ToneCodes::kMaxError);
        CHECK(last == 255);
    }
}

TEST_CASE("Tone table: the ends are exact") {
    for (const ToneCurve curve : kCurves) {
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

TEST_CASE("Frame: exposure scales, channels keep their places, invalid pixels are marked") {
    for (const ToneCurve curve : kCurves) {
        const ToneTable table(curve);
        const FrameStyle style{.scale = 2.0f, .curve = curve};
        const std::uint32_t pixel = frame_pixel({0.1f, 0.2f, 0.3f}, style, table.view());
        CHECK(pixel == pack_pixel(table(0.2f), table(0.4f), table(0.6f)));
        CHECK(pixel >> 24 == 0xff);
        CHECK((pixel >> 16 & 0xff) == table(0.2f));
        for (int channel = 0; channel < 3; ++channel) {
            Vec3f bad{0.5f};
            bad[channel] = kNan;
            CHECK(frame_pixel(bad, style, table.view()) == kInvalidPixel);
        }
    }
}

TEST_CASE("Frame: heat maps have their colors, and invalid pixels theirs") {
    const ToneTable table(ToneCurve::Clamp);
    const FrameStyle style{.scale = 1.0f / 8.0f, .heat = 1};
    CHECK(frame_pixel(Vec3f{4.0f}, style, table.view()) == 0xff078c93u);
    CHECK(frame_pixel(Vec3f{kNan}, style, table.view()) == kInvalidPixel);
    CHECK(frame_pixel(Vec3f{8.0f}, style, table.view()) == 0xfff8eb7au);
    CHECK(frame_pixel(Vec3f{kInfinity}, style, table.view()) == 0xfff8eb7au);
}

TEST_CASE("Frame: ranges end at finite, positive means only") {
    FilmPixel pixel;
    CHECK(range_value(pixel) == 0.0f);
    pixel.invalid = 1;
    CHECK(range_value(pixel) == 0.0f);  // NaN
    pixel.weight = 2;
    pixel.sum = Vec3d{6.0, 100.0, 100.0};
    CHECK(range_value(pixel) == 3.0f);
    pixel.sum = Vec3d{1.0e300};
    CHECK(range_value(pixel) == 0.0f);  // infinite as a float
}
