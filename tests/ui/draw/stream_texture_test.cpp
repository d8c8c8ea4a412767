// Meshes as textures: drawn once, opaque where there are triangles, at their place in the window.
#include "ui/draw/stream_texture.h"

#include "tests/support/catch.hpp"
#include "tests/ui/surface_bench.h"

using namespace pl::test;
using namespace pl::ui;

namespace {

/// The lower left half of a square from (10, 10) to (30, 30).
std::shared_ptr<const ScreenMesh> triangle() {
    const std::uint32_t color = IM_COL32(200, 100, 50, 255);
    return std::make_shared<const ScreenMesh>(
        ScreenMesh{.points = {{10, 10}, {10, 30}, {30, 30}}, .colors = {color, color, color}, .indices = {0, 1, 2}});
}

}  // namespace

TEST_CASE("Mesh texture: drawn once for a mesh and a part of the window") {
    SurfaceBench bench;
    PictureTextures textures(bench.renderer);
    const auto first = triangle();
    const auto second = triangle();
    const Rect part{0.0f, 0.0f, 40.0f, 40.0f};
    SDL_Texture* const texture = textures.of(first, part);
    REQUIRE(texture != nullptr);
    SDL_Texture* const other = textures.of(second, part);
    CHECK(other != texture);
    CHECK(textures.of(first, part) == texture);
    CHECK(textures.of(second, part) == other);
    CHECK(textures.of(second, {1.0f, 0.0f, 39.0f, 40.0f}) != other);
}

TEST_CASE("Mesh texture: the triangles at their place, and nothing beside them") {
    SurfaceBench bench;
    PictureTextures textures(bench.renderer);
    const Rect part{5.0f, 8.0f, 30.0f, 30.0f};
    SDL_Texture* const texture = textures.of(triangle(), part);
    REQUIRE(texture != nullptr);
    SDL_SetRenderDrawColor(bench.renderer, 0, 0, 255, 255);
    SDL_RenderClear(bench.renderer);
    const SDL_Rect place{5, 8, 30, 30};
    SDL_RenderCopy(bench.renderer, texture, nullptr, &place);
    SDL_RenderPresent(bench.renderer);
    CHECK(bench.pixel(13, 25) == 0xffc86432u);
    CHECK(bench.pixel(12, 28) == 0xffc86432u);
    CHECK(bench.pixel(28, 13) == 0xff0000ffu);
    CHECK(bench.pixel(2, 2) == 0xff0000ffu);
}
