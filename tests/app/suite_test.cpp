// Suites of `pathlight bench` from a shell, with small scenes in the places of the scenes of the literature.
#include <filesystem>

#include <nlohmann/json.hpp>

#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A room of a floor and a lamp above it, in the format of Mitsuba.
constexpr const char* kRoom = R"(<scene version="3.0.0">
<sensor type="perspective"><float name="fov" value="60"/>
<transform name="to_world"><lookat origin="0, 1, 4" target="0, 1, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="18"/></film></sensor>
<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/></transform>
<bsdf type="diffuse"/></shape>
<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/><translate y="2"/></transform>
<emitter type="area"><rgb name="radiance" value="2"/></emitter><bsdf type="diffuse"/></shape>
</scene>)";

/// Puts rooms where the suite looks for these scenes, one folder deeper than --scenes.
void make_scenes(const TempDir& folder, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        fs::create_directories(folder.path() / "scenes/mitsuba" / name);
        write_all(folder / ("scenes/mitsuba/" + name + "/scene.xml"), kRoom);
    }
}

Arguments suite(const TempDir& folder, const Arguments& more = {}) {
    return joined({"bench", "--suite", "literature", "--scenes", folder / "scenes", "-o", folder / "b"}, more);
}

/// The settings of the first scene of the bench's plan.
json settings_in(const TempDir& folder) {
    return json::parse(read_all(folder / "b/plan.json")).at("scenes").at(0).at("settings");
}

const Arguments kTiny{"--size",   "16x9",    "--spp",           "2", "--time-limit",    "100",    "--seeds", "1",
                      "--method", "default", "--reference-spp", "8", "--measure-share", "1000000"};

}  // namespace

TEST_CASE("a suite has the scenes that its folder has, by the names of their folders, and names the missing ones") {
    const TempDir folder;
    make_scenes(folder, {"veach-ajar", "staircase", "other"});
    const ProgramResult result = run_well(suite(folder, kTiny));
    CHECK_THAT(result.err, contains("is without veach-bidir/scene.xml, breakfast-room/scene.xml, "));
    const json results = json::parse(read_all(folder / "b/results.json"));
    std::vector<std::string> names;
    for (const json& scene : results.at("plan").at("scenes")) names.push_back(scene.at("name"));
    CHECK((names == std::vector<std::string>{"veach-ajar", "staircase"}));
    // The command is the one that was typed: a suite is spelled out by whoever runs it.
    CHECK_THAT(results.at("command").get<std::string>(),
               contains(" --suite literature --scenes ") && !contains("scene.xml"));
}

TEST_CASE("a protocol sets what it names, a quick bench is short, and given options go over both") {
    const TempDir folder;
    make_scenes(folder, {"veach-ajar"});
    run_well(suite(folder, joined(kTiny, {"--protocol", "npm"})));
    CHECK(settings_in(folder).at("nee") == "off");
    CHECK(settings_in(folder).at("roulette") == "off");
    CHECK(settings_in(folder).at("max-depth") == "10");
    fs::remove_all(folder.path() / "b");
    run_well(suite(folder, joined(kTiny, {"--protocol", "df", "--quick", "--max-depth", "3"})));
    CHECK(settings_in(folder).at("max-depth") == "3");
    CHECK(settings_in(folder).at("size") == "16x9");
    CHECK(settings_in(folder).at("time-limit") == "100");
    CHECK(json::parse(read_all(folder / "b/plan.json")).at("seeds") == 1);
}

TEST_CASE("a bench says before how much it has to do, and a resumed one how much is left") {
    const TempDir folder;
    make_scenes(folder, {"veach-ajar", "veach-bidir"});
    const Arguments two = suite(folder, joined(kTiny, {"--time-limit", "2", "--seeds", "2"}));
    const ProgramResult first = run_well(two);
    // Two scenes with a warm-up and two seeds each.
    CHECK_THAT(first.err, contains("left to do: references: 2 of 2 x 8 samples per pixel; runs: 6, "
                                   "warm-ups included, one after the other about 12 s"));
    fs::remove(folder.path() / "b/runs/veach-ajar-default-cpu-seed-2.json");
    const ProgramResult second = run_well(two);
    CHECK_THAT(second.err, contains("left to do: runs: 2, warm-ups included"));
    const ProgramResult third = run_well(two);
    CHECK_THAT(third.err, contains("left to do: runs: 0,"));
}

TEST_CASE("what a suite does not understand") {
    const TempDir folder;
    fs::create_directory(folder.path() / "scenes");
    check_refused(2, suite(folder, {"--suite", "papers"}), "--suite: expected none or literature, got 'papers'");
    check_refused(2, suite(folder, {"--protocol", "mpn"}), "--protocol: expected none, npm, df, production or ours");
    check_refused(2, suite(folder, {"cornell"}), "--suite: expected no SCENE with it, got cornell");
    check_refused(2, {"bench", "--suite", "literature", "-o", folder / "b"}, "--scenes DIR");
    check_refused(2, {"bench", "cornell", "--scenes", folder / "scenes", "-o", folder / "b"}, "--suite with it");
    check_refused(3, suite(folder), "there are none: veach-ajar/scene.xml");
    check_refused(3, suite(folder, {"--scenes", folder / "nowhere"}), "--scenes: expected a folder");
    CHECK_FALSE(fs::exists(folder / "b"));
}

TEST_CASE("a quick bench of a suite has three scenes, five seeds, all methods and a page", "[nightly]") {
    const TempDir folder;
    make_scenes(folder, {"veach-ajar", "veach-bidir", "breakfast-room", "staircase"});
    run_well(suite(folder, {"--quick"}));
    const json results = json::parse(read_all(folder / "b/results.json"));
    CHECK(results.at("complete") == true);
    CHECK(results.at("plan").at("scenes").size() == 3);
    CHECK(results.at("summary").size() == 3 * 3);
    for (const json& cell : results.at("summary")) {
        CHECK(cell.at("runs") == 5);
        CHECK(cell.at("relmse").at(1).is_number());  // an interval
        CHECK(cell.at("flip").at(0).get<double>() < 1.0);
    }
    CHECK(settings_in(folder).at("size") == "160x90");
    run_well({"report", folder / "b"});
    CHECK_THAT(read_all(folder / "b/report.html"), contains("breakfast-room"));
}

}  // namespace pl::test
