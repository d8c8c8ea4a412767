// Normals of reliefs: slopes, edges, stretched images, values that are no numbers.
#include "core/io/height_map.h"

#include <cmath>
#include <limits>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

template <class Height>
TextureDescription heights_of(std::uint32_t width, std::uint32_t height, bool repeats, const Height& at) {
    TextureDescription image{
        .content = TextureContent::Height, .width = width, .height = height, .repeats = repeats, .texels = {}};
    for (std::uint32_t row = 0; row < height; ++row)
        for (std::uint32_t column = 0; column < width; ++column)
            image.texels.emplace_back(at(column, row), 0.3f, 0.9f, 1.0f);
    return image;
}

/// Slopes of the relief along u and v at a texel.
glm::vec2 slopes_at(const TextureDescription& image, std::uint32_t column, std::uint32_t row) {
    const glm::vec3 normal = 2.0f * glm::vec3(image.texels[row * image.width + column]) - 1.0f;
    CHECK(glm::length(normal) == Approx(1.0f).epsilon(1e-5));
    return {-normal.x / normal.z, -normal.y / normal.z};
}

}  // namespace

TEST_CASE("Normals of a slanted plane are the same everywhere, its edges too where the image ends there") {
    // Up along u, and down along the rows, which is up along v.
    TextureDescription image = heights_of(5, 4, false, [](std::uint32_t x, std::uint32_t y) {
        return 0.1f * static_cast<float>(x) - 0.2f * static_cast<float>(y);
    });
    turn_into_normals(image, {2.0f, 0.5f});
    for (std::uint32_t row = 0; row < 4; ++row) {
        for (std::uint32_t column = 0; column < 5; ++column) {
            const glm::vec2 slopes = slopes_at(image, column, row);
            CHECK(slopes.x == Approx(0.2).epsilon(1e-4));
            CHECK(slopes.y == Approx(0.1).epsilon(1e-4));
        }
    }
}

TEST_CASE("A relief that repeats goes on at its edges") {
    TextureDescription image =
        heights_of(4, 1, true, [](std::uint32_t x, std::uint32_t) { return x == 3 ? 1.0f : 0.0f; });
    turn_into_normals(image, {1.0f, 1.0f});
    CHECK(slopes_at(image, 0, 0).x == Approx(-0.5));
    CHECK(slopes_at(image, 2, 0).x == Approx(0.5));
    CHECK(slopes_at(image, 3, 0).x == Approx(0.0).margin(1e-6));
    CHECK(slopes_at(image, 1, 0) == glm::vec2(0.0f));
}

TEST_CASE("Heights that are no numbers, and images of one texel, have no slope") {
    TextureDescription image = heights_of(3, 1, true, [](std::uint32_t x, std::uint32_t) {
        return x == 1 ? std::numeric_limits<float>::infinity() : 0.0f;
    });
    turn_into_normals(image, {1.0f, 1.0f});
    for (std::uint32_t column = 0; column < 3; ++column) CHECK(slopes_at(image, column, 0) == glm::vec2(0.0f));
    TextureDescription one = heights_of(1, 1, false, [](std::uint32_t, std::uint32_t) { return 0.7f; });
    turn_into_normals(one, {10.0f, 10.0f});
    CHECK(slopes_at(one, 0, 0) == glm::vec2(0.0f));
}
