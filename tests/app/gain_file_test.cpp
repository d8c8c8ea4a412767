// `pathlight trace --gain` from a shell: marks of gains by tiles.
#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::json;

ProgramResult traced_gain(const TempDir& folder, const std::string& gain, const Arguments& more) {
    return run_program(joined({"trace", "door", "--size", "64x48", "--spp", "4", "--gain", folder / gain}, more));
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

TEST_CASE("as a PNG the gain is the picture with marks") {
    const TempDir folder;
    REQUIRE(traced_gain(folder, "gain.png", {"--method", "reinforcement"}).code == 0);
    CHECK(read_all(folder / "gain.png").substr(1, 3) == "PNG");
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
