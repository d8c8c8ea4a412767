// Radiance HDR: runs of either kind, all orientations, and headers as programs write them.
#include "core/io/image.h"

#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;

namespace {

struct Decoded {
    LinearImage image;
    std::vector<std::string> warnings;
};

Decoded decode_picture(const std::string& bytes) {
    Decoded result;
    result.image = decode_hdr(bytes, {.path = "a.hdr", .warnings = &result.warnings});
    return result;
}

const std::string kHeader = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

/// A texel of radiance `mantissa` / 128 in all channels.
std::string texel(int mantissa) { return std::string(3, static_cast<char>(mantissa)) + '\x81'; }

/// Red of the texels, in units of 1/128.
std::vector<int> reds(const LinearImage& image) {
    std::vector<int> values;
    for (const glm::vec3& pixel : image.pixels) values.push_back(static_cast<int>(pixel.x * 128.0f));
    return values;
}

}  // namespace

TEST_CASE("HDR files of all orientations are upright") {
    // The scanlines of the picture
    //   128 129 130
    //   131 132 133
    // in the order of each orientation.
    struct Case {
        const char* size;
        std::vector<int> texels;
    };
    for (const Case& one :
         {Case{"-Y 2 +X 3", {128, 129, 130, 131, 132, 133}}, Case{"-Y 2 -X 3", {130, 129, 128, 133, 132, 131}},
          Case{"+Y 2 +X 3", {131, 132, 133, 128, 129, 130}}, Case{"+Y 2 -X 3", {133, 132, 131, 130, 129, 128}},
          Case{"+X 3 -Y 2", {128, 131, 129, 132, 130, 133}}, Case{"+X 3 +Y 2", {131, 128, 132, 129, 133, 130}},
          Case{"-X 3 -Y 2", {130, 133, 129, 132, 128, 131}}, Case{"-X 3 +Y 2", {133, 130, 132, 129, 131, 128}}}) {
        INFO(one.size);
        std::string bytes = kHeader + one.size + "\n";
        for (const int mantissa : one.texels) bytes += texel(mantissa);
        const Decoded got = decode_picture(bytes);
        CHECK(got.image.width == 3);
        CHECK(got.image.height == 2);
        CHECK(reds(got.image) == std::vector<int>{128, 129, 130, 131, 132, 133});
        CHECK(got.warnings.empty());
    }
}

TEST_CASE("HDR files with the run lengths of old are read") {
    const auto run = [](int count) { return std::string("\x01\x01\x01", 3) + static_cast<char>(count); };
    const auto decoded = [](int width, const std::string& texels) {
        return reds(decode_picture(kHeader + "-Y 1 +X " + std::to_string(width) + "\n" + texels).image);
    };
    CHECK(decoded(4, texel(128) + run(2) + texel(200)) == std::vector<int>{128, 128, 128, 200});
    // Runs directly behind each other are the digits of one count, the lowest first.
    std::vector<int> many(1 + 4 + 2 * 256, 128);
    many.push_back(200);
    CHECK(decoded(static_cast<int>(many.size()), texel(128) + run(4) + run(2) + texel(200)) == many);
    // A texel in between ends the count; runs of nothing are allowed.
    CHECK(decoded(6, texel(128) + run(1) + texel(130) + run(1) + run(0) + texel(140) + texel(150)) ==
          std::vector<int>{128, 128, 130, 130, 140, 150});
    const auto refused = [&](int width, const std::string& texels) {
        CHECK_THAT(input_error([&] { decoded(width, texels); }), contains("damaged"));
    };
    refused(4, run(4));                                                              // nothing to repeat
    refused(4, texel(128) + run(4));                                                 // longer than the line
    refused(9, texel(128) + run(0) + run(0) + run(0) + run(0) + run(0) + texel(1));  // too many digits
    refused(4, texel(128) + run(2));                                                 // too short
    refused(4, texel(128) + "\x01\x01");
}

TEST_CASE("Lines of HDR files have run lengths of either kind") {
    const std::string coded = std::string("\x02\x02\x00\x08", 4) + "\x88\x80\x88\x80\x88\x80\x88\x81";
    std::string plain;
    for (int i = 0; i < 8; ++i) plain += texel(130 + i);
    CHECK(reds(decode_picture(kHeader + "-Y 2 +X 8\n" + coded + plain).image) ==
          std::vector<int>{128, 128, 128, 128, 128, 128, 128, 128, 130, 131, 132, 133, 134, 135, 136, 137});
}

TEST_CASE("Headers of HDR files as programs write them") {
    const auto decoded = [](const std::string& header) {
        return decode_picture(header + "-Y 1 +X 1\n" + texel(128));
    };
    for (const char* header : {"#?RGBE\n\n", "#?RADIANCE\n\n", "#?AUTOPANO\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n",
                               "#?RADIANCE\n# made by hand\nGAMMA=1\nEXPOSURE=          1.0000000000000\n\n"}) {
        INFO(header);
        const Decoded got = decoded(header);
        CHECK(reds(got.image) == std::vector<int>{128});
        CHECK(got.warnings.empty());
    }
    const Decoded exposed = decoded("#?RADIANCE\nEXPOSURE=2\nEXPOSURE=4\nCOLORCORR=1 0.5 1\n\n");
    CHECK(reds(exposed.image) == std::vector<int>{128});
    REQUIRE(exposed.warnings.size() == 2);
    CHECK_THAT(exposed.warnings[0], contains("a.hdr: its exposure of 8 is left out"));
    CHECK_THAT(exposed.warnings[1], contains("correction of colors"));
    CHECK_THAT(input_error([&] { decoded("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n"); }),
               contains("expected the format 32-bit_rle_rgbe, got '32-bit_rle_xyze'"));
    for (const char* size : {"-Y 1 -Y 1\n", "-Y 1\n", "-Y one +X 1\n", "Y 1 X 1\n", ""})
        CHECK_THAT(input_error([&] { decode_picture(kHeader + size + texel(128)); }),
                   contains("damaged: expected the size"));
    CHECK_THAT(input_error([&] { decode_picture(kHeader + "-Y 100000 +X 100000\n"); }), contains("100000x100000"));
    CHECK_THAT(input_error([&] { decode_picture(kHeader + "-Y 16000 +X 16000\nabcd"); }), contains("truncated"));
}

TEST_CASE("Coded lines of HDR files are whole, or the file is refused") {
    const auto coded = [](const std::string& runs) {
        return kHeader + "-Y 1 +X 8\n" + std::string("\x02\x02\x00\x08", 4) + runs;
    };
    const std::string run("\x88\x80", 2);                                         // eight times the same
    const std::string singles = std::string("\x08", 1) + std::string(8, '\x80');  // eight, each by itself
    const LinearImage image = decode_picture(coded(run + singles + run + std::string("\x88\x81", 2))).image;
    REQUIRE(image.pixels.size() == 8);
    for (const glm::vec3& pixel : image.pixels) CHECK(pixel == glm::vec3(1.0f));
    const std::string nothing(1, '\0');
    const std::string too_long("\x89\x80", 2);
    for (const std::string& last : {nothing, too_long, std::string("\x88", 1), std::string(), singles.substr(0, 5)})
        CHECK_THAT(input_error([&] { decode_picture(coded(run + run + run + last)); }), contains("damaged"));
}

TEST_CASE("HDR files of other primaries are converted") {
    const auto decoded = [](const std::string& line) {
        return decode_picture("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + line + "\n-Y 1 +X 1\n\x80\x40\x20\x81");
    };
    const glm::vec3 stored = decoded("").image.pixels[0];
    for (const char* usual : {"PRIMARIES=0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333\n",
                              "PRIMARIES=.64 .33 .3 .6 .15 .06 .3127 .329\n", "PRIMARIES=0 0 0 0 0 0 0 0\n"}) {
        const Decoded got = decoded(usual);
        CHECK(got.image.pixels[0] == stored);
        CHECK(got.warnings.empty());
    }
    const Decoded wide = decoded("PRIMARIES=0.713 0.293 0.165 0.830 0.128 0.044 0.32168 0.33767\n");
    CHECK(wide.image.pixels[0].x > stored.x);
    CHECK_THAT(wide.warnings.at(0), contains("its primaries are not those of sRGB: converted"));
    CHECK_THAT(decoded("PRIMARIES=wide\n").warnings.at(0), contains("expected eight numbers for its primaries"));
}
