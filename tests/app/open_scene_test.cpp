// Knobs on the command line: -D in the subcommands that take a scene, and the knobs that `info` lists.
#include <nlohmann/json.hpp>

#include "tests/support/catch.hpp"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

ProgramResult info(const Arguments& more) { return run_program(joined({"info"}, more)); }

std::string hash_of(const Arguments& more) {
    Arguments arguments = more;
    arguments.emplace_back("--json");
    const ProgramResult result = info(arguments);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return nlohmann::json::parse(result.out).at("scene_hash");
}

}  // namespace

TEST_CASE("info lists the knobs of a scene with value, range, default and effect") {
    const ProgramResult text = info({"door", "-D", "opening=5"});
    CHECK(text.code == 0);
    CHECK_THAT(text.out, contains("opening=5 (from 1 to 45, default 17.9): angle"));
    CHECK_THAT(info({"cornell"}).out, contains("knobs      none"));

    const auto report = nlohmann::json::parse(info({"door", "--define=opening=5", "--json"}).out);
    REQUIRE(report.at("knobs").size() == 1);
    const auto& knob = report.at("knobs")[0];
    CHECK(knob.at("name") == "opening");
    CHECK(knob.at("value") == 5.0);
    CHECK(knob.at("default").get<float>() == 17.9f);
    CHECK(knob.at("range") == nlohmann::json::array({1.0, 45.0}));
}

TEST_CASE("the scene's hash changes with a knob, and not with its default") {
    const std::string plain = hash_of({"door"});
    CHECK(hash_of({"door", "-D", "opening=17.9"}) == plain);
    const std::string narrow = hash_of({"door", "-D", "opening=3"});
    CHECK(narrow != plain);
    CHECK(hash_of({"-D", "opening=20", "-D", "opening=3", "door"}) == narrow);  // the last one counts
}

TEST_CASE("a knob at its default changes no bit of a picture, another value changes it, and the picture says so") {
    const TempDir folder;
    const auto picture = [&](const Arguments& more) {
        const ProgramResult result = run_program(
            joined({"render", "door", "-o", folder / "x.pfm", "--size", "24x24", "--spp", "4", "--nee", "on"}, more));
        CAPTURE(result.err);
        REQUIRE(result.code == 0);
        return read_all(folder / "x.pfm");
    };
    const std::string plain = picture({});
    CHECK(picture({"-D", "opening=17.9"}) == plain);
    CHECK(picture({"-D", "opening=40"}) != plain);

    const ProgramResult marked =
        run_program({"render", "door", "-o", folder / "x.png", "--size", "8x8", "--spp", "1", "-D", "opening=40"});
    REQUIRE(marked.code == 0);
    CHECK_THAT(read_all(folder / "x.png"), contains("--define opening=40"));
}

TEST_CASE("knobs that are wrong exit with 2 and tell the range or the nearest name") {
    const TempDir folder;
    struct Wrong {
        Arguments arguments;
        std::string told;
    };
    const std::vector<Wrong> wrongs{
        {{"info", "door", "-D", "opening=46"}, "-D opening: expected a number from 1 to 45"},
        {{"render", "door", "-o", folder / "x.png", "-D", "openin=4"}, "did you mean 'opening'?"},
        {{"inspect", "door", "-o", folder / "x.json", "--pixel", "1,1", "-D", "opening=0"}, "from 1 to 45"},
        {{"info", "cornell", "-D", "opening=4"}, "it has none"},
        {{"info", "door", "-D", "opening"}, "--define: expected NAME=VALUE"},
        {{"info", "door", "-D", "=4"}, "--define: expected NAME=VALUE"},
        {{"info", "door", "-D", "opening=wide"}, "-D opening: expected a number from 1 to 45"},
        {{"info", "door", "-D", "opening=nan"}, "-D opening: expected a number"},
        {{"info", "door", "-D", "opening=20,opening=3"}, "got '20,opening=3'"},
        {{"info", "door", "-D", ""}, "--define: expected NAME=VALUE"},
        {{"info", "door", "--knob", "opening=4"}, "unknown option '--knob' of 'info'"},
    };
    for (const Wrong& wrong : wrongs) check_refused(2, wrong.arguments, wrong.told);
    CHECK(folder.names().empty());
}

}  // namespace pl::test
