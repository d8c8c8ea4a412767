// Images as textures: decoding, kinds, limits, and files that are broken.
#include "core/io/texture_file.h"

#include <cmath>
#include <limits>
#include <random>

#include <stb_image_write.h>

#include "core/io/files.h"
#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;
using pl::test::loads_or_refuses;
using pl::test::TemporaryFolder;

namespace {

std::string four_bytes(std::uint32_t value, bool big_endian) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * (big_endian ? 3 - i : i) & 0xffu);
    return bytes;
}

/// Uncompressed, 32 bits per texel: blue, green, red, alpha; from the top row down.
std::string tga(int width, int height, const std::string& texels) {
    std::string bytes(18, '\0');
    bytes[2] = 2;
    bytes[12] = static_cast<char>(width);
    bytes[14] = static_cast<char>(height);
    bytes[16] = 32;
    bytes[17] = 0x28;
    return bytes + texels;
}

/// Radiance picture, uncompressed: mantissas and the common exponent.
std::string hdr(int width, int height, const std::string& rgbe) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) +
           "\n" + rgbe;
}

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

// The decoder would wait for ever for the end of a run of length zero.
TEST_CASE("Coded lines of HDR files are whole, or the file is refused") {
    const auto coded = [](const std::string& runs) { return hdr(8, 1, std::string("\x02\x02\x00\x08", 4) + runs); };
    const std::string run("\x88\x80", 2);                                         // eight times the same
    const std::string singles = std::string("\x08", 1) + std::string(8, '\x80');  // eight, each by itself
    const TextureDescription texture =
        read("a.hdr", coded(run + singles + run + std::string("\x88\x81", 2)), TextureContent::Color);
    REQUIRE(texture.texels.size() == 8);
    for (const glm::vec4& texel : texture.texels) CHECK(texel == glm::vec4(1.0f));
    const std::string nothing(1, '\0');
    const std::string too_long("\x89\x80", 2);
    for (const std::string& last : {nothing, too_long, std::string("\x88", 1), std::string(), singles.substr(0, 5)}) {
        const TemporaryFolder folder;
        std::vector<std::string> warnings;
        const auto path = folder.write("a.hdr", coded(run + run + run + last));
        CHECK_THAT(input_error([&] { read_texture(path, TextureContent::Color, true, warnings); }),
                   contains("damaged"));
    }
}

// The decoder fills missing data with black or gray: 23 bytes made a texture of 25 million texels.
TEST_CASE("Images that end too early are refused, wherever they are cut") {
    constexpr int kWidth = 13;
    constexpr int kHeight = 6;
    std::string rgb;
    for (int i = 0; i < 3 * kWidth * kHeight; ++i) rgb += static_cast<char>(i * 7);
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    std::string jpeg, bmp, coded_tga;
    REQUIRE(stbi_write_jpg_to_func(append, &jpeg, kWidth, kHeight, 3, rgb.data(), 80) != 0);
    REQUIRE(stbi_write_bmp_to_func(append, &bmp, kWidth, kHeight, 3, rgb.data()) != 0);
    REQUIRE(stbi_write_tga_to_func(append, &coded_tga, kWidth, kHeight, 3, rgb.data()) != 0);
    struct File {
        std::string name, bytes;
        std::size_t filling;  ///< bytes of padding at the end
    };
    for (const File& file : {File{"a.jpg", jpeg, 0}, File{"a.bmp", bmp, kWidth % 4}, File{"a.tga", coded_tga, 0},
                             File{"a.tga", tga(3, 2, std::string(4 * 6, '\x50')), 0}}) {
        INFO(file.name);
        CHECK(read(file.name, file.bytes, TextureContent::Color).texels.size() >= 6);
        CHECK(read(file.name, file.bytes + "more", TextureContent::Color).texels.size() >= 6);
        for (std::size_t size = 0; size < file.bytes.size() - file.filling; ++size) {
            INFO("cut to " << size << " of " << file.bytes.size() << " bytes");
            CHECK_THAT(input_error([&] { read(file.name, file.bytes.substr(0, size), TextureContent::Color); }),
                       contains("ends too early") || contains("damaged") || contains("not a file of this kind"));
        }
    }
    std::string promised = tga(100, 100, "\xff\x50\x50\x50\x50");
    promised[2] = 10;
    CHECK_THAT(input_error([&] { read("a.tga", promised, TextureContent::Color); }), contains("ends too early"));
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

TEST_CASE("Files that are no images are refused with a reason") {
    const std::string png = encode_png8({.width = 2, .height = 2, .rgb = std::vector<std::uint8_t>(12, 7)});
    const auto refused = [](const std::string& name, const std::string& bytes) {
        return input_error([&] { read(name, bytes, TextureContent::Color); });
    };
    CHECK_THAT(refused("a.png", "text"), contains("a.png") && contains("not a file of this kind"));
    CHECK_THAT(refused("a.jpg", png), contains("not a file of this kind"));
    CHECK_THAT(refused("a.png", png.substr(0, 20)), contains("damaged"));
    CHECK_THAT(refused("a.hdr", hdr(1000, 1000, "ab")), contains("damaged"));
    CHECK_THAT(refused("a.gif", "GIF89a"), contains("expected an image") && contains(".gif"));
    CHECK_THAT(refused("a", png), contains("without suffix"));
    CHECK_THAT(refused("a.tga", ""), contains("damaged"));
    const std::string size = four_bytes(20000, true) + four_bytes(1, true);
    CHECK_THAT(refused("a.png", png.substr(0, 16) + size + png.substr(24)), contains("20000x1"));
    const std::string area = four_bytes(16000, true) + four_bytes(16000, true);
    CHECK_THAT(refused("a.png", png.substr(0, 16) + area + png.substr(24)), contains("16000x16000"));
    std::vector<std::string> warnings;
    CHECK_THAT(input_error([&] { read_texture("gone.png", TextureContent::Color, true, warnings); }),
               contains("gone.png"));
}

TEST_CASE("Damaged images of all kinds load or are refused") {
    struct File {
        std::string name, bytes;
    };
    const TemporaryFolder folder;
    const LinearImage linear{.width = 3, .height = 2, .pixels = std::vector<glm::vec3>(6, glm::vec3(0.5f))};
    write_pfm(folder.path() / "w.pfm", linear);
    std::mt19937 random(7);
    for (const File& file :
         {File{"a.png", encode_png8({.width = 5, .height = 3, .rgb = std::vector<std::uint8_t>(45, 99)})},
          File{"a.tga", tga(2, 2, std::string(16, 'x'))}, File{"a.hdr", hdr(9, 2, std::string(72, '\x81'))},
          File{"a.pfm", read_file(folder.path() / "w.pfm")}}) {
        int loaded = 0;
        for (int trial = 0; trial < 600; ++trial) {
            std::string bytes = file.bytes;
            if (trial % 2 == 0) {
                bytes.resize(random() % bytes.size());
            } else {
                for (int i = 0; i < 2; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
            }
            INFO(file.name << " trial " << trial);
            loaded += loads_or_refuses([&] { read(file.name, bytes, TextureContent::Color); }) ? 1 : 0;
        }
        CHECK(loaded < 600);
    }
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
