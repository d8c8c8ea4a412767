// The pictures of a comparison as they are drawn.
#include "ui/compare/compare_layer.h"

#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_comparison.h"
#include "tests/ui/surface_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Compared pictures: the tint of the volumes lies over both, the run in progress and the stored one") {
    const std::vector<std::uint32_t> black(8, 0xff000000u);
    const auto frame = std::make_shared<PublishedFrame>();
    frame->picture = {4, 2, [&] { return black.data(); }};
    const std::shared_ptr<const HalfPicture> stored = plain_picture(0);
    ComparePlan plan;
    plan.tiles = {{.content = {.what = TileContent::What::Frame, .picture = {}, .other = {}, .frame = frame},
                   .place = {0, 0, 20, 10},
                   .clip = {0, 0, 20, 10},
                   .label = ""},
                  {.content = {.what = TileContent::What::Picture, .picture = stored, .other = {}, .frame = {}},
                   .place = {20, 0, 20, 10},
                   .clip = {20, 0, 20, 10},
                   .label = ""}};
    const CellOverlay overlay{
        .cells = std::make_shared<const CellImage>(CellImage{4, 2, std::vector<std::uint32_t>(8, 0xffc86432u)}),
        .opacity = 1.0f,
        .outlined = std::nullopt};
    const SurfaceBench bench;
    CompareLayer layer(bench.renderer);
    const auto drawn = [&](const CellOverlay& shown) {
        layer.draw(plan, {}, shown);
        SDL_RenderPresent(bench.renderer);
        return std::array{bench.pixel(10, 5), bench.pixel(30, 5)};
    };
    CHECK(drawn({}) == std::array{0xff000000u, 0xff000000u});
    CHECK(drawn(overlay) == std::array{0xffc86432u, 0xffc86432u});
}
