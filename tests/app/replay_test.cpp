// `pathlight replay` from a shell: frames along a path, which go on learning, repeatable to the bit.
#include <algorithm>
#include <csignal>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::json;

/// Two cameras in the Cornell box.
void write_path(const TempDir& folder, const std::string& more = "") {
    write_all(folder / "path.json", "{\"schema\": \"pathlight.cameras/1\", \"cameras\": [\n"
                                    "{\"eye\": [278, 273, -800], \"target\": [278, 273, 0]},\n"
                                    "{\"eye\": [200, 300, -600], \"target\": [300, 250, 0]}" +
                                        more + "]}\n");
}

/// Three frames into the folder "out".
Arguments replay(const TempDir& folder, const Arguments& more = {}) {
    return joined({"replay", "cornell", "--path", folder / "path.json", "-o", folder / "out", "--size", "16x12",
                   "--spp", "3", "--frames", "3", "--volumes", "50", "--no-progress"},
                  more);
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> frames_of(const TempDir& folder) {
    std::vector<std::string> bits;
    for (const std::string name : {"frame_0001.pfm", "frame_0002.pfm", "frame_0003.pfm"})
        bits.push_back(read_all(folder / ("out/" + name)));
    return bits;
}

/// Leaves neither folder nor picture.
void check_leaves_nothing(const TempDir& folder, const Arguments& arguments, int code, const std::string& told) {
    const std::vector<std::string> before = folder.names();
    check_refused(code, arguments, told);
    CHECK(folder.names() == before);
}

}  // namespace

TEST_CASE("replay: a picture for each frame, from the first camera to the last") {
    const TempDir folder;
    write_path(folder);
    const ProgramResult result = run_program(replay(folder, {"--format", "pfm"}));
    CAPTURE(result.out, result.err);
    REQUIRE(result.code == 0);
    CHECK(
        (names_in(folder / "out") == std::vector<std::string>{"frame_0001.pfm", "frame_0002.pfm", "frame_0003.pfm"}));
    CHECK_THAT(result.out, contains("frame_0002.pfm: 2 of 3, 3 spp"));

    // Without learning a frame is the picture of its camera, to the bit.
    const auto single = [&](const Arguments& camera) {
        Arguments arguments{"render", "cornell", "-o", folder / "one.pfm", "--size", "16x12", "--spp", "3"};
        arguments.insert(arguments.end(), camera.begin(), camera.end());
        REQUIRE(run_program(arguments).code == 0);
        return read_all(folder / "one.pfm");
    };
    const std::vector<std::string> frames = frames_of(folder);
    CHECK(frames[0] == single({"--eye", "278,273,-800", "--target", "278,273,0"}));
    CHECK(frames[2] == single({"--eye", "200,300,-600", "--target", "300,250,0"}));
    CHECK(frames[1] != frames[0]);
    CHECK(frames[1] != frames[2]);
}

TEST_CASE("replay: PNG by default, and EXR with the same radiance as PFM") {
    const TempDir folder;
    write_path(folder);
    REQUIRE(run_program(replay(folder)).code == 0);
    CHECK(read_png8(folder / "out/frame_0003.png").width == 16);
    for (const std::string kind : {"exr", "pfm"}) REQUIRE(run_program(replay(folder, {"--format", kind})).code == 0);
    CHECK((read_exr(folder / "out/frame_0003.exr").pixels == read_linear(folder / "out/frame_0003.pfm").pixels));
    CHECK(names_in(folder / "out").size() == 9);
}

TEST_CASE("replay: equal samples are the same bits on any number of threads, and learning goes on between frames") {
    for (const std::string method : {"precomputed", "reinforcement"})
        for (const std::string nee : {"off", "on"}) {
            CAPTURE(method, nee);
            std::vector<std::string> first;
            for (const std::string threads : {"1", "2", "5"}) {
                const TempDir folder;
                write_path(folder);
                const ProgramResult result =
                    run_program(replay(folder, {"--format", "pfm", "--method", method, "--nee", nee, "-t", threads,
                                                "--stats", folder / "stats.json"}));
                CAPTURE(threads, result.err);
                REQUIRE(result.code == 0);
                const std::vector<std::string> bits = frames_of(folder);
                if (first.empty()) first = bits;
                CHECK(bits == first);
                const json frames = json::parse(read_all(folder / "stats.json")).at("frames");
                REQUIRE(frames.size() == 3);
                if (method != "reinforcement") continue;
                for (int i = 0; i < 3; ++i)
                    CHECK(frames[static_cast<std::size_t>(i)].at("learned_passes") == 3 * (i + 1));
            }
        }
}

TEST_CASE("replay: equal time for each frame") {
    const TempDir folder;
    write_path(folder);
    const ProgramResult result =
        run_program({"replay", "cornell", "--path", folder / "path.json", "-o", folder / "out", "--size", "8x6",
                     "--seconds-per-frame", "0.2", "--frames", "3", "--stats", folder / "stats.json"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    for (const json& frame : json::parse(read_all(folder / "stats.json")).at("frames")) {
        CHECK(frame.at("seconds").get<double>() >= 0.2);
        CHECK(frame.at("spp").get<int>() > 64);  // no limit of samples
    }
}

TEST_CASE("replay: a learned frame differs from the picture that begins to learn with it") {
    const TempDir folder;
    write_path(folder);
    REQUIRE(run_program(replay(folder, {"--format", "pfm", "--method", "reinforcement"})).code == 0);
    REQUIRE(run_program({"render", "cornell", "-o", folder / "cold.pfm", "--size", "16x12", "--spp", "3", "--volumes",
                         "50", "--method", "reinforcement", "--eye", "200,300,-600", "--target", "300,250,0"})
                .code == 0);
    CHECK(frames_of(folder)[2] != read_all(folder / "cold.pfm"));
}

TEST_CASE("replay: the command in a frame makes the sequence again") {
    const TempDir folder;
    write_path(folder);
    REQUIRE(run_program(replay(folder, {"--format", "exr", "--method", "reinforcement"})).code == 0);
    ImageMetadata metadata;
    const LinearImage before = read_exr(folder / "out/frame_0003.exr", &metadata);
    const std::string command = text_of(metadata, "command");
    CHECK_THAT(command, contains("pathlight replay cornell") && contains("--path") && contains("--format exr"));
    std::filesystem::remove(folder / "out/frame_0003.exr");
    REQUIRE(run_shell(command).code == 0);
    CHECK((read_exr(folder / "out/frame_0003.exr").pixels == before.pixels));
}

TEST_CASE("replay: an interruption loses only the frame under way") {
    const TempDir folder;
    write_path(folder);
    RunningProgram running(
        program({"replay", "cornell", "--path", folder / "path.json", "-o", folder / "out", "--format", "pfm",
                 "--size", "16x12", "--spp", "50", "--frames", "1000000", "--json"}));
    REQUIRE(running.wait_for_output("frame_0002.pfm"));
    running.send(SIGINT);
    const ProgramResult result = running.wait();
    CHECK(result.code == 130);
    CHECK_THAT(result.err, contains("of 1000000 frames are written, the one under way is lost"));
    const json done = json::parse(lines_of(result.out).back());
    CHECK(done.at("event") == "done");
    const int written = done.at("frames");
    CHECK(written >= 2);
    // All of them, whole, and nothing else.
    const std::vector<std::string> names = names_in(folder / "out");
    CHECK(names.size() == static_cast<std::size_t>(written));
    for (const std::string& name : names) CHECK(read_linear(folder / ("out/" + name)).width == 16);
}

TEST_CASE("replay: a frame that cannot be written leaves the old one and those before") {
    const TempDir folder;
    write_path(folder);
    std::filesystem::create_directory(folder / "out");
    write_all(folder / "out/frame_0002.pfm", "old");
    std::filesystem::create_directory(folder / "out/frame_0003.pfm");
    const ProgramResult result = run_program(replay(folder, {"--format", "pfm"}));
    CHECK(result.code == 1);
    CHECK_THAT(result.err, contains("frame_0003.pfm") && contains("cannot be written"));
    CHECK(read_linear(folder / "out/frame_0002.pfm").width == 16);
    CHECK(names_in(folder / "out").size() == 3);
}

TEST_CASE("replay: faults are told before anything is rendered") {
    const TempDir folder;
    check_leaves_nothing(folder, replay(folder), 3, "path.json");
    write_path(folder);
    write_all(folder / "file", "");
    check_leaves_nothing(folder, replay(folder, {"-o", folder / "file"}), 1, "file: cannot be made");
    check_leaves_nothing(folder, replay(folder, {"--format", "jpg"}), 2,
                         "--format: expected png, exr or pfm, got 'jpg'");
    check_leaves_nothing(folder, replay(folder, {"--frames", "1"}), 2, "--frames: expected");
    check_leaves_nothing(folder, replay(folder, {"--seconds-per-frame", "0"}), 2,
                         "--seconds-per-frame: expected a number of seconds above 0, got '0'");
    check_leaves_nothing(folder, replay(folder, {"--diagnostics", folder / "d.png"}), 2,
                         "unknown option '--diagnostics' of 'replay'");
    check_leaves_nothing(folder, replay(folder, {"--view", "radiance-map"}), 2, "precomputed or reinforcement");
    check_leaves_nothing(folder, {"replay", "cornell", "-o", folder / "out"}, 2, "--path FILE");
    check_leaves_nothing(folder, {"replay", "cornell", "--path", folder / "path.json"}, 2, "-o DIR");
    check_leaves_nothing(folder, {"replay", "--path", folder / "path.json", "-o", folder / "out"}, 2,
                         "needs a SCENE");
    write_all(folder / "path.json", "{\"schema\": \"pathlight.cameras/1\",\n\"cameras\": [{\"eye\": [0, 0, 1]}]}");
    check_leaves_nothing(folder, replay(folder), 3, "path.json:2: 'cameras': expected at least 2 cameras, got 1");
    write_all(folder / "path.json", "{\"schema\": \"pathlight.cameras/1\",\n\"cameras\": [{\"eyes\": [0, 0, 1]}]}");
    check_leaves_nothing(folder, replay(folder), 3, "path.json:2: 'cameras/0/eyes'");
}

}  // namespace pl::test
