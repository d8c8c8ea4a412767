// Scenes without a light, from a shell: lit by default in every subcommand, and black on request.
#include <algorithm>
#include <array>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::ordered_json;

/// Eight corners of a box and its six faces, as the text of an OBJ file; `before` vertices come first.
std::string box(int before, const std::vector<float>& low, const std::vector<float>& high) {
    std::ostringstream text;
    for (int i = 0; i < 8; ++i) {
        text << "v";
        for (std::size_t k = 0; k < 3; ++k) text << ' ' << ((i >> k & 1) != 0 ? high[k] : low[k]);
        text << '\n';
    }
    for (const auto& face :
         {std::array{1, 5, 7, 3}, {2, 4, 8, 6}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 3, 4, 2}, {5, 6, 8, 7}}) {
        text << "f";
        for (const int corner : face) text << ' ' << before + corner;
        text << '\n';
    }
    return text.str();
}

/// A table for which z is up.
std::string table() {
    return box(0, {-1, -1, 0}, {-0.8f, -0.8f, 1}) + box(8, {0.8f, -1, 0}, {1, -0.8f, 1}) +
           box(16, {-1, 0.8f, 0}, {-0.8f, 1, 1}) + box(24, {0.8f, 0.8f, 0}, {1, 1, 1}) +
           box(32, {-1, -1, 1}, {1, 1, 1.1f});
}

/// Models as files from elsewhere have them: without light, of any size and custom.
struct Foreign {
    std::string name;
    std::string text;
};
std::vector<Foreign> foreign_models() {
    return {{"cube", box(0, {-1, -1, -1}, {1, 1, 1})},
            {"table", table()},
            {"huge", box(0, {1e6f, 2e6f, 0}, {3e6f, 5e6f, 1e6f})},
            {"tiny", box(0, {0, 0, 0}, {1e-3f, 2e-3f, 1e-3f})},
            {"plane", "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n"},
            {"triangle", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
            {"pole", box(0, {0, 0, 0}, {0.1f, 9, 0.1f})}};
}

double mean_of(const ByteImage& picture) {
    double sum = 0.0;
    for (const std::uint8_t byte : picture.rgb) sum += byte;
    return sum / static_cast<double>(picture.rgb.size());
}

}  // namespace

TEST_CASE("models from elsewhere are neither black nor overexposed") {
    const TempDir folder;
    for (const Foreign& model : foreign_models()) {
        CAPTURE(model.name);
        write_all(folder / "a.obj", model.text);
        const ProgramResult result =
            run_program({"render", folder / "a.obj", "-o", folder / "x.png", "--size", "48x48", "--spp", "16"});
        CAPTURE(result.err);
        REQUIRE(result.code == 0);
        CHECK_THAT(result.err, contains("no light in this scene; by default: a sky with a soft sun"));
        const ByteImage picture = read_png8(folder / "x.png");
        CHECK(mean_of(picture) > 90.0);
        CHECK(mean_of(picture) < 190.0);
        const auto clipped = std::count(picture.rgb.begin(), picture.rgb.end(), std::uint8_t{255});
        CHECK(static_cast<double>(clipped) < 0.05 * static_cast<double>(picture.rgb.size()));
    }
}

TEST_CASE("Option --default-light off: black, and said so in every place") {
    const TempDir folder;
    write_all(folder / "a.obj", table());
    const ProgramResult result = run_program({"render", folder / "a.obj", "-o", folder / "x.png", "--size", "16x16",
                                              "--spp", "4", "--default-light", "off", "--stats", folder / "s.json"});
    REQUIRE(result.code == 0);
    CHECK_THAT(result.err, contains("no light in this scene: the picture is black"));
    ImageMetadata metadata;
    CHECK(mean_of(read_png8(folder / "x.png", &metadata)) == 0.0);
    CHECK(text_of(metadata, "light") == "none");
    CHECK_THAT(text_of(metadata, "command"), contains("--default-light off"));
    CHECK(ordered_json::parse(read_all(folder / "s.json"))["light"] == "none");
    CHECK_THAT(run_program({"info", folder / "a.obj", "--default-light", "off"}).out,
               contains("light      none: every picture is black"));
}

TEST_CASE("info and statistics name the light of a scene") {
    const TempDir folder;
    write_all(folder / "a.obj", table());
    CHECK_THAT(run_program({"info", folder / "a.obj"}).out,
               contains("light      default: a sky with a soft sun, +z is up") &&
                   contains("environment-map: the scene has no light of its own"));
    CHECK_THAT(run_program({"info", "cornell"}).out, contains("light      the scene's own"));
    const auto light_of = [&](const Arguments& more) {
        Arguments arguments{"info", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return ordered_json::parse(lines_of(run_program(arguments).out).back())["light"];
    };
    CHECK(light_of({folder / "a.obj"}) == "default");
    CHECK(light_of({folder / "a.obj", "--default-light", "off"}) == "none");
    CHECK(light_of({"cornell", "--default-light", "off"}) == "scene");

    REQUIRE(run_program({"render", folder / "a.obj", "-o", folder / "x.pfm", "--size", "8x8", "--spp", "1", "--stats",
                         folder / "s.json"})
                .code == 0);
    CHECK(ordered_json::parse(read_all(folder / "s.json"))["light"] == "default");
}

TEST_CASE("Option --up-axis decides the vertical axis of a model without a camera") {
    const TempDir folder;
    write_all(folder / "a.obj", table());
    const auto up_of = [&](const Arguments& more) {
        Arguments arguments{"info", folder / "a.obj", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return ordered_json::parse(lines_of(run_program(arguments).out).back())["camera"]["up"];
    };
    CHECK(up_of({}) == ordered_json::array({0.0, 0.0, 1.0}));
    CHECK(up_of({"--up-axis", "auto"}) == ordered_json::array({0.0, 0.0, 1.0}));
    CHECK(up_of({"--up-axis", "y"}) == ordered_json::array({0.0, 1.0, 0.0}));
    CHECK(up_of({"--up-axis", "x"}) == ordered_json::array({1.0, 0.0, 0.0}));
}

TEST_CASE("wrong choices of light and axis exit with 2, in every subcommand that opens a scene") {
    const TempDir folder;
    write_all(folder / "a.obj", table());
    for (const Arguments& command :
         {Arguments{"info", folder / "a.obj"}, Arguments{"render", folder / "a.obj", "-o", folder / "x.png"},
          Arguments{"inspect", folder / "a.obj", "-o", folder / "x.json", "--pixel", "1,1"},
          Arguments{"reference", folder / "a.obj", "-o", folder / "r"},
          Arguments{"bench", folder / "a.obj", "-o", folder / "b"}, Arguments{"view", folder / "a.obj"}}) {
        Arguments light = command;
        light.insert(light.end(), {"--default-light", "maybe"});
        check_refused(2, light, "--default-light: expected on or off, got 'maybe'");
        Arguments axis = command;
        axis.insert(axis.end(), {"--up-axis", "w"});
        check_refused(2, axis, "--up-axis: expected auto, x, y or z, got 'w'");
    }
    write_all(folder / "s.json", "{\"schema\": \"pathlight.scene/1\", \"obj\": \"a.obj\",\n"
                                 "\"settings\": {\"up-axis\": \"w\"}}");
    check_refused(3, {"info", folder / "s.json"}, "s.json:2");
}

}  // namespace pl::test
