#include "ui/window/icon.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <SDL.h>

namespace pl::ui {
namespace {

constexpr int kSize = 64;

/// A box seen from the front: red and green walls, a lamp, and light that fades downwards.
std::uint32_t icon_pixel(int x, int y) {
    constexpr int kInset = 14;
    const int edge = std::min({x, y, kSize - 1 - x, kSize - 1 - y});
    if (edge < 2) return 0xff101216u;
    const bool side = (x < kInset && x <= y && x <= kSize - 1 - y) ||
                      (x >= kSize - kInset && kSize - 1 - x <= y && kSize - 1 - x <= kSize - 1 - y);
    const int light = std::clamp(232 - 2 * y, 60, 255);
    const auto shade = [&](int r, int g, int b) {
        return 0xff000000u | static_cast<std::uint32_t>(r * light / 255) << 16 |
               static_cast<std::uint32_t>(g * light / 255) << 8 | static_cast<std::uint32_t>(b * light / 255);
    };
    if (y >= 5 && y < 10 && x >= 24 && x < 40) return 0xfffff6d8u;
    if (side) return x < kSize / 2 ? shade(220, 48, 40) : shade(64, 178, 72);
    if (x >= 22 && x < 34 && y >= 30 && y < 52) return shade(150, 146, 138);
    if (x >= 36 && x < 46 && y >= 42 && y < 54) return shade(176, 170, 160);
    return shade(232, 226, 214);
}

}  // namespace

void set_window_icon(SDL_Window* window) {
    std::array<std::uint32_t, static_cast<std::size_t>(kSize) * kSize> pixels;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) pixels[static_cast<std::size_t>(y * kSize + x)] = icon_pixel(x, y);
    SDL_Surface* surface =
        SDL_CreateRGBSurfaceWithFormatFrom(pixels.data(), kSize, kSize, 32, kSize * 4, SDL_PIXELFORMAT_ARGB8888);
    if (surface == nullptr) return;
    SDL_SetWindowIcon(window, surface);
    SDL_FreeSurface(surface);
}

}  // namespace pl::ui
