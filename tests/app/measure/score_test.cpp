// `pathlight score` from a shell: pictures whose errors are known by hand, and what it refuses.
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::json;

/// 4 x 2 pixels of one gray radiance.
void write_gray(const std::string& path, float radiance, int width = 4) {
    LinearImage image{.width = width, .height = 2, .pixels = {}};
    image.pixels.assign(static_cast<std::size_t>(2 * width), glm::vec3(radiance));
    write_exr(path, image);
}

json picture(const std::string& file, const std::string& method, int seed, int samples, double seconds) {
    return {{"file", file}, {"scene", "room"},    {"method", method},
            {"seed", seed}, {"samples", samples}, {"seconds", seconds}};
}

/// Radiance 1 everywhere; `path` is off by 1/2 after 4 samples and 8 s, `guided` by 1/4 after 2 samples and 8 s.
json two_methods(const TempDir& folder) {
    write_gray(folder / "reference.exr", 1.0f);
    write_gray(folder / "path.exr", 1.5f);
    write_gray(folder / "guided.exr", 0.75f);
    json file{{"schema", "pathlight.score/1"},
              {"device", "two cores"},
              {"references", {{"room", {"reference.exr"}}}},
              {"pictures", json::array()}};
    for (int seed = 1; seed <= 5; ++seed) {
        file["pictures"].push_back(picture("path.exr", "path", seed, 4, 8.0));
        file["pictures"].push_back(picture("guided.exr", "guided", seed, 2, 8.0));
    }
    return file;
}

void check_file_refused(const TempDir& folder, const json& file, const std::string& told) {
    write_all(folder / "score.json", file.dump(1));
    check_refused(3, {"score", folder / ""}, told);
}

}  // namespace

TEST_CASE("pictures of others have the errors and gains that follow from their pixels and times") {
    const TempDir folder;
    write_all(folder / "score.json", two_methods(folder).dump());
    const ProgramResult result = run_well({"score", folder.path().string()});
    CHECK_THAT(result.out, contains("room/guided/cpu needs 8.0x fewer samples than path"));
    const json results = json::parse(read_all(folder / "results.json"));
    REQUIRE(results.at("summary").size() == 2);
    const json& path = results.at("summary").at(0);
    const json& guided = results.at("summary").at(1);
    CHECK(path.at("method") == "path");
    CHECK(path.at("runs") == 5);
    CHECK_THAT(path.at("mse").at(0).get<double>(), WithinRel(0.25, 1e-12));
    CHECK_THAT(path.at("relmse").at(0).get<double>(), WithinRel(0.25 / 1.01, 1e-12));
    CHECK_THAT(guided.at("mse").at(0).get<double>(), WithinRel(0.0625, 1e-12));
    CHECK_THAT(guided.at("seconds").at(0).get<double>(), WithinRel(8.0, 1e-12));
    // White and brighter than white are the same to a display; gray is not.
    CHECK(path.at("flip").at(0).get<double>() == 0.0);
    CHECK(guided.at("flip").at(0).get<double>() > 0.0);
    // A quarter of the error at half of the samples in the same time.
    const json& gain = results.at("comparisons").at(0);
    CHECK_THAT(gain.at("samples").at(0).get<double>(), WithinRel(8.0, 1e-9));
    CHECK_THAT(gain.at("cost").at(0).get<double>(), WithinRel(0.5, 1e-9));
    CHECK_THAT(gain.at("net").at(0).get<double>(), WithinRel(4.0, 1e-9));
    CHECK_THAT(read_all(folder / "summary.md"), contains("| room | cpu | guided | 5 | 0.0619"));
    CHECK_THAT(read_all(folder / "summary.tex"),
               contains("room & cpu & guided & 0.0619 (0.0619 to 0.0619) & 8 (8 to 8) & 4 (4 to 4) \\\\\n"));
    CHECK_THAT(read_all(folder / "series.csv"), contains("room,guided,cpu,3,0,2,0,0,0,0,0,0,8,8,0.0625,"));
    run_well({"report", folder.path().string()});
    CHECK_THAT(read_all(folder / "report.html"), contains("two cores") && contains("room"));
}

TEST_CASE("the halves of a reference take its noise out of the error") {
    const TempDir folder;
    json file = two_methods(folder);
    write_gray(folder / "first.exr", 0.75f);
    write_gray(folder / "second.exr", 1.25f);
    file["references"]["room"] = {"first.exr", "second.exr"};
    file["methods"] = {"guided", "path"};
    write_all(folder / "score.json", file.dump());
    run_well({"score", folder.path().string()});
    const json results = json::parse(read_all(folder / "results.json"));
    CHECK(results.at("comparisons").at(0).at("base") == "guided");
    // (1.5 - 0.75) (1.5 - 1.25)
    CHECK_THAT(results.at("summary").at(1).at("mse").at(0).get<double>(), WithinRel(0.1875, 1e-12));
}

TEST_CASE("a table for LaTeX shows names as they are") {
    const TempDir folder;
    json file = two_methods(folder);
    file["pictures"] = {picture("guided.exr", "a_b & 50%", 1, 16, 30.0)};
    write_all(folder / "score.json", file.dump());
    run_well({"score", folder.path().string()});
    CHECK_THAT(read_all(folder / "summary.tex"), contains("room & cpu & a\\_b \\& 50\\% & 0.0619 & & \\\\\n"));
}

TEST_CASE("pictures of one run are points of a curve") {
    const TempDir folder;
    json file = two_methods(folder);
    file["pictures"] = {picture("guided.exr", "path", 1, 16, 30.0), picture("path.exr", "path", 1, 4, 8.0)};
    write_all(folder / "score.json", file.dump());
    run_well({"score", folder.path().string()});
    const json results = json::parse(read_all(folder / "results.json"));
    REQUIRE(results.at("runs").size() == 1);
    const json& points = results.at("runs").at(0).at("points");
    REQUIRE(points.size() == 2);
    CHECK(points.at(0).at("spp") == 4);
    CHECK(points.at(1).at("seconds").at("charged") == 30.0);
}

TEST_CASE("3: what score does not understand") {
    const TempDir folder;
    const json good = two_methods(folder);
    check_refused(3, {"score", folder / "nowhere"}, "score.json");
    check_file_refused(folder, {{"schema", "pathlight.bench/1"}}, "score.json:2: ");
    json file = good;
    file["reference"] = "reference.exr";
    check_file_refused(folder, file, "did you mean 'references'?");
    file = good;
    file["pictures"][3]["file"] = "none.exr";
    check_file_refused(folder, file, "none.exr");
    file = good;
    file["pictures"][0]["seconds"] = 0;
    check_file_refused(folder, file, "path.exr: expected \"seconds\" above 0");
    file = good;
    file["pictures"][0].erase("samples");
    check_file_refused(folder, file, "expected a whole number from 1 to 1000000000, got none");
    file = good;
    file["pictures"].push_back(file["pictures"][0]);
    check_file_refused(folder, file, "path.exr: expected more than 4 samples and 8 s");
    file = good;
    file["pictures"][0]["scene"] = "hall";
    check_file_refused(folder, file, "expected the reference of 'hall'");
    file = good;
    file["methods"] = {"path"};
    check_file_refused(folder, file, "expected one of \"methods\", got 'guided'");
    write_gray(folder / "path.exr", 1.5f, 3);
    check_file_refused(folder, good, "expected 4x2 pixels as its reference has, got 3x2");
    check_refused(2, {"score"}, "'score' needs one folder with score.json, DIR: got 0");
}

}  // namespace pl::test
