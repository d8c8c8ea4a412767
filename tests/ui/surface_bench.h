// A window in memory for tests of what is drawn.
#pragma once

#include <array>
#include <cstdint>

#include <SDL.h>

namespace pl::test {

struct SurfaceBench {
    static constexpr int kWindow = 40;

    std::array<std::uint32_t, static_cast<std::size_t>(kWindow) * kWindow> pixels{};
    SDL_Surface* surface = SDL_CreateRGBSurfaceWithFormatFrom(pixels.data(), kWindow, kWindow, 32, 4 * kWindow,
                                                              SDL_PIXELFORMAT_ARGB8888);
    SDL_Renderer* renderer = SDL_CreateSoftwareRenderer(surface);

    ~SurfaceBench() {
        SDL_DestroyRenderer(renderer);
        SDL_FreeSurface(surface);
    }
    std::uint32_t pixel(int x, int y) const { return pixels[static_cast<std::size_t>(y * kWindow + x)]; }
};

}  // namespace pl::test
