// `pathlight trace --why` from a shell: the noise of a pixel, by which technique and bounce.
// `pathlight trace --gain` from a shell: marks of gains by tiles.
#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::json;

Arguments why(const Arguments& more) {
    return joined(
        {"trace", "door", "--pixel", "24,20", "--why", "--size", "48x40", "--volumes", "60", "--bins", "64"}, more);
}

json noise(Arguments arguments) {
    arguments.push_back("--json");
    const ProgramResult result = run_program(arguments);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const std::vector<std::string> lines = lines_of(result.out);
    REQUIRE(lines.size() == 1);
    return json::parse(lines.front());
}

double sum_of(const json& shares) {
    double sum = 0.0;
    for (const auto& share : shares) sum += share[0].get<double>();
    return sum;
}

}  // namespace

TEST_CASE("the noise of a pixel is that of both methods, and its shares add up") {
    const Arguments settings{"--method", "reinforcement", "--nee", "off", "--spp", "12", "--why-samples", "1024"};
    const json event = noise(why(settings));
    CHECK(event["event"] == "noise");
    CHECK(event["pixel"] == json({24, 20}));
    CHECK(event["passes"] == 12);
    REQUIRE(event["estimates"].size() == 2);
    CHECK(event["estimates"][0]["method"] == "default");
    CHECK(event["estimates"][1]["method"] == "reinforcement");
    for (const json& estimate : event["estimates"]) {
        CHECK(estimate["paths"] == 1024);
        CHECK(estimate["variance"][0].get<double>() > 0.0);
        CHECK(estimate["by_bounces"].size() == 9);
        for (const char* shares : {"by_technique", "by_bounces", "by_light"})
            CHECK(sum_of(estimate[shares]) == Approx(1.0).epsilon(1e-9));
        CHECK(estimate["by_technique"]["light"][0] == 0.0);
    }
    CHECK(event["estimates"][0]["by_technique"]["bsdf"][0].get<double>() == Approx(1.0));
    CHECK(event["estimates"][1]["by_technique"]["field"][0].get<double>() > 0.3);
    const json& gain = event["gain"];
    CHECK(gain["gain"].get<double>() ==
          Approx(gain["samples"][0].get<double>() * gain["cost"][0].get<double>()).epsilon(1e-9));

    // All but times is the same again.
    const json again = noise(why(settings));
    CHECK(again["estimates"][1]["by_bounces"] == event["estimates"][1]["by_bounces"]);
    CHECK(again["gain"]["samples"] == event["gain"]["samples"]);
}

TEST_CASE("default alone has no gain, and light samples have a share of its noise") {
    const json event = noise(why({"--method", "default", "--nee", "on", "--why-samples", "1024"}));
    REQUIRE(event["estimates"].size() == 1);
    CHECK(event["gain"].is_null());
    CHECK(event["passes"] == 0);
    CHECK(event["estimates"][0]["by_technique"]["light"][0].get<double>() > 0.0);
}

TEST_CASE("without JSON the noise is text, and ends with its mark") {
    const ProgramResult result =
        run_program(why({"--method", "reinforcement", "--spp", "8", "--why-samples", "512"}));
    REQUIRE(result.code == 0);
    const std::vector<std::string> lines = lines_of(result.out);
    CHECK(lines.front() == "pixel 24,20: 512 paths by each method");
    CHECK(lines.back().rfind("reinforcement ", 0) == 0);
    CHECK(result.out.find("  noise by bounces\n") != std::string::npos);
}

TEST_CASE("a path and the noise of a pixel exclude each other") {
    const ProgramResult result = run_program(why({"--sample", "0"}));
    CHECK(result.code == 2);
    CHECK(result.err.find("--why in place of --sample") != std::string::npos);
    CHECK(run_program(why({"--why-samples", "12"})).code == 2);
    CHECK(run_program(why({"-o", "lines.png"})).code == 2);
}

namespace {

using nlohmann::json;

ProgramResult traced_gain(const TempDir& folder, const std::string& gain, const Arguments& more) {
    return run_program(joined({"trace", "door", "--size", "64x48", "--spp", "8", "--gain", folder / gain}, more));
}

}  // namespace

TEST_CASE("the gain of a picture comes by tiles") {
    const TempDir folder;
    const ProgramResult result = traced_gain(folder, "gain.json", {"--method", "reinforcement"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const json gain = json::parse(read_all(folder / "gain.json"));
    CHECK(gain["columns"] == 4);
    CHECK(gain["rows"] == 3);
    REQUIRE(gain["tiles"].size() == 12);
    for (const json& tile : gain["tiles"]) {
        const std::string mark = tile["mark"];
        CHECK((mark == "gains" || mark == "loses" || mark == "no difference" || mark == "undecided"));
    }
    CHECK(gain["picture"]["gain"].get<double>() > 0.0);
}

TEST_CASE("a gain needs a guided method, the whole picture, and a known kind of file") {
    const TempDir folder;
    const auto refusal = [&](const std::string& file, const Arguments& more) {
        const ProgramResult result = traced_gain(folder, file, more);
        CHECK(result.code == 2);
        return result.err;
    };
    CHECK(refusal("g.json", {"--method", "default"}).find("--gain: compares a guided method") != std::string::npos);
    CHECK(refusal("g.json", {"--method", "reinforcement", "--pixel", "1,1"}).find("whole picture") !=
          std::string::npos);
    CHECK(refusal("g.exr", {"--method", "reinforcement"}).find(".json or .png") != std::string::npos);
}

TEST_CASE("a field that learns from two passes has two in the statistics of a longer picture") {
    const TempDir folder;
    const std::string stats = folder / "stats.json";
    REQUIRE(run_program({"render", "door", "-o", folder / "x.pfm", "--size", "32x32", "--spp", "9", "--method",
                         "reinforcement", "--learn", "passes=2", "--stats", stats})
                .code == 0);
    const json all = json::parse(read_all(stats));
    CHECK(all["spp"] == 9);
    CHECK(all["field"]["passes"] == 2);
}

}  // namespace pl::test
