// Pictures written and read back: floats bit by bit, bytes exactly, metadata too.
#include "core/io/image.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <thread>

#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::error_message;
using pl::test::input_error;
using pl::test::loads_or_refuses;
using pl::test::TemporaryFolder;

namespace {

/// Random bit patterns as floats, quiet NaN, infinities and denormals among them.
LinearImage noise(int width, int height) {
    LinearImage image{.width = width, .height = height, .pixels = {}};
    std::mt19937 random(99);
    for (int i = 0; i < width * height; ++i) {
        glm::vec3 pixel;
        for (int c = 0; c < 3; ++c) {
            const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
            pixel[c] = value == value ? value : std::numeric_limits<float>::quiet_NaN();
        }
        image.pixels.push_back(pixel);
    }
    image.pixels[0] = {std::numeric_limits<float>::infinity(), -0.0f, std::numeric_limits<float>::denorm_min()};
    return image;
}

bool same_bits(const LinearImage& a, const LinearImage& b) {
    return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

/// In the order of their names, by which EXR files sort them.
const ImageMetadata kMetadata = {{"empty", ""}, {"partial", "true"}, {"settings", "--method reinforcement --spp 64"}};

}  // namespace

TEST_CASE("EXR keeps every bit and the metadata") {
    const auto [width, height] = GENERATE(table<int, int>({{1, 1}, {3, 2}, {37, 51}, {1, 40}, {65, 1}}));
    const TemporaryFolder folder;
    const LinearImage image = noise(width, height);
    write_exr(folder.path() / "a.exr", image, kMetadata);
    ImageMetadata metadata;
    CHECK(same_bits(read_exr(folder.path() / "a.exr", &metadata), image));
    CHECK(metadata == kMetadata);
    CHECK(folder.file_count() == 1);
}

TEST_CASE("PFM keeps every bit, from the bottom row up") {
    const auto [width, height] = GENERATE(table<int, int>({{1, 1}, {3, 2}, {37, 51}}));
    const TemporaryFolder folder;
    const LinearImage image = noise(width, height);
    write_pfm(folder.path() / "a.pfm", image);
    CHECK(same_bits(read_linear(folder.path() / "a.pfm"), image));
    const std::string bytes = read_file(folder.path() / "a.pfm");
    const std::string header = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    REQUIRE(bytes.starts_with(header));
    // The first float in the file is the red of the lower left pixel.
    CHECK(std::memcmp(bytes.data() + header.size(), &image.pixels[static_cast<std::size_t>(width * (height - 1))],
                      12) == 0);
}

TEST_CASE("PFM of the other byte order") {
    const TemporaryFolder folder;
    const std::string bytes("PF 1 1 1.0\n\x3f\x80\x00\x00\xc0\x00\x00\x00\x00\x00\x00\x00", 23);
    CHECK(read_linear(folder.write("a.pfm", bytes)).pixels[0] == glm::vec3(1, -2, 0));
}

TEST_CASE("PNG keeps every byte and the metadata") {
    const TemporaryFolder folder;
    ByteImage image{.width = 19, .height = 7, .rgb = {}};
    for (int i = 0; i < 19 * 7 * 3; ++i) {
        image.rgb.push_back(static_cast<std::uint8_t>(i * 41));
    }
    write_png8(folder.path() / "a.png", image, kMetadata);
    ImageMetadata metadata;
    const ByteImage read = read_png8(folder.path() / "a.png", &metadata);
    CHECK(read.width == 19);
    CHECK(read.height == 7);
    CHECK(read.rgb == image.rgb);
    CHECK(metadata == kMetadata);
}

TEST_CASE("The text chunks of a PNG have the checksum of the standard") {
    const TemporaryFolder folder;
    write_png8(folder.path() / "a.png", {.width = 1, .height = 1, .rgb = {1, 2, 3}}, {{"Title", "x"}});
    // Length 7, type and data, then CRC-32 of "tEXtTitle\0x", computed independently.
    const std::string chunk("\x00\x00\x00\x07tEXtTitle\x00x\x29\x7e\x4d\x3a", 19);
    CHECK(read_file(folder.path() / "a.png").find(chunk) == 33);
}

TEST_CASE("The suffix decides the kind") {
    CHECK(image_kind("a/b.exr") == ImageKind::Exr);
    CHECK(image_kind("b.PFM") == ImageKind::Pfm);
    CHECK(image_kind("x.y.png") == ImageKind::Png);
    CHECK_THAT(error_message(ErrorKind::Usage, [] { image_kind("a.jpg"); }),
               contains("expected .exr, .pfm or .png, got .jpg"));
    CHECK_THAT(error_message(ErrorKind::Usage, [] { image_kind("a"); }), contains("got none"));
}

TEST_CASE("Pictures that cannot be written leave nothing behind") {
    const TemporaryFolder folder;
    const LinearImage image = noise(2, 2);
    const auto fails = [](auto&& write) { return error_message(ErrorKind::Runtime, write); };
    CHECK_THAT(fails([&] { write_exr(folder.path() / "gone/a.exr", image); }),
               contains("gone/a.exr: cannot be written"));
    CHECK_THAT(fails([&] { write_pfm(folder.path(), image); }), contains("it is a directory"));
    const ByteImage byte_image{.width = 1, .height = 1, .rgb = {1, 2, 3}};
    CHECK_THAT(fails([&] { write_png8(folder.path() / "gone/a.png", byte_image); }), contains("cannot be written"));
    CHECK_THAT(fails([&] { write_exr(folder.path() / "a.exr", {}); }), contains("a picture of 0x0"));
    CHECK_THAT(fails([&] {
                   write_pfm(folder.path() / "a.pfm", {.width = 2, .height = 2, .pixels = {{}, {}, {}}});
               }),
               contains("2x2 with 3"));
    CHECK_THAT(fails([&] { write_png8(folder.path() / "a.png", {.width = 1, .height = -1, .rgb = {}}); }),
               contains("1x-1"));
    CHECK(folder.file_count() == 0);
}

TEST_CASE("Files that are no pictures of their kind are refused") {
    const TemporaryFolder folder;
    const std::string path = folder.write("a", "something else entirely").string();
    CHECK_THAT(input_error([&] { read_exr(path); }), contains("not an EXR file"));
    CHECK_THAT(input_error([&] { decode_pfm(read_file(path), {.path = path}); }), contains("not a PFM file"));
    CHECK_THAT(input_error([&] { read_png8(path); }), contains("not a PNG file"));
    CHECK_THAT(input_error([&] { read_exr(folder.path() / "gone.exr"); }), contains("no such file"));
    CHECK_THAT(input_error([&] { read_linear(folder.write("b", "PF\n100000 100000\n-1\n")); }),
               contains("100000x100000 is not supported"));
    CHECK_THAT(input_error([&] { read_linear(folder.write("c", "PF\n-1 2\n-1\n")); }),
               contains("-1x2 is not supported"));
    CHECK_THAT(input_error([&] { read_linear(folder.write("d", "PF\n1 1\n0\nabcdabcdabcd")); }),
               contains("a scale other than 0"));
}

TEST_CASE("Truncated pictures are refused at every length") {
    const TemporaryFolder folder;
    write_pfm(folder.path() / "whole.pfm", noise(3, 2));
    write_png8(folder.path() / "whole.png", {.width = 2, .height = 2, .rgb = std::vector<std::uint8_t>(12, 7)},
               kMetadata);
    write_exr(folder.path() / "whole.exr", noise(5, 20), kMetadata);
    const std::string pfm = read_file(folder.path() / "whole.pfm");
    const std::string png = read_file(folder.path() / "whole.png");
    const std::string exr = read_file(folder.path() / "whole.exr");
    for (std::size_t size = 0; size < pfm.size(); ++size) {
        CHECK_FALSE(loads_or_refuses([&] { read_linear(folder.write("a.pfm", pfm.substr(0, size))); }));
    }
    for (std::size_t size = 0; size < png.size(); ++size) {
        // The decoder may do without the closing chunk and checksums, never without the pixels.
        loads_or_refuses([&] { read_png8(folder.write("a.png", png.substr(0, size))); });
    }
    for (std::size_t size = 0; size < exr.size(); ++size) {
        CHECK_FALSE(loads_or_refuses([&] { read_exr(folder.write("a.exr", exr.substr(0, size))); }));
    }
}

TEST_CASE("EXR files of half floats keep three digits, limit radiance that is too bright, and are smaller") {
    const TemporaryFolder folder;
    LinearImage image{.width = 64, .height = 64, .pixels = {}};
    for (int i = 0; i < 64 * 64; ++i) image.pixels.emplace_back(0.001f * static_cast<float>(i) + 0.1f);
    image.pixels[7] = glm::vec3(1.0e6f, std::numeric_limits<float>::quiet_NaN(), 65504.0f);
    write_exr(folder.path() / "half.exr", image, {{"a", "b"}}, ExrNumbers::Half);
    write_exr(folder.path() / "float.exr", image);
    ImageMetadata metadata;
    const LinearImage read = read_linear(folder.path() / "half.exr", &metadata);
    CHECK(text_of(metadata, "a") == "b");
    CHECK(text_of(metadata, "c").empty());
    REQUIRE(read.pixels.size() == image.pixels.size());
    CHECK(read.pixels[7].x == 65504.0f);
    CHECK(std::isnan(read.pixels[7].y));
    CHECK(read.pixels[7].z == 65504.0f);
    for (std::size_t i = 8; i < read.pixels.size(); ++i)  // half a unit in the eleventh bit
        REQUIRE(std::fabs(read.pixels[i].x - image.pixels[i].x) <= image.pixels[i].x / 2048.0f);
    CHECK(std::filesystem::file_size(folder.path() / "half.exr") <
          std::filesystem::file_size(folder.path() / "float.exr"));
}

TEST_CASE("image: a failure of the library without a reason is unknown") {
    // Reasons belong to a thread: a new one has none yet.
    std::string reason;
    std::thread([&] { reason = stb_failure(); }).join();
    CHECK(reason == "unknown");
}
