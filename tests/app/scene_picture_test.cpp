// Pictures of `inspect` and `trace` by the drawing code of the viewer, from a shell.
#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::json;

ProgramResult inspect_pixel(const std::string& output, const Arguments& more) {
    return run_program(joined({"inspect", "cornell", "-o", output, "--size", "48x48", "--pixel", "24,36", "--spp",
                               "20", "--volumes", "60", "--bins", "64", "--threads", "1"},
                              more));
}

std::size_t pixels_that_differ(const ByteImage& a, const ByteImage& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3)
        count += std::equal(a.rgb.begin() + static_cast<std::ptrdiff_t>(i),
                            a.rgb.begin() + static_cast<std::ptrdiff_t>(i + 3),
                            b.rgb.begin() + static_cast<std::ptrdiff_t>(i))
                     ? 0
                     : 1;
    return count;
}

std::set<std::array<std::uint8_t, 3>> colors_in(const ByteImage& image, glm::ivec2 low, glm::ivec2 high) {
    std::set<std::array<std::uint8_t, 3>> colors;
    for (int y = low.y; y < std::min(high.y, image.height); ++y)
        for (int x = low.x; x < std::min(high.x, image.width); ++x) {
            const auto i = 3 * static_cast<std::size_t>(y * image.width + x);
            colors.insert({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
        }
    return colors;
}

}  // namespace

TEST_CASE("the history of a volume has its figures at every key frame, and ends without a difference to the end") {
    const TempDir folder;
    const ProgramResult result = inspect_pixel(folder / "h.json", {"--history", "--truth-samples", "64"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const json history = json::parse(read_all(folder / "h.json"));
    CHECK(history["schema"] == "pathlight.history/1");
    const json& frames = history["frames"];
    REQUIRE(frames.size() >= 17);  // after each of the first 16 passes, then after the 20th
    CHECK(frames.front()["passes"] == 1);
    CHECK(frames.back()["passes"] == 20);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (i > 0) CHECK(frames[i]["passes"] > frames[i - 1]["passes"]);
        for (const char* figure : {"table_divergence", "mixture_divergence"})
            CHECK(frames[i][figure][1] <= frames[i][figure][2]);
    }
    CHECK(frames.back()["divergence_to_end"] == 0.0);
    CHECK(frames.back()["variation_to_end"] == 0.0);
    CHECK(frames.front()["variation_to_end"] > 0.0);
    // Learning comes nearer to the light: the intervals of first and last frame do not meet.
    CHECK(frames.front()["table_divergence"][1] > frames.back()["table_divergence"][2]);

    const ProgramResult again = inspect_pixel(folder / "h.csv", {"--history", "--truth-samples", "64"});
    REQUIRE(again.code == 0);
    std::istringstream rows(read_all(folder / "h.csv"));
    std::string row;
    std::size_t count = 0;
    while (std::getline(rows, row)) {
        CHECK(std::count(row.begin(), row.end(), ',') == 11);
        ++count;
    }
    CHECK(count == frames.size() + 1);
}

TEST_CASE("keeping the history changes nothing that is learned") {
    const TempDir folder;
    REQUIRE(inspect_pixel(folder / "h.json", {"--history", "--save-field", folder / "h.field"}).code == 0);
    REQUIRE(inspect_pixel(folder / "x.json", {"--save-field", folder / "x.field"}).code == 0);
    CHECK(read_all(folder / "h.field") == read_all(folder / "x.field"));
}

TEST_CASE(
    "the discs of a hemisphere have the colors of its cells below the lines about it, and the same at every run") {
    const TempDir folder;
    REQUIRE(inspect_pixel(folder / "x.png", {}).code == 0);
    ImageMetadata metadata;
    const ByteImage image = read_png8(folder / "x.png", &metadata);
    CHECK(image.width >= 2 * 520);
    CHECK(image.height >= 2 * 520);
    CHECK(text_of(metadata, "method") == "reinforcement");
    REQUIRE(inspect_pixel(folder / "again.png", {}).code == 0);
    CHECK(read_png8(folder / "again.png").rgb == image.rgb);
    const std::set<std::array<std::uint8_t, 3>> colors = colors_in(image, {24, 210}, {24 + 520, 210 + 520});
    CHECK(colors.size() > 20);  // a fourth of the cells at least differ
    // In the place of the lines there are letters, in shades of one color.
    CHECK(colors_in(image, {24, 24}, {300, 42}).size() > 5);
}

TEST_CASE("with the truth there are four discs") {
    const TempDir folder;
    REQUIRE(inspect_pixel(folder / "x.png", {"--truth", "--truth-samples", "64"}).code == 0);
    const ByteImage image = read_png8(folder / "x.png");
    CHECK(image.height >= 2 * 380);
    for (const glm::ivec2 disc :
         {glm::ivec2(24, 282), glm::ivec2(527, 282), glm::ivec2(24, 734), glm::ivec2(527, 734)})
        CHECK(colors_in(image, disc + 100, disc + 280).size() > 5);
}

TEST_CASE("as a PNG the gain is the picture with marks") {
    const TempDir folder;
    REQUIRE(run_program({"trace", "door", "--size", "64x48", "--spp", "4", "--method", "reinforcement", "--gain",
                         folder / "gain.png"})
                .code == 0);
    REQUIRE(run_program({"render", "door", "--size", "64x48", "--spp", "4", "--method", "reinforcement", "-o",
                         folder / "x.png"})
                .code == 0);
    const ByteImage image = read_png8(folder / "gain.png");
    REQUIRE(image.width == 64);
    const std::size_t marked = pixels_that_differ(image, read_png8(folder / "x.png"));
    CHECK(marked > 12 * 3);        // of twelve tiles, of 16 x 16 pixels
    CHECK(marked < 12 * 10 * 10);  // of a tile, with its shadow
}

TEST_CASE("shapes are drawn over the scene, the same at every run") {
    const TempDir folder;
    std::vector<ByteImage> images;
    for (const std::string name : {"lobe", "dome", "flowers"}) {
        const std::string file = folder / (name + ".png");
        const ProgramResult result = inspect_pixel(file, {"--drawn", name});
        CAPTURE(result.err);
        REQUIRE(result.code == 0);
        images.push_back(read_png8(file));
        CHECK(images.back().width == 48);
        REQUIRE(inspect_pixel(folder / "again.png", {"--drawn", name}).code == 0);
        CHECK(read_png8(folder / "again.png").rgb == images.back().rgb);
    }
    CHECK(pixels_that_differ(images[0], images[1]) > 10);
    CHECK(pixels_that_differ(images[0], images[2]) > 100);
}

TEST_CASE("a shape is a picture, and no other one") {
    const TempDir folder;
    CHECK(inspect_pixel(folder / "x.json", {"--drawn", "lobe"}).code == 2);
    CHECK(inspect_pixel(folder / "x.png", {"--drawn", "lobe", "--history"}).code == 2);
    const ProgramResult unknown = inspect_pixel(folder / "x.png", {"--drawn", "cone"});
    CHECK(unknown.code == 2);
    CHECK(unknown.err.find("expected disc, lobe, dome or flowers, got 'cone'") != std::string::npos);
    CHECK(folder.names().empty());
}

TEST_CASE("the lines of traced paths go into a PNG beside the text") {
    const TempDir folder;
    const auto trace = [](const char* samples, const Arguments& more) {
        Arguments arguments{"trace",    "cornell", "--size",   "48x48",   "--pixel", "24,36",
                            "--sample", samples,   "--method", "default", "--nee",   "on"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments);
    };
    const ProgramResult result = trace("0-7", {"-o", folder / "lines.png"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    CHECK(trace("0-7", {}).out == result.out);
    REQUIRE(trace("0", {"-o", folder / "one.png"}).code == 0);
    CHECK(pixels_that_differ(read_png8(folder / "lines.png"), read_png8(folder / "one.png")) > 20);
    CHECK(trace("0", {"-o", folder / "lines.exr"}).code == 2);
}

}  // namespace pl::test
