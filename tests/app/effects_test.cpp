// Effects on the command line: the needed ones with their reasons, and the cost of the larger kernels.
#include <nlohmann/json.hpp>

#include "core/kernel/base/features.h"
#include "tests/support/program/outcome.h"

namespace pl::test {

using nlohmann::json;

TEST_CASE("info says which effects a scene needs, and why") {
    const ProgramResult text = run_program({"info", "spheres"});
    REQUIRE(text.code == 0);
    CHECK(text.out.find("specular: of 2 materials: mirror, glass") != std::string::npos);
    const json spheres = json::parse(run_program({"info", "spheres", "--nee", "off", "--json"}).out);
    CHECK(spheres["effects_needed"].size() == 2);
    CHECK(json::parse(run_program({"info", "cornell", "--nee", "off", "--json"}).out)["effects_needed"].empty());
    CHECK(json::parse(run_program({"info", "cornell", "--json"}).out)["effects_needed"].size() == 1);
}

TEST_CASE("bench --effects holds every larger kernel against the needed one") {
    const TempDir folder;
    const ProgramResult result =
        run_program({"bench",   "cornell",   "spheres",   "--effects", "--method", "default,reinforcement",
                     "--nee",   "off",       "--backend", "cpu",       "--size",   "16x16",
                     "--seeds", "3",         "--volumes", "40",        "--bins",   "16",
                     "-o",      folder / "e"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const json effects = json::parse(read_all(folder / "e/effects.json"));
    CHECK(effects["schema"] == "pathlight.effects/1");
    int rows_of_cornell = 0;
    int rows_of_spheres = 0;
    for (const json& cost : effects["costs"]) {
        ++(cost["scene"] == "cornell" ? rows_of_cornell : rows_of_spheres);
        CHECK(cost["ns_per_segment"] > 0.0);
        CHECK(cost["ratio"]["value"] > 0.0);
        CHECK(cost["ratio"]["low"] <= cost["ratio"]["value"]);
        CHECK(cost["ratio"]["high"] >= cost["ratio"]["value"]);
    }
    CHECK(rows_of_cornell == 2 * pl::kCompiledSetCount);
    CHECK(rows_of_spheres == 2 * 3);  // metals and glass, all but instances, all
    CHECK(read_all(folder / "e/effects.md").find("| cornell") != std::string::npos);
}

}  // namespace pl::test
