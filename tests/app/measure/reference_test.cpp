// `pathlight reference` from a shell: two independent halves, continued, and never used for another picture.
#include <algorithm>
#include <csignal>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "core/measure/noise.h"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

Arguments reference(const std::string& folder, const Arguments& more) {
    return joined({"reference", "cornell", "-o", folder, "--size", "16x16"}, more);
}

void make_reference(const std::string& folder, const Arguments& more) {
    const ProgramResult result = run_program(reference(folder, more));
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
}

/// The only file in the folder with this suffix.
fs::path file_ending(const fs::path& folder, const std::string& ending) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().string().ends_with(ending)) found.push_back(entry.path());
    REQUIRE(found.size() == 1);
    return found.front();
}

json manifest_in(const fs::path& folder) { return json::parse(read_all(file_ending(folder, ".json"))); }

std::vector<std::uint32_t> samples_in(const fs::path& folder) {
    const json manifest = manifest_in(folder);
    return {manifest.at("halves").at(0).at("spp"), manifest.at("halves").at(1).at("spp")};
}

/// A scene with the lights of `emission` above a floor.
std::string write_scene(const TempDir& folder, const std::string& name, const std::string& emission) {
    write_all(folder / (name + ".obj"),
              "mtllib " + name +
                  ".mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                  "usemtl floor\nf 1 4 3 2\nusemtl lamp\nf 5 6 7 8\n");
    write_all(folder / (name + ".mtl"),
              "newmtl floor\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0.2 0.2 0.2\nKe " + emission + "\n");
    write_all(folder / (name + ".json"),
              R"({"schema": "pathlight.scene/1", "obj": ")" + name +
                  R"(.obj", "camera": {"eye": [0, 1, 4], "target": [0, 0.8, 0], "fov_deg": 40}})");
    return folder / (name + ".json");
}

}  // namespace

TEST_CASE("a reference is two halves, a manifest, and nothing else") {
    const TempDir folder;
    make_reference(folder / "refs", {"--spp", "40"});
    CHECK(std::distance(fs::directory_iterator(folder / "refs"), fs::directory_iterator{}) == 3);
    const json manifest = manifest_in(folder / "refs");
    CHECK(manifest.at("schema") == "pathlight.reference/1");
    CHECK(manifest.at("complete") == true);
    CHECK(manifest.at("picture_hash").get<std::string>().size() == 16);
    CHECK((samples_in(folder / "refs") == std::vector<std::uint32_t>{40, 40}));

    // Independent, and of the same picture: the noise estimated from their difference is about the error of their
    // mean against a good reference.
    make_reference(folder / "good", {"--spp", "2000"});
    const LinearImage first = read_exr(file_ending(folder / "refs", "-1.exr"));
    const LinearImage second = read_exr(file_ending(folder / "refs", "-2.exr"));
    const LinearImage good = read_exr(file_ending(folder / "good", "-1.exr"));
    CHECK(first.pixels != second.pixels);
    const double noise = estimate_noise({first.pixels, second.pixels}, first.width).mse;
    // A few bright pixels decide both, so they agree roughly; halves with the same random numbers would have no noise.
    const double error = measure_error(weighted_mean(first.pixels, 1, second.pixels, 1), good.pixels).mse;
    CHECK(noise < 5.0 * error);
    CHECK(noise > 0.2 * error);
}

TEST_CASE("a reference is gone on with") {
    const TempDir folder;
    make_reference(folder / "refs", {"--spp", "10"});
    const std::string before = read_all(file_ending(folder / "refs", "-1.exr"));
    make_reference(folder / "refs", {"--spp", "10"});
    CHECK(read_all(file_ending(folder / "refs", "-1.exr")) == before);
    // Another method and seed: the same converged picture.
    make_reference(folder / "refs", {"--spp", "30", "--method", "reinforcement", "--nee", "off", "--seed", "7"});
    CHECK((samples_in(folder / "refs") == std::vector<std::uint32_t>{30, 30}));
    CHECK(manifest_in(folder / "refs").at("halves").at(0).at("parts") == 2);
    // Fewer samples than there are: the halves stay unchanged.
    make_reference(folder / "refs", {"--spp", "5"});
    CHECK((samples_in(folder / "refs") == std::vector<std::uint32_t>{30, 30}));
}

TEST_CASE("130: an interrupted reference keeps what it has, and goes on") {
    const TempDir folder;
    Arguments endless = reference(folder / "refs", {"--spp", "1000000000", "--json"});
    RunningProgram running(program(endless));
    REQUIRE(running.wait_for_output("\"progress\""));
    running.send(SIGINT);
    const ProgramResult result = running.wait();
    CHECK(result.code == 130);
    CHECK_THAT(result.err, contains("continues from here"));
    CHECK(manifest_in(folder / "refs").at("complete") == false);
    const std::uint32_t kept = std::max(samples_in(folder / "refs")[0], samples_in(folder / "refs")[1]);
    CHECK(kept > 0);
    make_reference(folder / "refs", {"--spp", std::to_string(kept)});
    CHECK((samples_in(folder / "refs") == std::vector<std::uint32_t>{kept, kept}));
    CHECK(manifest_in(folder / "refs").at("complete") == true);
}

TEST_CASE("a time limit ends a reference with samples in both halves") {
    const TempDir folder;
    make_reference(folder / "refs", {"--time-limit", "0.1"});
    for (const std::uint32_t spp : samples_in(folder / "refs")) CHECK(spp > 0);
}

TEST_CASE("a picture is scored against its own reference, found by what it shows") {
    const TempDir folder;
    const std::string scene = write_scene(folder, "room", "4 4 4");
    const std::string brighter = write_scene(folder, "brighter", "5 5 5");
    const auto run = [](const Arguments& arguments) { REQUIRE(run_program(arguments).code == 0); };
    const auto render = [&](const std::string& from, const std::string& file, const Arguments& more = {}) {
        Arguments arguments{"render", from, "-o", folder / file, "--size", "16x16", "--spp", "4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        run(arguments);
    };
    run({"reference", scene, "-o", folder / "refs", "--size", "16x16", "--spp", "50"});
    render(scene, "x.exr", {"--method", "reinforcement", "--seed", "9", "--nee", "on"});
    const ProgramResult scored = run_program({"compare", folder / "x.exr", folder / "refs", "--json"});
    CAPTURE(scored.err);
    CHECK(scored.code == 0);
    CHECK(json::parse(scored.out).at("relmse").get<double>() > 0.0);

    // The light's power has changed: refused, given the folder or a single file.
    render(brighter, "bright.exr");
    check_refused(3, {"compare", folder / "bright.exr", folder / "refs"},
                  "room-" + manifest_in(folder / "refs").at("picture_hash").get<std::string>() +
                      ".json differs in geometry, materials or lights");
    check_refused(3, {"compare", folder / "bright.exr", file_ending(folder / "refs", "-1.exr").string()},
                  "reference of another scene");
    render(scene, "moved.exr", {"--eye", "0,1,5"});
    check_refused(3, {"compare", folder / "moved.exr", folder / "refs"}, "differs in camera");
    render(scene, "deep.exr", {"--max-depth", "3"});
    check_refused(3, {"compare", folder / "deep.exr", folder / "refs"}, "differs in depth");
    render(scene, "normals.exr", {"--view", "normal"});
    check_refused(3, {"compare", folder / "normals.exr", folder / "refs"}, "has no picture hash");
    fs::create_directory(folder / "empty");
    check_refused(3, {"compare", folder / "x.exr", folder / "empty"}, "holds no reference");
}

TEST_CASE("3: references that were tampered with are refused") {
    const TempDir folder;
    make_reference(folder / "refs", {"--spp", "2"});
    make_reference(folder / "other", {"--spp", "2", "--max-depth", "2"});
    // Another picture's half under this one's name.
    fs::copy_file(file_ending(folder / "other", "-1.exr"), file_ending(folder / "refs", "-1.exr"),
                  fs::copy_options::overwrite_existing);
    check_refused(3, reference(folder / "refs", {"--spp", "2"}), "shows another scene, camera, size, light or depth");
    write_all(file_ending(folder / "refs", "-1.exr"), "cut short");
    check_refused(3, reference(folder / "refs", {"--spp", "2"}), "not an EXR file");
    check_refused(2, {"reference", "cornell"}, "needs a folder to write to");
    write_all(folder / "file", "");
    check_refused(1, reference(folder / "file", {}), "cannot be made");
}

}  // namespace pl::test
