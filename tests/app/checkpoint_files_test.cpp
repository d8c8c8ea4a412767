// --checkpoint, --checkpoint-every and --resume from a shell.
#include <csignal>

#include <nlohmann/json.hpp>

#include "tests/support/catch.hpp"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

Arguments render_refined(const std::string& output, std::uint32_t spp, const Arguments& more) {
    return joined({"render", "cornell", "-o", output, "--size", "32x32", "--volumes", "60", "--bins", "64", "--learn",
                   "refine=0.5", "--spp", std::to_string(spp)},
                  more);
}

/// All but times and threads.
json counts_of(const std::string& stats_file) {
    json stats = json::parse(read_all(stats_file));
    for (const char* member : {"seconds", "threads"}) stats.erase(member);
    return stats;
}

}  // namespace

TEST_CASE("a run that is interrupted leaves a checkpoint, and one that resumes from it has the bits of one run") {
    struct Run {
        const char* method;
        const char* nee;
        int signal;
    };
    for (const Run& run : {Run{"default", "on", SIGINT}, Run{"precomputed", "off", SIGTERM},
                           Run{"reinforcement", "off", SIGINT}, Run{"reinforcement", "on", SIGTERM}}) {
        const TempDir folder;
        CAPTURE(run.method, run.signal);
        const Arguments same{"--method", run.method, "--nee", run.nee};
        RunningProgram running(
            program(render_refined(folder / "a.pfm", 1000000000,
                                   joined(same, {"--checkpoint", folder / "c", "--checkpoint-every", "0", "--stats",
                                                 folder / "a.json", "-t", "2"}))));
        REQUIRE(running.wait_until([&] { return fs::exists(folder / "c"); }));
        running.send(run.signal);
        const ProgramResult result = running.wait();
        CAPTURE(result.err);
        REQUIRE(result.code == 130);
        CHECK_THAT(result.err, contains("--resume"));
        CHECK((folder.names() == std::vector<std::string>{"a.json", "a.pfm", "c"}));
        const std::uint32_t spp = json::parse(read_all(folder / "a.json"))["spp"].get<std::uint32_t>() + 2;
        run_well(render_refined(folder / "b.pfm", spp,
                                joined(same, {"--resume", folder / "c", "--stats", folder / "b.json", "-t", "1"})));
        run_well(render_refined(folder / "w.pfm", spp, joined(same, {"--stats", folder / "w.json", "-t", "2"})));
        CHECK((read_all(folder / "b.pfm") == read_all(folder / "w.pfm")));
        CHECK(counts_of(folder / "b.json") == counts_of(folder / "w.json"));
    }
}

TEST_CASE("checkpoints are written along the way, and a killed program leaves the last one whole") {
    const TempDir folder;
    RunningProgram running(program(
        render_refined(folder / "a.pfm", 1000000000,
                       {"--method", "reinforcement", "--checkpoint", folder / "c", "--checkpoint-every", "0"})));
    REQUIRE(running.wait_until([&] { return fs::exists(folder / "c"); }));
    running.send(SIGKILL);
    CHECK(running.wait().code == 128 + SIGKILL);
    run_well(render_refined(folder / "b.pfm", 1, {"--method", "reinforcement", "--resume", folder / "c"}));
}

TEST_CASE("a checkpoint that cannot be written does not end the rendering, and the next one is tried") {
    const TempDir folder;
    fs::create_directory(folder / "d");
    const auto start = [&] {
        return program(render_refined(folder / "a.pfm", 1000000000,
                                      {"--checkpoint", folder / "d/c", "--checkpoint-every", "0"}));
    };
    const auto loses_its_folder = [&](RunningProgram& running) {
        REQUIRE(running.wait_until([&] { return fs::exists(folder / "d/c"); }));
        // The program may be writing there.
        REQUIRE(running.wait_until([&] {
            std::error_code failed;
            fs::remove_all(folder / "d", failed);
            return !failed && running.err().find("rendering goes on without this checkpoint") != std::string::npos;
        }));
    };
    RunningProgram lost(start());
    loses_its_folder(lost);
    lost.send(SIGINT);
    const ProgramResult without = lost.wait();
    CAPTURE(without.err);
    CHECK(without.code == 130);
    CHECK(fs::exists(folder / "a.pfm"));
    CHECK_THAT(without.err, contains("warning: ") && contains("d/c: cannot be written"));
    CHECK(without.err.find("--resume") == std::string::npos);

    fs::create_directory(folder / "d");
    RunningProgram found(start());
    loses_its_folder(found);
    fs::create_directory(folder / "d");
    REQUIRE(found.wait_until([&] { return fs::exists(folder / "d/c"); }));
    found.send(SIGHUP);
    const ProgramResult with = found.wait();
    CAPTURE(with.err);
    CHECK(with.code == 130);
    CHECK_THAT(with.err, contains("goes on from here"));
    run_well(render_refined(folder / "b.pfm", 1, {"--resume", folder / "d/c"}));
}

TEST_CASE("seconds of work go on where a run is resumed") {
    const TempDir folder;
    run_well(render_refined(folder / "a.pfm", 4, {"--checkpoint", folder / "c", "--stats", folder / "a.json"}));
    run_well(render_refined(folder / "b.pfm", 4, {"--resume", folder / "c", "--stats", folder / "b.json"}));
    CHECK((read_all(folder / "a.pfm") == read_all(folder / "b.pfm")));
    const json first = json::parse(read_all(folder / "a.json"));
    const json second = json::parse(read_all(folder / "b.json"));
    CHECK(second["seconds"]["render"] == first["seconds"]["render"]);
}

TEST_CASE("checkpoints that do not fit are refused") {
    const TempDir folder;
    run_well(render_refined(folder / "a.pfm", 2, {"--checkpoint", folder / "c"}));
    const std::string whole = read_all(folder / "c");
    write_all(folder / "cut", whole.substr(0, whole.size() / 2));
    write_all(folder / "text", "hello\n");
    std::string other_version = whole;
    other_version[8] = 99;
    write_all(folder / "version", other_version);
    std::string damaged = whole;
    damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 1);
    write_all(folder / "damaged", damaged);
    const auto resume = [&](const std::string& name, const Arguments& more = {}) {
        return render_refined(folder / "x.pfm", 4, joined({"--resume", folder / name}, more));
    };
    check_refused(3, resume("c", {"--seed", "2"}), "c: the checkpoint is of another run: seed: expected 2, got 1");
    check_refused(3, resume("c", {"--size", "16x16"}), "size: expected 16x16, got 32x32");
    check_refused(3, joined({"render", "door"}, {"-o", folder / "x.pfm", "--resume", folder / "c"}),
                  "scene hash: expected");
    check_refused(3, resume("cut"), "cut: damaged checkpoint: expected");
    check_refused(3, resume("damaged"), "damaged: damaged checkpoint: expected the checksum");
    check_refused(3, resume("version"), "version: checkpoint of another version: expected 8, got 99");
    check_refused(3, resume("text"), "text: not a checkpoint");
    check_refused(3, resume("none"), "no such file");
    check_refused(2, render_refined(folder / "x.pfm", 2, {"--checkpoint-every", "3"}), "expected --checkpoint FILE");
    check_refused(1, render_refined(folder / "x.pfm", 2, {"--checkpoint", folder / "gone/c"}),
                  "gone/c: cannot be written");
}

}  // namespace pl::test
