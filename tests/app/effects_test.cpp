// Effects on the command line: the needed ones with their reasons.
#include <nlohmann/json.hpp>

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

}  // namespace pl::test
