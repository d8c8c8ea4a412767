// Image files of all kinds: told apart by their bytes, upright, and refused if they are broken.
#include "core/io/decode_image.h"

#include <array>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <stb_image_write.h>

#include "core/io/files.h"
#include "core/io/image.h"
#include "core/io/line_reader.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/image_bytes.h"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::four_bytes;
using pl::test::hdr;
using pl::test::input_error;
using pl::test::loads_or_refuses;
using pl::test::TemporaryFolder;
using pl::test::tga;

namespace {

void append(void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

/// Red of the texels, from 0 to 255.
std::vector<int> bytes_of(const DecodedImage& image) {
    std::vector<int> bytes;
    for (const glm::vec4& texel : image.texels) bytes.push_back(static_cast<int>(std::lround(255.0f * texel.x)));
    return bytes;
}

/// The rows white black black and white white white.
std::string bmp_of_two_rows(int bits, bool from_top) {
    const std::array<std::array<bool, 3>, 2> picture{{{true, false, false}, {true, true, true}}};
    const std::size_t palette = bits <= 8 ? 8 : 0;
    std::string bytes = "BM" + std::string(8, '\0') + four_bytes(static_cast<std::uint32_t>(54 + palette), false);
    bytes += four_bytes(40, false) + four_bytes(3, false) + four_bytes(from_top ? 0xfffffffeu : 2u, false);
    bytes += std::string("\x01\x00", 2) + static_cast<char>(bits) + std::string(25, '\0');
    bytes += std::string("\x00\x00\x00\x00\xff\xff\xff\x00", palette);
    for (const std::size_t row : from_top ? std::array<std::size_t, 2>{0, 1} : std::array<std::size_t, 2>{1, 0}) {
        std::string line;
        unsigned packed = 0;
        for (const bool is_white : picture[row]) {
            if (bits < 8)
                packed = packed << bits | (is_white ? 1u : 0u);
            else
                line +=
                    std::string(static_cast<std::size_t>(bits / 8), is_white ? (bits == 8 ? '\x01' : '\xff') : '\0');
        }
        if (bits == 1) line += static_cast<char>(packed << 5);
        if (bits == 4) line += {static_cast<char>(packed >> 4), static_cast<char>(packed << 4)};
        line.resize((line.size() + 3) / 4 * 4);
        bytes += line;
    }
    return bytes;
}

DecodedImage decode(const std::string& bytes) {
    std::vector<std::string> warnings;
    DecodedImage image = decode_image(bytes, "a.image", warnings);
    CHECK(image.texels.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    return image;
}

}  // namespace

TEST_CASE("The bytes of an image decide its kind, whatever its name") {
    const TemporaryFolder folder;
    const LinearImage linear{.width = 1, .height = 1, .pixels = {glm::vec3(0.5f, 0.25f, 0.75f)}};
    write_pfm(folder.path() / "w.pfm", linear);
    write_exr(folder.path() / "w.exr", linear);
    const std::string rgb("\x80\x40\xc0", 3);
    std::string jpeg, bmp;
    REQUIRE(stbi_write_jpg_to_func(append, &jpeg, 1, 1, 3, rgb.data(), 100) != 0);
    REQUIRE(stbi_write_bmp_to_func(append, &bmp, 1, 1, 3, rgb.data()) != 0);
    for (const std::string& bytes :
         {encode_png8({.width = 1, .height = 1, .rgb = {0x80, 0x40, 0xc0}}), jpeg, bmp,
          tga(1, 1, std::string("\xc0\x40\x80\xff", 4)), hdr(1, 1, std::string("\x80\x40\xc0\x80", 4)),
          read_file(folder.path() / "w.pfm"), read_file(folder.path() / "w.exr")}) {
        INFO(in_quotes(bytes, 8));
        const DecodedImage image = decode(bytes);
        REQUIRE(image.texels.size() == 1);
        CHECK(image.texels[0].x == Approx(0.5).margin(0.02));
        CHECK(image.texels[0].y == Approx(0.25).margin(0.02));
        CHECK(image.texels[0].z == Approx(0.75).margin(0.02));
    }
}

TEST_CASE("PFM files of one channel are gray") {
    const std::string pfm = std::string("Pf 2 1 -1\n") + std::string("\x00\x00\x00\x3f\x00\x00\x80\x3e", 8);
    const DecodedImage image = decode(pfm);
    REQUIRE(image.texels.size() == 2);
    CHECK(image.texels[0] == glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
    CHECK(image.texels[1] == glm::vec4(0.25f, 0.25f, 0.25f, 1.0f));
}

// The texels 10 20 30 in the first row, 40 50 60 in the second.
TEST_CASE("TGA files of all orientations are upright") {
    struct Case {
        int descriptor;
        std::vector<int> texels;
    };
    for (const Case& one : {Case{0x00, {40, 50, 60, 10, 20, 30}}, Case{0x10, {60, 50, 40, 30, 20, 10}},
                            Case{0x20, {10, 20, 30, 40, 50, 60}}, Case{0x30, {30, 20, 10, 60, 50, 40}}}) {
        for (const int kind : {3, 11, 1, 9}) {  // gray, in runs, with a palette, both
            INFO("descriptor " << one.descriptor << ", kind " << kind);
            std::string bytes = tga(3, 2, "");
            bytes[2] = static_cast<char>(kind);
            bytes[16] = 8;
            bytes[17] = static_cast<char>(one.descriptor);
            if (kind == 1 || kind == 9) {
                bytes[1] = 1;
                bytes[5] = 64;  // entries
                bytes[7] = 24;
                for (int i = 0; i < 64; ++i) bytes += std::string(3, static_cast<char>(i));
            }
            if (kind > 8) bytes += '\x05';  // six texels, each by itself
            for (const int value : one.texels) bytes += static_cast<char>(value);
            CHECK(bytes_of(decode(bytes)) == std::vector<int>{10, 20, 30, 40, 50, 60});
            if (bytes[1] != 1) continue;
            bytes[3] = 7;
            CHECK_THAT(input_error([&] { decode(bytes); }), contains("palette"));
        }
    }
}

TEST_CASE("BMP files of all depths are upright, from the bottom up and from the top down") {
    for (const int bits : {1, 4, 8, 16, 24, 32}) {
        for (const bool from_top : {false, true}) {
            INFO(bits << " bits, " << (from_top ? "from the top" : "from the bottom"));
            const std::string bytes = bmp_of_two_rows(bits, from_top);
            const std::vector<int> values = bytes_of(decode(bytes));
            CHECK(values == std::vector<int>{255, 0, 0, 255, 255, 255});
            std::string runs = bytes;
            runs[30] = 1;
            CHECK_THAT(input_error([&] { decode(runs); }), contains("RLE"));
        }
    }
}

// The decoder fills missing data with black or gray: 23 bytes made a texture of 25 million texels.
TEST_CASE("Images that end too early are refused, wherever they are cut") {
    constexpr int kWidth = 13;
    constexpr int kHeight = 6;
    std::string rgb;
    for (int i = 0; i < 3 * kWidth * kHeight; ++i) rgb += static_cast<char>(i * 7);
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
        CHECK(decode(file.bytes).texels.size() >= 6);
        CHECK(decode(file.bytes + "more").texels.size() >= 6);
        for (std::size_t size = 0; size < file.bytes.size() - file.filling; ++size) {
            INFO("cut to " << size << " of " << file.bytes.size() << " bytes");
            CHECK_THAT(input_error([&] { decode(file.bytes.substr(0, size)); }),
                       contains("ends too early") || contains("damaged") || contains("expected an image"));
        }
    }
    std::string promised = tga(100, 100, "\xff\x50\x50\x50\x50");
    promised[2] = 10;
    CHECK_THAT(input_error([&] { decode(promised); }), contains("ends too early"));
}

TEST_CASE("Files that are no images are refused with a reason") {
    const std::string png = encode_png8({.width = 2, .height = 2, .rgb = std::vector<std::uint8_t>(12, 7)});
    const auto refused = [](const std::string& bytes) { return input_error([&] { decode(bytes); }); };
    CHECK_THAT(refused("text"), contains("a.image: expected an image") && contains("a file of another kind"));
    CHECK_THAT(refused(png.substr(0, 20)), contains("damaged png"));
    CHECK_THAT(refused(hdr(1000, 1000, "ab")), contains("damaged"));
    CHECK_THAT(refused("GIF89a"), contains("expected an image") && contains("a GIF image"));
    CHECK_THAT(refused(std::string("RIFF\x10\0\0\0WEBPVP8 ", 16)), contains("a WebP image"));
    CHECK_THAT(refused("version https://git-lfs.github.com/spec/v1\n"), contains("Git LFS"));
    CHECK_THAT(refused(""), contains("an empty file"));
    const auto sized = [&](std::uint32_t width, std::uint32_t height) {
        return png.substr(0, 16) + four_bytes(width, true) + four_bytes(height, true) + png.substr(24);
    };
    for (const auto& [width, height] : {std::pair{20000u, 1u}, {16000u, 16000u}, {30000u, 30000u}, {0x7fffffffu, 1u}})
        CHECK_THAT(refused(sized(width, height)), contains(fmt::format("a texture of {}x{}", width, height)));
    std::string bad_data = png;
    bad_data.replace(png.find("IDAT") + 4, 4, "\xff\xff\xff\xff");
    CHECK_THAT(refused(bad_data), contains("damaged png") && !contains("SOI") && !contains("unknown"));
}

TEST_CASE("Damaged images of all kinds load or are refused") {
    const TemporaryFolder folder;
    const LinearImage linear{.width = 3, .height = 2, .pixels = std::vector<glm::vec3>(6, glm::vec3(0.5f))};
    write_pfm(folder.path() / "w.pfm", linear);
    std::mt19937 random(7);
    write_exr(folder.path() / "w.exr", linear);
    for (const std::string& whole : {encode_png8({.width = 5, .height = 3, .rgb = std::vector<std::uint8_t>(45, 99)}),
                                     tga(2, 2, std::string(16, 'x')), hdr(9, 2, std::string(72, '\x81')),
                                     read_file(folder.path() / "w.pfm"), read_file(folder.path() / "w.exr")}) {
        int loaded = 0;
        for (int trial = 0; trial < 600; ++trial) {
            std::string bytes = whole;
            if (trial % 2 == 0) {
                bytes.resize(random() % bytes.size());
            } else {
                for (int i = 0; i < 2; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
            }
            INFO(in_quotes(whole, 8) << " trial " << trial);
            loaded += loads_or_refuses([&] { decode(bytes); }) ? 1 : 0;
        }
        CHECK(loaded < 600);
    }
}
