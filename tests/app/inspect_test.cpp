// `pathlight inspect` from a shell.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::json;

Arguments inspect(const std::string& output, const Arguments& more) {
    return joined(
        {"inspect", "cornell", "-o", output, "--size", "32x32", "--spp", "4", "--volumes", "60", "--bins", "64"},
        more);
}

json inspected(const Arguments& more) {
    const TempDir folder;
    const ProgramResult result = run_program(inspect(folder / "x.json", more));
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    CHECK((folder.names() == std::vector<std::string>{"x.json"}));
    return json::parse(read_all(folder / "x.json"));
}

}  // namespace

TEST_CASE("an inspection has everything that was learned") {
    for (const std::string method : {"reinforcement", "precomputed"}) {
        CAPTURE(method);
        const json volume = inspected({"--pixel", "8,16", "--method", method});
        CHECK(volume["method"] == method);
        CHECK(volume["bins"] == 64);
        CHECK(volume["partial"] == false);
        CHECK(volume["position"].size() == 3);
        for (const char* key : {"radiance", "probability", "visits", "direction"}) CHECK(volume[key].size() == 64);
        double probability = 0.0;
        double visits = 0.0;
        for (std::size_t cell = 0; cell < 64; ++cell) {
            CHECK(volume["radiance"][cell].get<double>() >= 0.0);
            probability += volume["probability"][cell].get<double>();
            visits += volume["visits"][cell].get<double>();
            double length = 0.0;
            double cosine = 0.0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double d = volume["direction"][cell][axis].get<double>();
                length += d * d;
                cosine += d * volume["normal"][axis].get<double>();
            }
            CHECK(length == Approx(1.0).epsilon(1e-5));  // a few roundings of float
            CHECK(cosine > 0.0);
        }
        CHECK(probability == Approx(1.0).epsilon(1e-5));  // 64 roundings of float
        CHECK(visits > 0.0);
        CHECK(volume["mean_radiance"] > 0.0);
    }
}

TEST_CASE("the same place by pixel and by point is the same volume") {
    // The camera looks along +z at the back wall, z = 559.2, which faces it. A pixel of 33 covers
    // 2 * 1359.2 * tan(fov / 2) / 33 = 29.42 there, and the one 7 above the middle shows y = 273 + 7 * 29.42 = 478.9.
    const json by_pixel = inspected({"--size", "33x33", "--pixel", "16,9"});
    CHECK(by_pixel["normal"] == json::array({0.0, 0.0, -1.0}));
    const json by_point = inspected({"--size", "33x33", "--at", "278,478.9,559.2,0,0,-1"});
    CHECK(by_point["volume"] == by_pixel["volume"]);
    CHECK(by_point["radiance"] == by_pixel["radiance"]);
    // In front of the wall, without a normal: the wall is the closest surface.
    CHECK(inspected({"--at", "278,478.9,500"})["volume"] == by_pixel["volume"]);
}

TEST_CASE("an inspection is the same for the same seed") {
    const json first = inspected({"--pixel", "16,28", "-t", "1"});
    CHECK(inspected({"--pixel", "16,28", "-t", "2"}) == first);
    CHECK(inspected({"--pixel", "16,28", "--seed", "2"})["radiance"] != first["radiance"]);
}

TEST_CASE("the table has a row per cell with the numbers of the JSON file") {
    const TempDir folder;
    REQUIRE(run_program(inspect(folder / "x.csv", {"--pixel", "16,28"})).code == 0);
    const json volume = inspected({"--pixel", "16,28"});
    const std::vector<std::string> lines = lines_of(read_all(folder / "x.csv"));
    REQUIRE(lines.size() == 65);
    CHECK(lines[0] == "cell,row,column,dx,dy,dz,radiance,probability,visits");
    for (std::size_t cell = 0; cell < 64; ++cell) {
        std::istringstream stream(lines[cell + 1]);
        std::vector<double> numbers;
        for (std::string number; std::getline(stream, number, ',');) numbers.push_back(std::stod(number));
        REQUIRE(numbers.size() == 9);
        CHECK(numbers[0] == static_cast<double>(cell));
        CHECK(numbers[1] == static_cast<double>(cell / 8));
        CHECK(numbers[2] == static_cast<double>(cell % 8));
        CHECK(static_cast<float>(numbers[6]) == volume["radiance"][cell].get<float>());
        CHECK(static_cast<float>(numbers[7]) == volume["probability"][cell].get<float>());
        CHECK(numbers[8] == volume["visits"][cell].get<double>());
    }
}

TEST_CASE("the light that reaches the volume comes with it on request") {
    const Arguments place{"--pixel", "16,28", "--truth", "--truth-samples", "64"};
    const json volume = inspected(place);
    const json truth = volume["truth"];
    CHECK(truth["paths_per_cell"] == 64);
    CHECK(truth["invalid_paths"] == 0);
    CHECK(truth["target_light"] == "left to paths");
    for (const char* key : {"radiance", "radiance_error", "target", "product", "mixture"})
        CHECK(truth[key].size() == 64);
    for (const char* key : {"table_divergence", "mixture_divergence"})
        CHECK(truth[key]["low"].get<double>() <= truth[key]["high"].get<double>());
    CHECK(inspected(place)["truth"] == truth);
    CHECK(inspected({"--pixel", "16,28"}).count("truth") == 0);

    const TempDir folder;
    Arguments more = place;
    REQUIRE(run_program(inspect(folder / "x.csv", more)).code == 0);
    const std::vector<std::string> lines = lines_of(read_all(folder / "x.csv"));
    REQUIRE(lines.size() == 65);
    CHECK(std::count(lines[0].begin(), lines[0].end(), ',') == 13);
    CHECK(std::count(lines[1].begin(), lines[1].end(), ',') == 13);
}

TEST_CASE("a place without a volume is told before any training") {
    const TempDir folder;
    const auto refused = [&](const Arguments& place, const std::string& message) {
        Arguments arguments{"inspect", "cornell", "-o", folder / "x.json", "--spp", "1000000000"};
        arguments.insert(arguments.end(), place.begin(), place.end());
        const ProgramResult result = run_program(arguments);
        CAPTURE(place, result.err);
        CHECK(result.code == 1);
        CHECK_THAT(result.err, contains(message));
    };
    // Beside the box no surface is visible; no surface faces diagonally.
    refused({"--pixel", "0,0", "--eye", "278,273,-5000"}, "nothing is seen there");
    refused({"--at", "278,273,559,0.577,0.577,0.577"}, "no radiance volume");
    CHECK(folder.names().empty());
}

}  // namespace pl::test
