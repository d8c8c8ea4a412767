#include "core/diagnose/mark_diagnostics.h"

#include <algorithm>
#include <cstdlib>

namespace pl::diagnose {
namespace {

constexpr int kRingRadius = 4;

/// Within the radius of a ring around a pixel; with more occurrences, rings would hide the pixels they mark.
constexpr int kMostWithRings = 4;

std::uint32_t darkened(std::uint32_t argb) { return 0xff000000u | ((argb >> 2) & 0x3f3f3fu); }

/// Index into all_diagnostics() of the kind that a pixel shows; kDiagnosticCount if it has none.
std::size_t kind_at(const DiagnosticsMap& map, int x, int y) {
    const DiagnosticsMap::Pixel& pixel =
        map.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)];
    const auto first = std::ranges::find_if(pixel, [](std::uint32_t count) { return count > 0; });
    return static_cast<std::size_t>(first - pixel.begin());
}

/// Calls fn(u, v) for the pixels of the map at most `radius` rows and columns away.
template <class Fn>
void for_each_around(const DiagnosticsMap& map, int x, int y, int radius, Fn&& fn) {
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, map.height - 1); ++v)
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, map.width - 1); ++u) fn(u, v);
}

bool is_isolated(const DiagnosticsMap& map, int x, int y) {
    int count = 0;
    for_each_around(map, x, y, kRingRadius,
                    [&](int u, int v) { count += kind_at(map, u, v) != kDiagnosticCount ? 1 : 0; });
    return count <= kMostWithRings;
}

/// A square ring; of radius 0 the pixel itself.
void draw_ring(const DiagnosticsMap& map, int x, int y, int radius, std::uint32_t color, PixelRows picture) {
    for_each_around(map, x, y, radius, [&](int u, int v) {
        if (std::max(std::abs(u - x), std::abs(v - y)) == radius) picture.at(u, v) = color;
    });
}

void draw_rings(const DiagnosticsMap& map, int radius, PixelRows picture) {
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const std::size_t kind = kind_at(map, x, y);
            if (kind == kDiagnosticCount || (radius > 0 && !is_isolated(map, x, y))) continue;
            draw_ring(map, x, y, radius, all_diagnostics()[kind].color, picture);
        }
}

}  // namespace

void mark_diagnostics(const DiagnosticsMap& map, PixelRows picture) {
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) picture.at(x, y) = darkened(picture.at(x, y));
    draw_rings(map, kRingRadius, picture);
    draw_rings(map, 0, picture);  // above the rings
}

}  // namespace pl::diagnose
