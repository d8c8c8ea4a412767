// The statistics file: its keys, and plausible values.
#include <nlohmann/json.hpp>

#include "tests/app/stats_keys.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::ordered_json;

ordered_json stats_of(const Arguments& more) {
    const TempDir folder;
    const ProgramResult result = run_program(joined({"render", "cornell", "-o", folder / "x.pfm", "--stats",
                                                     folder / "s.json", "--size", "20x12", "--spp", "4", "-t", "2"},
                                                    more));
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return ordered_json::parse(read_all(folder / "s.json"));
}

}  // namespace

TEST_CASE("statistics have every key in its order, and plausible values") {
    for (const std::string method : {"default", "precomputed", "reinforcement"}) {
        CAPTURE(method);
        const ordered_json stats = stats_of({"--method", method, "--volumes", "60", "--bins", "64", "--nee", "off"});
        CHECK(keys_of(stats) == kStatsKeys);
        CHECK(keys_of(stats["seconds"]) == kSecondsKeys);
        CHECK(stats["schema"] == "pathlight.stats/1");
        CHECK(stats["scene"] == "cornell");
        CHECK(stats["scene_hash"].get<std::string>().size() == 16);
        CHECK(stats["method"] == method);
        CHECK(stats["view"] == "beauty");
        CHECK(stats["backend"] == "cpu");
        CHECK_FALSE(stats["device"].get<std::string>().empty());
        CHECK(stats["threads"] == 2);
        CHECK(stats["width"] == 20);
        CHECK(stats["height"] == 12);
        CHECK(stats["spp"] == 4);
        CHECK(stats["seed"] == 1);
        CHECK(stats["max_depth"] == 64);
        CHECK(stats["nee"] == false);
        CHECK(stats["paths"] == 20 * 12 * 4);
        CHECK(stats["segments"] >= stats["paths"]);
        CHECK(stats["shadow_rays"] == 0);
        CHECK(stats["zero_contribution_paths"] < stats["paths"]);
        CHECK(stats["zero_contribution_paths"] > 0);
        CHECK(stats["mean_path_length"].get<double>() ==
              Approx(stats["segments"].get<double>() / stats["paths"].get<double>()));
        CHECK(stats["invalid_samples"] == 0);
        CHECK(stats["escaped_paths"] <= stats["paths"]);
        CHECK(stats["mean_radiance"].size() == 3);
        CHECK(stats["effects_needed"].empty());
        CHECK(stats["effects_compiled"].empty());
        CHECK_THAT(stats["kernel"].get<std::string>(), contains(method));

        double sum = 0.0;
        for (const auto& [name, seconds] : stats["seconds"].items()) {
            CHECK(seconds.get<double>() >= 0.0);
            if (name != "total") sum += seconds.get<double>();
        }
        CHECK(stats["seconds"]["total"].get<double>() == Approx(sum));
        CHECK(stats["seconds"]["render"] > 0.0);
        CHECK((stats["seconds"]["precompute"] > 0.0) == (method == "precomputed"));
        CHECK((stats["seconds"]["learn"] > 0.0) == (method == "reinforcement"));
        CHECK((stats["seconds"]["place"] > 0.0) == (method != "default"));
    }
}

TEST_CASE("statistics of the field: null without one, complete with one") {
    CHECK(stats_of({})["field"].is_null());
    const ordered_json field = stats_of({"--method", "reinforcement", "--volumes", "60", "--bins", "64"})["field"];
    CHECK(keys_of(field) == kFieldKeys);
    CHECK(field["volumes"] >= 60);
    CHECK(field["bins"] == 64);
    CHECK(field["bytes"] > 60 * 64 * 4);
    CHECK(field["passes"] == 4);
    CHECK(field["records"] > 0);
    CHECK(field["added_volumes"] == 0);
}

TEST_CASE("statistics tell how many volumes refinement added") {
    const ordered_json field = stats_of({"--method", "reinforcement", "--volumes", "60", "--bins", "16", "--learn",
                                         "refine=0.5", "--spp", "17"})["field"];
    CHECK(field["added_volumes"] > 20);
    CHECK(field["added_volumes"] <= field["volumes"].get<int>() / 3);
}

TEST_CASE("statistics tell whether guiding pays, for methods that guide and may choose") {
    CHECK(stats_of({})["guiding"].is_null());
    CHECK(stats_of({"--method", "reinforcement", "--nee", "off"})["guiding"].is_null());
    CHECK(stats_of({"--method", "reinforcement", "--nee", "on", "--guiding", "always"})["guiding"].is_null());
    const ordered_json early = stats_of({"--method", "reinforcement", "--nee", "on", "--spp", "2"})["guiding"];
    CHECK(keys_of(early) == std::vector<std::string>{"pays", "variance_ratio", "variance_ratio_interval",
                                                     "unguided_passes", "guided_share"});
    CHECK(early["pays"] == true);
    CHECK(early["variance_ratio"].is_null());
    CHECK(early["variance_ratio_interval"].is_null());
    const ordered_json late =
        stats_of({"--method", "reinforcement", "--bsdf-fraction", "1", "--roulette", "albedo", "--volumes", "20",
                  "--nee", "on", "--spp", "20", "--size", "128x128"})["guiding"];
    CHECK(late["pays"] == false);
    CHECK(late["variance_ratio"] < 1.2);
    CHECK(late["variance_ratio"] > 0.8);
    CHECK(late["variance_ratio_interval"][0] < late["variance_ratio"]);
    CHECK(late["variance_ratio_interval"][1] > late["variance_ratio"]);
    CHECK(late["guided_share"] > 0.0);
    CHECK(late["guided_share"] < 1.0);
    CHECK(late["unguided_passes"] == 18);
}

TEST_CASE("statistics of next-event estimation") {
    const ordered_json stats = stats_of({"--nee", "on"});
    CHECK(stats["nee"] == true);
    CHECK(stats["shadow_rays"] > 0);
    CHECK(stats["effects_needed"] == ordered_json::array({"next-event-estimation"}));
    CHECK(stats["effects_compiled"] == ordered_json::array({"next-event-estimation"}));
    // Light samples find the lamp: fewer paths are black.
    CHECK(stats["zero_contribution_paths"] < stats_of({"--nee", "off"})["zero_contribution_paths"]);
}

TEST_CASE("the scene's hash follows the light, not the file's name or camera") {
    const TempDir folder;
    const auto hash_of = [&](const std::string& name, const std::string& obj, const std::string& more) {
        write_all(folder / (name + ".obj"), obj);
        write_all(folder / (name + ".json"),
                  "{\"schema\": \"pathlight.scene/1\", \"obj\": \"" + name + ".obj\"" + more + "}");
        const ProgramResult result = run_program({"info", folder / (name + ".json"), "--json"});
        REQUIRE(result.code == 0);
        return ordered_json::parse(lines_of(result.out).back())["scene_hash"].get<std::string>();
    };
    const std::string triangle = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
    const std::string sky = ", \"environment\": {\"radiance\": [2, 2, 2]}";
    const std::string elsewhere = ", \"camera\": {\"eye\": [0, 5, 9], \"target\": [0, 0, 0]}";
    const std::string hash = hash_of("a", triangle, sky);
    CHECK(hash_of("b", triangle, sky) == hash);
    CHECK(hash_of("a", triangle, sky + elsewhere) == hash);
    CHECK(hash_of("a", "v -1 -1 0\nv 1 -1 0\nv 0 1.0000001 0\nf 1 2 3\n", sky) != hash);
    CHECK(hash_of("a", triangle, ", \"environment\": {\"radiance\": [1, 1, 1]}") != hash);
    // The default light stands by the camera.
    CHECK(hash_of("a", triangle, "") != hash);
    CHECK(hash_of("a", triangle, elsewhere) != hash_of("a", triangle, ""));
}

}  // namespace pl::test
