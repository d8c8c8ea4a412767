// `pathlight render` from a shell: pictures, repeatability, limits, interruption.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <set>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "core/kernel/film/heat_color.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::json;

Arguments render(const std::string& output, const Arguments& more = {}) {
    return joined({"render", "cornell", "-o", output, "--size", "24x16", "--spp", "3"}, more);
}

std::string rendered_bytes(const Arguments& more) {
    const TempDir folder;
    const ProgramResult result = run_program(render(folder / "x.pfm", more));
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return read_all(folder / "x.pfm");
}

std::string metadata_value(const ImageMetadata& metadata, const std::string& name) {
    for (const auto& [key, value] : metadata)
        if (key == name) return value;
    return "";
}

/// A rendering ended by a signal only.
Arguments endless(const std::string& output) {
    return program({"render", "cornell", "-o", output, "--size", "32x32", "--spp", "1000000000", "--json"});
}

const std::vector<std::string> kMethods{"default", "precomputed", "reinforcement"};
const std::vector<std::string> kViews{"beauty",     "direct", "radiance-map", "voronoi",    "normal",
                                      "albedo",     "depth",  "visits",       "irradiance", "entropy",
                                      "bsdf-share", "change", "unvisited"};
const std::set<std::string> kLearnedViews{"radiance-map", "visits", "irradiance", "entropy",
                                          "bsdf-share",   "change", "unvisited"};

}  // namespace

TEST_CASE("a crop shows its part of the picture, and its command repeats its bits") {
    const TempDir folder;
    const Arguments whole{"render", "cornell", "--size", "64x48", "--spp", "256", "-o", folder / "whole.exr"};
    REQUIRE(run_program(whole).code == 0);
    Arguments part = whole;
    part.back() = folder / "part.exr";
    part.insert(part.end(), {"--crop", "30,4,20,32"});
    const ProgramResult result = run_program(part);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    ImageMetadata metadata;
    const LinearImage all = read_exr(folder / "whole.exr");
    const LinearImage crop = read_exr(folder / "part.exr", &metadata);
    REQUIRE(crop.width == 20);
    REQUIRE(crop.height == 32);
    // Other numbers, same expectation: pixel by pixel within the noise, and none of it moved.
    double squared = 0.0, difference = 0.0;
    for (int y = 0; y < crop.height; ++y)
        for (int x = 0; x < crop.width; ++x) {
            const glm::dvec3 own(crop.pixels[static_cast<std::size_t>(20 * y + x)]);
            const glm::dvec3 its(all.pixels[static_cast<std::size_t>(64 * (y + 4) + x + 30)]);
            squared += glm::dot(its, its);
            difference += glm::dot(own - its, own - its);
        }
    CHECK(difference < 0.003 * squared);
    const std::string command = metadata_value(metadata, "command");
    REQUIRE(run_shell(command).code == 0);
    CHECK(read_exr(folder / "part.exr").pixels == crop.pixels);
}

TEST_CASE("without roulette paths end by their depth alone, and the picture is the same on the mean") {
    const TempDir folder;
    const auto stats = [&](const std::string& roulette, const std::string& method) {
        const ProgramResult result = run_program(
            {"render", "cornell", "--size", "32x32", "--spp", "64", "--max-depth", "8", "--roulette", roulette,
             "--method", method, "--nee", "off", "-o", folder / "x.pfm", "--stats", folder / "s.json"});
        CAPTURE(result.err);
        REQUIRE(result.code == 0);
        return json::parse(read_all(folder / "s.json"));
    };
    for (const std::string& method : kMethods) {
        const json off = stats("off", method);
        const json spare = stats("spare", method);
        CAPTURE(method, off.dump(), spare.dump());
        CHECK(off.at("roulette") == "off");
        CHECK(spare.at("roulette") == "spare");
        CHECK(off.at("mean_path_length") > spare.at("mean_path_length"));
        if (method == "default")
            CHECK(std::abs(off.at("mean_radiance")[0].get<double>() / spare.at("mean_radiance")[0].get<double>() -
                           1.0) < 0.1);
    }
    const ProgramResult paths = run_program({"trace", "cornell", "--size", "32x32", "--pixel", "16,24", "--sample",
                                             "0-255", "--roulette", "off", "--max-depth", "4", "--json"});
    REQUIRE(paths.code == 0);
    CHECK(paths.out.find("\"end\":\"roulette\"") == std::string::npos);
    CHECK(paths.out.find("\"end\":\"depth-limit\"") != std::string::npos);
}

TEST_CASE("every method renders every view") {
    const TempDir folder;
    for (const std::string& method : kMethods)
        for (const std::string& view : kViews) {
            if (method == "default" && kLearnedViews.contains(view)) continue;
            const ProgramResult result =
                run_program({"render", "cornell", "-o", folder / "x.png", "--size", "8x8", "--spp", "4", "--method",
                             method, "--view", view, "--volumes", "50"});
            CAPTURE(method, view, result.err);
            CHECK(result.code == 0);
            const ByteImage image = read_png8(folder / "x.png");
            CHECK(image.width == 8);
            CHECK(image.height == 8);
            // The picture is neither black nor constant: the box fills it.
            CHECK(std::set<std::uint8_t>(image.rgb.begin(), image.rgb.end()).size() > 2);
        }
}

TEST_CASE("heat maps: numbers in linear files, colors and their range in PNG") {
    const TempDir folder;
    const Arguments entropy{"--method", "reinforcement", "--view", "entropy", "--volumes", "50", "--bins", "64"};
    REQUIRE(run_program(render(folder / "x.exr", entropy)).code == 0);
    const LinearImage linear = read_exr(folder / "x.exr");
    const auto larger = [](const auto& a, const auto& b) { return a.x < b.x; };
    const float largest = std::max_element(linear.pixels.begin(), linear.pixels.end(), larger)->x;
    CHECK(largest > 3.0f);
    CHECK(largest <= 6.0f);

    const ProgramResult result = run_program(render(folder / "x.png", entropy));
    CAPTURE(result.out, result.err);
    REQUIRE(result.code == 0);
    CHECK_THAT(result.out + result.err, contains("range 0 to 6 bits"));
    ImageMetadata metadata;
    const ByteImage shown = read_png8(folder / "x.png", &metadata);
    CHECK(metadata_value(metadata, "range") == "0 to 6 bits");
    for (std::size_t i = 0; i < linear.pixels.size(); ++i) {
        // Red, green and blue of heat_color().
        const ByteColor color = heat_color(linear.pixels[i].x / 6.0f);
        REQUIRE(std::abs(shown.rgb[3 * i + 0] - color.r) <= 1);
        REQUIRE(std::abs(shown.rgb[3 * i + 1] - color.g) <= 1);
        REQUIRE(std::abs(shown.rgb[3 * i + 2] - color.b) <= 1);
    }
    const ProgramResult beauty = run_program(render(folder / "y.png"));
    CHECK((beauty.out + beauty.err).find("range") == std::string::npos);
}

TEST_CASE("same seed, same bytes, whatever the number of threads, and another seed, other bytes") {
    for (const std::string& method : kMethods)
        for (const std::string nee : {"off", "on"}) {
            CAPTURE(method, nee);
            const Arguments same{"--method", method, "--nee", nee, "--volumes", "50", "--seed", "5"};
            const auto with = [&](const Arguments& more) {
                Arguments all = same;
                all.insert(all.end(), more.begin(), more.end());
                return rendered_bytes(all);
            };
            const std::string one = with({"-t", "1"});
            CHECK(with({"-t", "1"}) == one);
            CHECK(with({"-t", "2"}) == one);
            CHECK(with({"-t", "7"}) == one);
            CHECK(with({"--seed", "6"}) != one);
        }
}

TEST_CASE("linear files hold the same numbers, and sizes need not be square") {
    const TempDir folder;
    REQUIRE(run_program(render(folder / "x.pfm")).code == 0);
    REQUIRE(run_program(render(folder / "x.exr")).code == 0);
    const LinearImage pfm = read_linear(folder / "x.pfm");
    const LinearImage exr = read_exr(folder / "x.exr");
    CHECK(pfm.width == 24);
    CHECK(pfm.height == 16);
    CHECK(exr.width == 24);
    CHECK((pfm.pixels == exr.pixels));
}

TEST_CASE("pictures hold the settings that they were made with") {
    const TempDir folder;
    ImageMetadata metadata;
    REQUIRE(run_program(render(folder / "x.png", {"--seed", "9", "--method", "reinforcement"})).code == 0);
    read_png8(folder / "x.png", &metadata);
    CHECK(metadata_value(metadata, "seed") == "9");
    CHECK(metadata_value(metadata, "spp") == "3");
    CHECK(metadata_value(metadata, "method") == "reinforcement");
    CHECK_THAT(metadata_value(metadata, "command"), contains("pathlight render cornell -o "));
    CHECK(metadata_value(metadata, "partial").empty());

    // The command in the picture makes the picture.
    std::filesystem::rename(folder / "x.png", folder / "first.png");
    REQUIRE(run_shell(metadata_value(metadata, "command")).code == 0);
    CHECK((read_png8(folder / "x.png").rgb == read_png8(folder / "first.png").rgb));
}

TEST_CASE("the camera of the command line is the camera of the picture") {
    const std::string scene = rendered_bytes({});
    CHECK(rendered_bytes({"--eye", "278,273,-800", "--target", "278,273,0", "--up", "0,1,0"}) == scene);
    CHECK(rendered_bytes({"--eye", "278,273,-700"}) != scene);
    CHECK(rendered_bytes({"--fov", "50"}) != scene);
    CHECK(rendered_bytes({"--target", "250,273,0"}) != scene);
    CHECK(rendered_bytes({"--up", "1,0,0"}) != scene);
    const TempDir folder;
    write_all(folder / "camera.json", R"({"eye": [278, 273, -700]})");
    CHECK(rendered_bytes({"--camera", folder / "camera.json"}) == rendered_bytes({"--eye", "278,273,-700"}));
}

TEST_CASE("display options change shown pictures and no linear ones") {
    const TempDir folder;
    REQUIRE(run_program(render(folder / "a.png")).code == 0);
    for (const Arguments& display :
         std::vector<Arguments>{{"--exposure", "2"}, {"--tonemap", "reinhard"}, {"--tonemap", "aces"}}) {
        REQUIRE(run_program(render(folder / "b.png", display)).code == 0);
        CHECK((read_png8(folder / "a.png").rgb != read_png8(folder / "b.png").rgb));
        CHECK(rendered_bytes(display) == rendered_bytes({}));
    }
}

TEST_CASE("rendering stops at the first limit that is met") {
    const TempDir folder;
    const auto spp_of = [&](const Arguments& limits) {
        Arguments arguments{"render", "cornell", "-o",      folder / "x.pfm",
                            "--size", "16x16",   "--stats", folder / "s.json"};
        arguments.insert(arguments.end(), limits.begin(), limits.end());
        REQUIRE(run_program(arguments).code == 0);
        return json::parse(read_all(folder / "s.json"))["spp"].get<long>();
    };
    CHECK(spp_of({}) == 64);
    CHECK(spp_of({"--spp", "5"}) == 5);
    CHECK(spp_of({"--spp", "5", "--time-limit", "10000"}) == 5);
    const long until_time = spp_of({"--spp", "1000000000", "--time-limit", "0.3"});
    CHECK(until_time >= 1);
    CHECK(until_time < 1000000000);
    CHECK(spp_of({"--time-limit", "0.000001"}) == 1);
}

TEST_CASE("rendering stops at a target error, and 5 tells that another limit came first") {
    const TempDir folder;
    const auto run = [&](const Arguments& more) {
        Arguments arguments{"render", "cornell", "-o",    folder / "x.pfm", "--nee",
                            "on",     "--size",  "32x32", "--stats",        folder / "s.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments);
    };
    const auto stats = [&] { return json::parse(read_all(folder / "s.json")); };

    const ProgramResult met = run({"--target-error", "0.02"});
    CAPTURE(met.out, met.err);
    CHECK(met.code == 0);
    CHECK_THAT(met.out, contains(", noise 0.0") && contains("(target 0.02)"));
    CHECK(stats()["ended_by"] == "target-error");
    CHECK(stats()["target_error"]["of"] == "noise");
    CHECK(stats()["target_error"]["relmse"] == 0.02);
    CHECK(stats()["target_error"]["measured"] <= 0.02);
    CHECK(stats()["spp"] >= 16);  // noise is not measured before

    const ProgramResult missed = run({"--target-error", "1e-9", "--spp", "5"});
    CHECK(missed.code == 5);
    CHECK_THAT(missed.err,
               contains("--target-error: expected noise of at most 1e-09") && contains("--spp was reached"));
    CHECK(stats()["ended_by"] == "spp");
    CHECK(read_linear(folder / "x.pfm").width == 32);  // the picture is written in either case
    CHECK(run({"--target-error", "1e-9", "--time-limit", "0.1"}).code == 5);
    CHECK(stats()["ended_by"] == "time-limit");
    // Within the target when another limit ends it: not missed. One sample has no halves, so its noise is unknown.
    CHECK(run({"--target-error", "1000", "--spp", "2"}).code == 0);
    CHECK(run({"--target-error", "1000", "--spp", "1"}).code == 5);
    CHECK(stats()["target_error"]["measured"].is_null());

    CHECK(run({"--spp", "2"}).code == 0);
    CHECK(stats()["target_error"].is_null());
}

TEST_CASE("an interruption writes the partial picture, marks it and exits with 130") {
    for (const std::string name : {"x.exr", "x.png", "x.pfm"}) {
        const TempDir folder;
        RunningProgram running(endless(folder / name));
        REQUIRE(running.wait_for_output("\"event\":\"progress\""));
        running.send(SIGINT);
        const ProgramResult result = running.wait();
        CAPTURE(name, result.err);
        CHECK(result.code == 130);
        CHECK_THAT(result.err, contains("partial"));
        CHECK_THAT(result.out, contains("\"interrupted\":true"));
        CHECK((folder.names() == std::vector<std::string>{name}));
        ImageMetadata metadata;
        if (name == "x.exr")
            CHECK(read_exr(folder / name, &metadata).width == 32);
        else if (name == "x.png")
            CHECK(read_png8(folder / name, &metadata).width == 32);
        else
            CHECK(read_linear(folder / name).width == 32);
        if (name != "x.pfm") {
            CHECK(metadata_value(metadata, "partial") == "true");
            CHECK(std::stol(metadata_value(metadata, "spp")) >= 1);
        }
    }
}

TEST_CASE("an interruption before the first sample still writes a marked picture") {
    const TempDir folder;
    RunningProgram running(program({"render", "cornell", "-o", folder / "x.exr", "--method", "precomputed",
                                    "--volumes", "20000", "--bins", "1024", "--size", "16x16", "--json", "-t", "1"}));
    REQUIRE(running.wait_for_output("\"event\":\"start\""));
    running.send(SIGTERM);
    const ProgramResult result = running.wait();
    CAPTURE(result.err);
    CHECK(result.code == 130);
    ImageMetadata metadata;
    CHECK(read_exr(folder / "x.exr", &metadata).width == 16);
    CHECK(metadata_value(metadata, "partial") == "true");
    CHECK(metadata_value(metadata, "spp") == "0");
}

TEST_CASE("a killed program leaves the old picture") {
    const TempDir folder;
    write_all(folder / "x.exr", "old");
    RunningProgram running(endless(folder / "x.exr"));
    REQUIRE(running.wait_for_output("\"event\":\"start\""));
    running.send(SIGKILL);
    CHECK(running.wait().code == 128 + SIGKILL);
    CHECK(read_all(folder / "x.exr") == "old");
    CHECK((folder.names() == std::vector<std::string>{"x.exr"}));
}

TEST_CASE("any working directory, relative paths, and an OBJ without a camera") {
    const TempDir folder;
    write_all(folder / "light.mtl", "newmtl light\nKe 1 1 1\n");
    write_all(folder / "my scene.obj", "mtllib light.mtl\nusemtl light\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    const ProgramSetup there{.folder = folder.path()};
    CHECK(run_program({"render", "my scene.obj", "-o", "x.pfm", "--size", "9x9", "--spp", "1"}, there).code == 0);
    // The camera frames it: the middle shows the light.
    CHECK(read_linear(folder / "x.pfm").pixels[40].x == 1.0f);
    CHECK(run_program({"render", "door", "-o", "y.png", "--size", "9x9", "--spp", "1"}, there).code == 0);
    CHECK(run_program({"info", "furnace"}, {.folder = "/"}).code == 0);
    CHECK((folder.names() == std::vector<std::string>{"light.mtl", "my scene.obj", "x.pfm", "y.png"}));
}

TEST_CASE("settings of a scene file are defaults that options override") {
    const TempDir folder;
    write_all(folder / "a.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
    write_all(folder / "a.json", R"({"schema": "pathlight.scene/1", "obj": "a.obj",
        "settings": {"size": "20x10", "spp": 2, "method": "reinforcement", "nee": true}})");
    const auto stats_of = [&](const Arguments& more) {
        Arguments arguments{"render", folder / "a.json", "-o", folder / "x.pfm", "--stats", folder / "s.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        REQUIRE(run_program(arguments).code == 0);
        return json::parse(read_all(folder / "s.json"));
    };
    const json plain = stats_of({});
    CHECK(plain["width"] == 20);
    CHECK(plain["height"] == 10);
    CHECK(plain["spp"] == 2);
    CHECK(plain["method"] == "reinforcement");
    CHECK(plain["nee"] == true);
    const json changed = stats_of({"--spp", "1", "--nee", "off", "--width", "40"});
    CHECK(changed["spp"] == 1);
    CHECK(changed["nee"] == false);
    CHECK(changed["height"] == 20);
}

}  // namespace pl::test
