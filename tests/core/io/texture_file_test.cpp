// Images as textures: their colors, opacities, and values that are no radiance.
// Normals of reliefs: slopes, edges, stretched images, values that are no numbers.
#include "core/io/texture_file.h"

#include <cmath>
#include <limits>

#include "core/io/files.h"
#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/image_bytes.h"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::hdr;
using pl::test::input_error;
using pl::test::TemporaryFolder;
using pl::test::tga;

namespace {

TextureDescription read(const std::string& name, std::string_view bytes, TextureContent content) {
    const TemporaryFolder folder;
    std::vector<std::string> warnings;
    return read_texture(folder.write(name, bytes), content, true, warnings);
}

}  // namespace

TEST_CASE("Colors of LDR files are decoded, numbers are not") {
    const std::string png = encode_png8({.width = 2, .height = 1, .rgb = {0, 128, 255, 10, 10, 10}});
    const TextureDescription color = read("a.png", png, TextureContent::Color);
    REQUIRE(color.texels.size() == 2);
    CHECK(color.width == 2);
    CHECK(color.height == 1);
    CHECK(color.texels[0].x == 0.0f);
    CHECK(color.texels[0].y == Approx(std::pow((128.0 / 255.0 + 0.055) / 1.055, 2.4)));
    CHECK(color.texels[0].z == 1.0f);
    CHECK(color.texels[1].x == Approx(10.0 / 255.0 / 12.92));
    CHECK(color.texels[1].w == 1.0f);
    CHECK(read("a.PNG", png, TextureContent::Number).texels[0].y == Approx(128.0 / 255.0));
}

TEST_CASE("Opacity is the alpha channel, or the first one where that says nothing") {
    const std::string with_alpha("\x01\x02\x03\xff\x01\x02\x03\x33", 8);
    const TextureDescription alpha = read("a.tga", tga(2, 1, with_alpha), TextureContent::Opacity);
    CHECK(alpha.texels[0].w == 1.0f);
    CHECK(alpha.texels[1].w == Approx(0.2));
    const std::string gray = encode_png8({.width = 2, .height = 1, .rgb = {0, 0, 0, 51, 51, 51}});
    const TextureDescription mask = read("a.png", gray, TextureContent::Opacity);
    CHECK(mask.texels[0].w == 0.0f);
    CHECK(mask.texels[1].w == Approx(0.2));
}

TEST_CASE("HDR files are linear and their rows go from the top") {
    const std::string two("\x80\x40\x20\x82\x80\x80\x80\x81", 8);  // 128/256 * 4 and 128/256 * 2
    const TextureDescription texture = read("a.hdr", hdr(1, 2, two), TextureContent::Color);
    REQUIRE(texture.texels.size() == 2);
    CHECK(texture.texels[0] == glm::vec4(2.0f, 1.0f, 0.5f, 1.0f));
    CHECK(texture.texels[1] == glm::vec4(1.0f));
}

TEST_CASE("Values that are no radiance count as 0, with one counted warning") {
    const TemporaryFolder folder;
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
    const LinearImage image{
        .width = 4, .height = 1, .pixels = {{kNaN, 1, 2}, {kInf, 1, 2}, {-1, 1, 2}, {1e9f, 1, 2}}};
    for (const char* name : {"a.pfm", "a.exr"}) {
        const auto path = folder.path() / name;
        name == std::string("a.pfm") ? write_pfm(path, image) : write_exr(path, image);
        std::vector<std::string> warnings;
        const TextureDescription texture = read_texture(path, TextureContent::Color, true, warnings);
        REQUIRE(texture.texels.size() == 4);
        for (int i = 0; i < 3; ++i) CHECK(texture.texels[static_cast<std::size_t>(i)] == glm::vec4(0, 1, 2, 1));
        CHECK(texture.texels[3] == glm::vec4(1e9f, 1, 2, 1));
        REQUIRE(warnings.size() == 1);
        CHECK_THAT(warnings[0], contains("3 texels"));
    }
}

TEST_CASE("The name of an image file says nothing about its kind") {
    const TemporaryFolder folder;
    const LinearImage linear{.width = 2, .height = 1, .pixels = std::vector<glm::vec3>(2, {0.5f, 0.25f, 0.75f})};
    write_exr(folder.path() / "w.exr", linear);
    const std::string exr = read_file(folder.path() / "w.exr");
    const std::string png = encode_png8({.width = 2, .height = 1, .rgb = std::vector<std::uint8_t>(6, 255)});
    for (const char* name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.tga", "a.gif", "a"}) {
        INFO(name);
        CHECK(read(name, exr, TextureContent::Color).texels[1] == glm::vec4(0.5f, 0.25f, 0.75f, 1.0f));
        CHECK(read(name, png, TextureContent::Color).texels[1] == glm::vec4(1.0f));
        std::vector<std::string> warnings;
        CHECK(read_environment_map(folder.write(name, exr), 2.0f, 0.0f, warnings).texels[1] ==
              glm::vec3(1.0f, 0.5f, 1.5f));
        CHECK(warnings.empty());
        CHECK(read_linear(folder.path() / name).pixels == linear.pixels);
        CHECK_THAT(input_error([&] { read_linear(folder.write(name, png)); }),
                   contains("expected a linear picture") && contains("(png)"));
    }
    std::vector<std::string> warnings;
    CHECK_THAT(input_error([&] { read_texture("gone.png", TextureContent::Color, true, warnings); }),
               contains("gone.png"));
}

TEST_CASE("Names of images stay in the folder") {
    CHECK(path_inside("s", "a/b.png") == std::filesystem::path("s/a/b.png"));
    CHECK(path_inside("s", "a\\b.png") == std::filesystem::path("s/a/b.png"));
    for (const char* outside : {"", "/a.png", "../a.png", "a/../../b.png", "C:\\a.png", "..\\a.png"})
        CHECK(path_inside("s", outside).empty());
}

TEST_CASE("Links stay in the folder, too") {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const fs::path outside = folder.write("outside/a.png", "");
    const fs::path scene = folder.write("scene/sub/a.png", "").parent_path().parent_path();
    fs::create_symlink("sub/a.png", scene / "inside.png");
    fs::create_symlink(outside, scene / "file.png");
    fs::create_symlink("../outside", scene / "folder");
    fs::create_symlink("../outside/gone.png", scene / "gone.png");
    fs::create_symlink("loop.png", scene / "loop.png");
    CHECK(path_inside(scene, "inside.png") == scene / "inside.png");
    CHECK(path_inside(scene, "new.png") == scene / "new.png");
    for (const char* name : {"file.png", "folder/a.png", "gone.png"}) {
        INFO(name);
        CHECK(path_inside(scene, name).empty());
    }
    // A folder that is reached by a link itself, and one that begins like another.
    fs::create_directory_symlink(scene, folder.path() / "link");
    CHECK(path_inside(folder.path() / "link", "inside.png") == folder.path() / "link/inside.png");
    (void)folder.write("scene2/a.png", "");
    fs::create_symlink("../scene2/a.png", scene / "beside.png");
    CHECK(path_inside(scene, "beside.png").empty());
}

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
