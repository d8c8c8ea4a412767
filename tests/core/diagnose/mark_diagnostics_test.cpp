// Marks of diagnostics in a picture.
#include "core/diagnose/mark_diagnostics.h"

#include <algorithm>

#include "core/kernel/film/frame_pixel.h"
#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::diagnose;

TEST_CASE("Mark diagnostics: isolated pixels get rings in the color of their first kind, crowded ones none") {
    constexpr int kSide = 16;
    DiagnosticsMap map{.width = kSide, .height = kSide, .pixels = std::vector<DiagnosticsMap::Pixel>(kSide * kSide)};
    map.pixels[0] = {0, 1, 1, 0};
    map.pixels[10 * kSide + 10] = {2, 1, 0, 0};
    std::vector<std::uint32_t> argb(kSide * (kSide + 3), 0xff804020u);
    mark_diagnostics(map, {argb.data(), kSide + 3});
    const auto at = [&](int x, int y) { return argb[static_cast<std::size_t>(y * (kSide + 3) + x)]; };
    CHECK(at(0, 0) == info_of(DiagnosticKind::EscapedPath).color);
    CHECK(at(4, 0) == info_of(DiagnosticKind::EscapedPath).color);
    CHECK(at(0, 4) == info_of(DiagnosticKind::EscapedPath).color);
    CHECK(at(10, 10) == info_of(DiagnosticKind::InvalidSample).color);
    CHECK(at(14, 6) == info_of(DiagnosticKind::InvalidSample).color);
    CHECK(at(9, 9) == 0xff201008u);
    CHECK(at(kSide, 3) == 0xff804020u);
    CHECK(info_of(DiagnosticKind::InvalidSample).color == kInvalidPixel);

    std::fill(map.pixels.begin(), map.pixels.end(), DiagnosticsMap::Pixel{});
    for (std::size_t i = 0; i < 3; ++i)
        map.pixels[(2 * i + 6) * kSide + 8] = map.pixels[(2 * i + 6) * kSide + 10] = {0, 0, 0, 7};
    std::fill(argb.begin(), argb.end(), 0xff804020u);
    mark_diagnostics(map, {argb.data(), kSide + 3});
    CHECK(std::count(argb.begin(), argb.end(), info_of(DiagnosticKind::ClampedSample).color) == 6);
}
