// EXR files as other programs write them: made by the library that defines the format.
#include "core/io/image.h"

#include <cmath>
#include <vector>

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>

#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using std::string_literals::operator""s;
using pl::test::contains;
using pl::test::input_error;
using pl::test::loads_or_refuses;
using pl::test::TemporaryFolder;

namespace {

constexpr int kWidth = 37;
constexpr int kHeight = 70;  // more than one block of any compression, and of tiles

using Names = std::vector<std::string>;

/// Smooth values that a half float holds; each channel has its own.
float value_of(int x, int y, std::size_t channel) {
    return 0.25f * static_cast<float>(channel + 1) + static_cast<float>(x) / 64.0f + static_cast<float>(y) / 128.0f;
}

/// Numbers of the channels of a file, of the type of each.
struct Planes {
    std::vector<std::vector<char>> bytes;
    Imf::FrameBuffer buffer;
};

template <class Number>
void store(std::vector<char>& bytes, float value) {
    const auto number = static_cast<Number>(value);
    const char* const from = reinterpret_cast<const char*>(&number);
    bytes.insert(bytes.end(), from, from + sizeof(Number));
}

void store(std::vector<char>& bytes, Imf::PixelType type, float value) {
    if (type == Imf::HALF) return store<half>(bytes, value);
    type == Imf::FLOAT ? store<float>(bytes, value) : store<std::uint32_t>(bytes, value);
}

/// The numbers of all channels of a header over a window.
void fill(Planes& planes, const Imf::Header& header, const Imath::Box2i& window) {
    std::size_t number = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel, ++number) {
        const Imf::PixelType type = channel.channel().type;
        std::vector<char>& bytes = planes.bytes.emplace_back();
        for (int y = window.min.y; y <= window.max.y; ++y)
            for (int x = window.min.x; x <= window.max.x; ++x) store(bytes, type, value_of(x, y, number));
        planes.buffer.insert(channel.name(), Imf::Slice::Make(type, bytes.data(), window, type == Imf::HALF ? 2 : 4));
    }
}

Imf::Header header_of(const Names& channels, Imf::PixelType type = Imf::FLOAT) {
    Imf::Header header(kWidth, kHeight);
    for (const std::string& name : channels) header.channels().insert(name, Imf::Channel(type));
    return header;
}

void write_lines(const std::filesystem::path& path, const Imf::Header& header) {
    Planes planes;
    fill(planes, header, header.dataWindow());
    Imf::OutputFile file(path.c_str(), header, 0);
    file.setFrameBuffer(planes.buffer);
    file.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
}

void write_tiles(const std::filesystem::path& path, Imf::Header header, Imf::LevelMode mode) {
    header.setTileDescription(Imf::TileDescription(16, 8, mode));
    Imf::TiledOutputFile file(path.c_str(), header, 0);
    for (int ly = 0; ly < file.numYLevels(); ++ly)
        for (int lx = 0; lx < file.numXLevels(); ++lx) {
            if (!file.isValidLevel(lx, ly)) continue;
            Planes planes;
            fill(planes, header, file.dataWindowForLevel(lx, ly));
            file.setFrameBuffer(planes.buffer);
            file.writeTiles(0, file.numXTiles(lx) - 1, 0, file.numYTiles(ly) - 1, lx, ly);
        }
}

/// Each of the headers is a part of lines with the same channel values.
void write_parts(const std::filesystem::path& path, const std::vector<Imf::Header>& headers) {
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()), false, 0);
    for (std::size_t i = 0; i < headers.size(); ++i) {
        Planes planes;
        fill(planes, headers[i], headers[i].dataWindow());
        Imf::OutputPart part(file, static_cast<int>(i));
        part.setFrameBuffer(planes.buffer);
        part.writePixels(kHeight);
    }
}

Imf::Header part_of(const std::string& name, const Names& channels) {
    Imf::Header header = header_of(channels);
    header.setName(name);
    header.setType(Imf::SCANLINEIMAGE);
    return header;
}

/// The largest difference from the channels of these numbers (a file sorts its channels by name).
float difference(const LinearImage& image, std::size_t red, std::size_t green, std::size_t blue) {
    float largest = 0.0f;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::vec3 right(value_of(x, y, red), value_of(x, y, green), value_of(x, y, blue));
            const glm::vec3 got = image.pixels[static_cast<std::size_t>(y * image.width + x)];
            for (int c = 0; c < 3; ++c) largest = std::max(largest, std::fabs(got[c] - right[c]));
        }
    return largest;
}

struct Read {
    LinearImage image;
    std::vector<std::string> warnings;
};

Read read(const std::filesystem::path& path) {
    Read result;
    result.image = read_linear(path, nullptr, &result.warnings);
    CHECK(result.image.pixels.size() ==
          static_cast<std::size_t>(result.image.width) * static_cast<std::size_t>(result.image.height));
    return result;
}

}  // namespace

TEST_CASE("EXR files of every compression are read") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    const auto type = GENERATE(Imf::HALF, Imf::FLOAT);
    // Those of a tolerance lose digits, of half floats or of floats.
    for (const auto& [compression, tolerance] :
         std::vector<std::pair<Imf::Compression, float>>{{Imf::NO_COMPRESSION, 0.0f},
                                                         {Imf::RLE_COMPRESSION, 0.0f},
                                                         {Imf::ZIPS_COMPRESSION, 0.0f},
                                                         {Imf::ZIP_COMPRESSION, 0.0f},
                                                         {Imf::PIZ_COMPRESSION, 0.0f},
                                                         {Imf::PXR24_COMPRESSION, 1e-4f},
                                                         {Imf::B44_COMPRESSION, 0.02f},
                                                         {Imf::B44A_COMPRESSION, 0.02f},
                                                         {Imf::DWAA_COMPRESSION, 0.02f},
                                                         {Imf::DWAB_COMPRESSION, 0.02f}}) {
        INFO("compression " << compression << ", type " << type);
        Imf::Header header = header_of({"R", "G", "B", "A"}, type);
        header.compression() = compression;
        write_lines(path, header);
        const Read got = read(path);
        CHECK(got.image.width == kWidth);
        CHECK(got.image.height == kHeight);
        CHECK(difference(got.image, 3, 2, 1) <= tolerance);
        CHECK(got.warnings.empty());
    }
}

TEST_CASE("EXR files in tiles, with and without smaller levels, show the largest one") {
    const TemporaryFolder folder;
    for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
        INFO("mode " << mode);
        write_tiles(folder.path() / "a.exr", header_of({"R", "G", "B"}), mode);
        const Read got = read(folder.path() / "a.exr");
        CHECK(difference(got.image, 2, 1, 0) == 0.0f);
        CHECK(got.warnings.empty());
    }
}

TEST_CASE("The lines of an EXR file may go up, and its window may begin anywhere") {
    const TemporaryFolder folder;
    Imf::Header header = header_of({"R", "G", "B"});
    header.lineOrder() = Imf::DECREASING_Y;
    write_lines(folder.path() / "up.exr", header);
    CHECK(difference(read(folder.path() / "up.exr").image, 2, 1, 0) == 0.0f);

    header.dataWindow() = Imath::Box2i({-5, 100}, {2, 103});
    write_lines(folder.path() / "window.exr", header);
    const Read got = read(folder.path() / "window.exr");
    CHECK(got.image.width == 8);
    CHECK(got.image.height == 4);
    CHECK(got.image.pixels[0].x == value_of(-5, 100, 2));
    CHECK(got.image.pixels[31].z == value_of(2, 103, 0));
    REQUIRE(got.warnings.size() == 1);
    CHECK_THAT(got.warnings[0], contains("data window"));
}

TEST_CASE("A single channel of an EXR file is gray") {
    const TemporaryFolder folder;
    struct Case {
        Names channels;
        std::size_t shown;
    };
    for (const Case& one : {Case{{"Y"}, 0}, Case{{"A", "Y"}, 1}, Case{{"Z"}, 0}, Case{{"height.V"}, 0},
                            Case{{"noise.Y", "noise.A"}, 1}}) {
        INFO(one.channels[0]);
        write_lines(folder.path() / "a.exr", header_of(one.channels));
        const Read got = read(folder.path() / "a.exr");
        CHECK(difference(got.image, one.shown, one.shown, one.shown) == 0.0f);
        CHECK(got.warnings.empty());
    }
}

TEST_CASE("Of the layers of an EXR file the picture is shown") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    // Channels without a prefix are the picture, whatever others there are.
    write_lines(path, header_of({"B", "G", "R", "albedo.B", "albedo.G", "albedo.R"}));
    Read got = read(path);
    CHECK(difference(got.image, 2, 1, 0) == 0.0f);
    CHECK(got.warnings.empty());
    // Blender: "Combined", though "AO" comes first.
    write_lines(path, header_of({"View.AO.B", "View.AO.G", "View.AO.R", "View.Combined.A", "View.Combined.B",
                                 "View.Combined.G", "View.Combined.R", "View.Depth.Z"}));
    got = read(path);
    CHECK(difference(got.image, 6, 5, 4) == 0.0f);
    REQUIRE(got.warnings.size() == 1);
    CHECK_THAT(got.warnings[0], contains("of its 2 layers") && contains("'View.Combined'"));
    write_lines(path, header_of({"beauty.b", "beauty.g", "beauty.r"}));
    got = read(path);
    CHECK(difference(got.image, 2, 1, 0) == 0.0f);
    CHECK(got.warnings.empty());
    write_lines(path, header_of({"diffuse.B", "diffuse.G", "diffuse.R", "gloss.B", "gloss.G", "gloss.R"}));
    got = read(path);
    CHECK(difference(got.image, 2, 1, 0) == 0.0f);
    REQUIRE(got.warnings.size() == 1);
    CHECK_THAT(got.warnings[0], contains("'diffuse'"));
}

TEST_CASE("Of the parts of an EXR file the first with a picture is shown") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    write_parts(path, {part_of("depth", {"Z"}), part_of("left", {"B", "G", "R"}), part_of("right", {"B", "G", "R"})});
    const Read got = read(path);
    CHECK(difference(got.image, 2, 1, 0) == 0.0f);
    REQUIRE(got.warnings.size() == 1);
    CHECK_THAT(got.warnings[0], contains("of its 2 layers") && contains("of part 2, 'left'"));
    write_parts(path, {part_of("depth", {"Z"}), part_of("picture", {"B", "G", "R"})});
    CHECK(read(path).warnings.empty());
}

TEST_CASE("EXR files of luminance and chroma are read") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    constexpr int kEvenWidth = 38;
    const std::vector<Imf::Rgba> pixels(kEvenWidth * kHeight, Imf::Rgba(0.5f, 0.25f, 0.75f, 1.0f));
    for (const Imf::RgbaChannels channels : {Imf::WRITE_YC, Imf::WRITE_YCA, Imf::WRITE_Y}) {
        {
            Imf::RgbaOutputFile file(path.c_str(), kEvenWidth, kHeight, channels);
            file.setFrameBuffer(pixels.data(), 1, kEvenWidth);
            file.writePixels(kHeight);
        }
        const Read got = read(path);
        REQUIRE(got.image.pixels.size() == pixels.size());
        // Luminance by the primaries of Rec. 709.
        const float gray = 0.2126f * 0.5f + 0.7152f * 0.25f + 0.0722f * 0.75f;
        const glm::vec3 right = channels == Imf::WRITE_Y ? glm::vec3(gray) : glm::vec3(0.5f, 0.25f, 0.75f);
        for (const std::size_t at : {std::size_t{0}, pixels.size() / 2, pixels.size() - 1})
            for (int c = 0; c < 3; ++c)  // the library rounds chroma when it writes
                CHECK(got.image.pixels[at][c] == Approx(right[c]).epsilon(0.01));
        CHECK(got.warnings.empty());
    }
}

// AP1 of ACES, and its matrix to linear sRGB by Bradford's adaptation.   [ACES, TB-2014-004; colour-science]
TEST_CASE("Colors of other primaries become those of sRGB, and white stays white") {
    const TemporaryFolder folder;
    const auto read_with = [&](const Imf::Chromaticities& space) {
        Imf::Header header = header_of({"R", "G", "B"});
        Imf::addChromaticities(header, space);
        write_lines(folder.path() / "a.exr", header);
        return read(folder.path() / "a.exr");
    };
    const Read same = read_with({});
    CHECK(same.warnings.empty());
    const Read got = read_with({{0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}});
    REQUIRE(got.warnings.size() == 1);
    CHECK_THAT(got.warnings[0], contains("its primaries are not those of sRGB: converted"));
    const glm::mat3 columns{
        {1.70505f, -0.13026f, -0.02400f}, {-0.62179f, 1.14080f, -0.12897f}, {-0.08326f, -0.01055f, 1.15297f}};
    for (std::size_t i = 0; i < got.image.pixels.size(); i += 97)
        CHECK(glm::length(got.image.pixels[i] - columns * same.image.pixels[i]) < 1e-4f);
    const Read none = read_with({{0, 0}, {0, 0}, {0, 0}, {0, 0}});
    CHECK(none.warnings.empty());
    CHECK(none.image.pixels == same.image.pixels);
    const Read wrong = read_with({{0.6f, 0.3f}, {0.6f, 0.3f}, {0.1f, 0.1f}, {0.3f, 0.3f}});
    CHECK_THAT(wrong.warnings.at(0), contains("primaries are those of no colors"));
    CHECK(wrong.image.pixels == same.image.pixels);
}

TEST_CASE("Alpha of EXR files is read beside their colors") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    const auto alpha_of = [&](const Names& names) {
        write_lines(path, header_of(names));
        std::vector<float> alpha;
        decode_exr(read_file(path), {.path = path, .alpha = &alpha});
        return alpha;
    };
    CHECK(alpha_of({"R", "G", "B"}).empty());
    for (const Names& names :
         {Names{"R", "G", "B", "A"}, Names{"a.R", "a.G", "a.B", "a.A", "b.B"}, Names{"Y", "A"}}) {
        const std::vector<float> alpha = alpha_of(names);  // the first channel in the order of names
        REQUIRE(alpha.size() == kWidth * kHeight);
        CHECK(alpha[0] == value_of(0, 0, 0));
        CHECK(alpha.back() == value_of(kWidth - 1, kHeight - 1, 0));
    }
}

TEST_CASE("EXR files without a picture are refused with what they have") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    write_lines(path, header_of({"Z", "ZBack"}));
    CHECK_THAT(input_error([&] { read(path); }), contains("expected the channels R, G and B") && contains("'ZBack'"));
    write_lines(path, header_of({"B", "G", "R"}, Imf::UINT));
    CHECK_THAT(input_error([&] { read(path); }), contains("'R' (whole numbers)"));
    Imf::Header header(4, 2);
    for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT, 2, 2));
    {
        const std::vector<float> numbers(2, 0.5f);
        Imf::FrameBuffer buffer;
        for (const char* name : {"R", "G", "B"})
            buffer.insert(
                name,
                Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(numbers.data())), 4, 8, 2, 2));
        Imf::OutputFile file(path.c_str(), header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(2);
    }
    CHECK_THAT(input_error([&] { read(path); }), contains("(subsampled)"));
}

TEST_CASE("Deep EXR files are refused") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    {
        Imf::Header header(2, 1);
        header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
        header.setType(Imf::DEEPSCANLINE);
        header.compression() = Imf::ZIPS_COMPRESSION;
        std::vector<unsigned> counts(2, 1);
        std::vector<float> numbers(2, 0.5f);
        std::vector<float*> samples{&numbers[0], &numbers[1]};
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 8));
        buffer.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()), sizeof(float*),
                                          2 * sizeof(float*), sizeof(float)));
        Imf::DeepScanLineOutputFile file(path.c_str(), header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(1);
    }
    CHECK_THAT(input_error([&] { read(path); }), contains("'Z' (deep)"));
}

TEST_CASE("EXR files with a text that is longer than the file are refused") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    write_exr(path, {.width = 1, .height = 1, .pixels = {glm::vec3(1.0f)}}, {{"note", "x"}});
    std::string bytes = read_file(path);
    bytes.replace(bytes.find("note\0string\0"s) + 12, 4, "\xff\xff\xff\x7f");
    CHECK_THAT(input_error([&] { read(folder.write("b.exr", bytes)); }), contains("its header is not whole"));
}

TEST_CASE("EXR files that promise more than they have are refused at once") {
    const TemporaryFolder folder;
    write_tiles(folder.path() / "tiles.exr", header_of({"R", "G", "B"}), Imf::ONE_LEVEL);
    write_lines(folder.path() / "lines.exr", header_of({"R", "G", "B"}));
    for (const char* name : {"tiles.exr", "lines.exr"}) {
        const std::string bytes = read_file(folder.path() / name);
        const std::size_t window = bytes.find(std::string("dataWindow\0box2i\0\x10\0\0\0", 21)) + 21;
        for (const std::string& corner : {std::string("\xff\xff\xff\x3f\xff\xff\xff\x3f", 8),     // 2^30 x 2^30
                                          std::string("\x24\x00\x00\x00\xff\xff\xff\x00", 8),     // 37 x 2^24
                                          std::string("\xff\x3f\x00\x00\xff\x3f\x00\x00", 8)}) {  // 16384 x 16384
            std::string huge = bytes;
            huge.replace(window + 8, 8, corner);
            INFO(name);
            CHECK_FALSE(loads_or_refuses([&] { read(folder.write("huge.exr", huge)); }));
        }
        for (std::size_t size = 0; size < bytes.size(); size += 97)
            CHECK_FALSE(loads_or_refuses([&] { read(folder.write("cut.exr", bytes.substr(0, size))); }));
    }
}
