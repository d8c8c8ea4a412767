// `pathlight render --camera-path` from a shell: frames along a path, which go on learning, repeatable to the bit.
#include <csignal>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

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

Arguments sequence(const TempDir& folder, const std::string& output, const Arguments& more = {}) {
    Arguments arguments{"render",
                        "cornell",
                        "--camera-path",
                        folder / "path.json",
                        "-o",
                        folder / output,
                        "--size",
                        "16x12",
                        "--spp",
                        "3",
                        "--frames",
                        "3",
                        "--volumes",
                        "50",
                        "--no-progress"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::string refusal(const TempDir& folder, const Arguments& arguments, int code) {
    const ProgramResult result = run_program(arguments);
    CAPTURE(result.err);
    CHECK(result.code == code);
    CHECK(folder.names().size() <= 1);  // the path, and no picture
    return result.err;
}

}  // namespace

TEST_CASE("a sequence has a picture for each frame, from the first camera to the last") {
    const TempDir folder;
    write_path(folder);
    const ProgramResult result = run_program(sequence(folder, "f_%02d.pfm"));
    CAPTURE(result.out, result.err);
    REQUIRE(result.code == 0);
    CHECK((folder.names() == std::vector<std::string>{"f_01.pfm", "f_02.pfm", "f_03.pfm", "path.json"}));
    CHECK_THAT(result.out, contains("f_02.pfm: 2 of 3, 3 spp"));

    // Without learning a frame is the picture of its camera, to the bit.
    const auto single = [&](const Arguments& camera) {
        Arguments arguments{"render", "cornell", "-o", folder / "one.pfm", "--size", "16x12", "--spp", "3"};
        arguments.insert(arguments.end(), camera.begin(), camera.end());
        REQUIRE(run_program(arguments).code == 0);
        return read_all(folder / "one.pfm");
    };
    CHECK(read_all(folder / "f_01.pfm") == single({"--eye", "278,273,-800", "--target", "278,273,0"}));
    CHECK(read_all(folder / "f_03.pfm") == single({"--eye", "200,300,-600", "--target", "300,250,0"}));
    CHECK(read_all(folder / "f_02.pfm") != read_all(folder / "f_01.pfm"));
    CHECK(read_all(folder / "f_02.pfm") != read_all(folder / "f_03.pfm"));
}

TEST_CASE("frames of equal samples are the same bits on any number of threads, and learning goes on between them") {
    for (const std::string method : {"precomputed", "reinforcement"})
        for (const std::string nee : {"off", "on"}) {
            CAPTURE(method, nee);
            std::vector<std::string> first;
            for (const std::string threads : {"1", "2", "5"}) {
                const TempDir folder;
                write_path(folder);
                const ProgramResult result = run_program(
                    sequence(folder, "f_%d.pfm",
                             {"--method", method, "--nee", nee, "-t", threads, "--stats", folder / "stats.json"}));
                CAPTURE(threads, result.err);
                REQUIRE(result.code == 0);
                std::vector<std::string> bits;
                for (const std::string name : {"f_1.pfm", "f_2.pfm", "f_3.pfm"})
                    bits.push_back(read_all(folder / name));
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

TEST_CASE("a learned frame differs from the picture that begins to learn with it") {
    const TempDir folder;
    write_path(folder);
    REQUIRE(run_program(sequence(folder, "f_%d.pfm", {"--method", "reinforcement"})).code == 0);
    REQUIRE(run_program({"render", "cornell", "-o", folder / "cold.pfm", "--size", "16x12", "--spp", "3", "--volumes",
                         "50", "--method", "reinforcement", "--eye", "200,300,-600", "--target", "300,250,0"})
                .code == 0);
    CHECK(read_all(folder / "f_3.pfm") != read_all(folder / "cold.pfm"));
}

TEST_CASE("the command in a frame makes the sequence again") {
    const TempDir folder;
    write_path(folder);
    REQUIRE(run_program(sequence(folder, "f_%d.exr", {"--method", "reinforcement"})).code == 0);
    ImageMetadata metadata;
    const LinearImage before = read_exr(folder / "f_3.exr", &metadata);
    const std::string command = text_of(metadata, "command");
    CHECK_THAT(command, contains("--camera-path"));
    std::filesystem::remove(folder / "f_3.exr");
    REQUIRE(run_shell(command).code == 0);
    CHECK((read_exr(folder / "f_3.exr").pixels == before.pixels));
}

TEST_CASE("an interrupted sequence loses only the frame under way") {
    const TempDir folder;
    write_path(folder);
    RunningProgram running(
        program({"render", "cornell", "--camera-path", folder / "path.json", "-o", folder / "f_%d.pfm", "--size",
                 "16x12", "--spp", "50", "--frames", "1000000", "--json"}));
    REQUIRE(running.wait_for_output("f_2.pfm"));
    running.send(SIGINT);
    const ProgramResult result = running.wait();
    CHECK(result.code == 130);
    CHECK_THAT(result.err, contains("of 1000000 frames are written, the one under way is lost"));
    const json done = json::parse(lines_of(result.out).back());
    CHECK(done.at("event") == "done");
    const int written = done.at("frames");
    CHECK(written >= 2);
    // All of them, whole, and nothing else.
    CHECK(folder.names().size() == static_cast<std::size_t>(written) + 1);
    for (int i = 1; i <= written; ++i) CHECK(read_pfm(folder / ("f_" + std::to_string(i) + ".pfm")).width == 16);
}

TEST_CASE("faults of a sequence are told before anything is rendered") {
    const TempDir folder;
    CHECK_THAT(refusal(folder, sequence(folder, "f_%d.pfm"), 3), contains("path.json"));
    write_path(folder);
    CHECK_THAT(refusal(folder, sequence(folder, "f.pfm"), 2),
               contains("expected a name with the place of the frame's number once, such as frame_%04d.exr, got '"));
    CHECK_THAT(refusal(folder, sequence(folder, "none/f_%d.pfm"), 1), contains("none"));
    CHECK_THAT(refusal(folder, sequence(folder, "f_%d.jpg"), 2), contains(".jpg"));
    CHECK_THAT(refusal(folder, sequence(folder, "f_%d.pfm", {"--diagnostics", folder / "d.png"}), 2),
               contains("--diagnostics: expected a single picture"));
    CHECK_THAT(refusal(folder, sequence(folder, "f_%d.pfm", {"--frames", "1"}), 2), contains("--frames"));
    CHECK_THAT(refusal(folder, {"render", "cornell", "-o", folder / "x.pfm", "--frames", "3"}, 2),
               contains("--frames: expected --camera-path FILE with it"));
    write_all(folder / "path.json", "{\"schema\": \"pathlight.cameras/1\", \"cameras\": [{\"eye\": [0, 0, 1]}]}");
    CHECK_THAT(refusal(folder, sequence(folder, "f_%d.pfm"), 3), contains("expected at least 2 cameras, got 1"));
}

}  // namespace pl::test
