// Jobs of mpirun from a shell: the built program on several processes of this machine.
#include <csignal>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// As root in a container, with more ranks than cores; a job that hangs is ended.
const ProgramSetup kSetup{.set = {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                  "PRTE_ALLOW_RUN_AS_ROOT=1", "PRTE_ALLOW_RUN_AS_ROOT_CONFIRM=1"}};
const Arguments kLauncher{"/usr/bin/timeout", "120", PL_MPIRUN, "--oversubscribe", "--bind-to", "none"};

Arguments on_ranks(int ranks, const Arguments& arguments) {
    return joined(joined(kLauncher, {"-n", std::to_string(ranks)}), program(arguments));
}

Arguments render(const std::string& output, const std::string& spp, const Arguments& more) {
    return joined({"render", "cornell", "-o", output, "--size", "48x40", "--volumes", "60", "--bins", "64", "--learn",
                   "refine=0.5", "--spp", spp},
                  more);
}

ProgramResult run_well(const Arguments& command) {
    ProgramResult result = RunningProgram(command, kSetup).wait();
    CAPTURE(command, result.err);
    REQUIRE(result.code == 0);
    return result;
}

std::size_t errors_in(const std::string& text) {
    std::size_t count = 0;
    for (const std::string& line : lines_of(text)) count += line.find("pathlight: error: ") != std::string::npos;
    return count;
}

/// All but times, threads and messages.
json counts_of(const std::string& stats_file) {
    json stats = json::parse(read_all(stats_file));
    for (const char* member : {"seconds", "threads", "ranks", "messages", "bytes_sent"}) stats.erase(member);
    return stats;
}

/// A part of an mpirun command line for one rank whose number of the process goes to a file.
Arguments told_rank(const std::string& file, const Arguments& arguments) {
    std::string line = "echo $$ > '" + file + "'; exec";
    for (const std::string& word : program(arguments)) line += " '" + word + "'";
    return {"-n", "1", "/bin/sh", "-c", line};
}

pid_t number_in(const std::string& file) { return static_cast<pid_t>(std::stol(read_all(file))); }

}  // namespace

namespace {

struct Run {
    const char* method;
    const char* nee;
    int ranks;
    const char* threads;
};

void check_job(const Run& run) {
    CAPTURE(run.method, run.nee, run.ranks);
    const TempDir folder;
    // The file of a precomputed map also holds a clock.
    const bool has_field = run.method == std::string("reinforcement");
    const auto command = [&](const std::string& name, const char* threads) {
        const Arguments arguments =
            render(folder / (name + ".pfm"), "10",
                   {"--method", run.method, "--nee", run.nee, "--stats", folder / (name + ".json"), "-t", threads});
        return has_field ? joined(arguments, {"--save-field", folder / (name + ".field")}) : arguments;
    };
    run_well(program(command("one", "1")));
    const ProgramResult result = run_well(on_ranks(run.ranks, command("many", run.threads)));
    CHECK(lines_of(result.out).size() == (has_field ? 2 : 1));
    CHECK((read_all(folder / "one.pfm") == read_all(folder / "many.pfm")));
    CHECK(counts_of(folder / "one.json") == counts_of(folder / "many.json"));
    if (has_field) CHECK((read_all(folder / "one.field") == read_all(folder / "many.field")));
    const json stats = json::parse(read_all(folder / "many.json"));
    CHECK(stats["ranks"] == run.ranks);
    CHECK(stats["bytes_sent"] > 0);
    CHECK(stats["seconds"]["communicate"] > 0.0);
}

}  // namespace

TEST_CASE("jobs write the files of one process") {
    check_job({"default", "on", 2, "1"});
    check_job({"reinforcement", "off", 3, "1"});
}

TEST_CASE("jobs of any size write the files of one process", "[merge]") {
    for (const int ranks : {2, 3, 5, 8})
        for (const char* threads : {"1", "2"})
            for (const char* nee : {"off", "on"})
                for (const char* method : {"default", "precomputed", "reinforcement"})
                    check_job({method, nee, ranks, threads});
}

TEST_CASE("a job that is asked to stop leaves a checkpoint, from which jobs of other sizes go on") {
    const TempDir folder;
    const Arguments endless = render(folder / "a.pfm", "1000000000",
                                     {"--method", "reinforcement", "--checkpoint", folder / "c", "--checkpoint-every",
                                      "0", "--stats", folder / "a.json"});
    RunningProgram running(
        joined(joined(kLauncher, told_rank(folder / "pid", endless)), joined({":", "-n", "1"}, program(endless))),
        kSetup);
    REQUIRE(running.wait_until([&] { return fs::exists(folder / "c"); }));
    kill(number_in(folder / "pid"), SIGTERM);
    const ProgramResult result = running.wait();
    CAPTURE(result.err);
    CHECK(result.code == 130);
    const std::string spp = std::to_string(json::parse(read_all(folder / "a.json"))["spp"].get<std::uint32_t>() + 2);
    const auto rest = [&](const std::string& name) {
        return render(folder / name, spp, {"--method", "reinforcement", "--resume", folder / "c"});
    };
    run_well(on_ranks(3, rest("b.pfm")));
    run_well(program(rest("d.pfm")));
    run_well(program(render(folder / "whole.pfm", spp, {"--method", "reinforcement"})));
    CHECK((read_all(folder / "b.pfm") == read_all(folder / "whole.pfm")));
    CHECK((read_all(folder / "d.pfm") == read_all(folder / "whole.pfm")));
}

TEST_CASE("a rank that is killed ends the job with one message, which names the checkpoint") {
    const TempDir folder;
    const Arguments endless =
        render(folder / "a.pfm", "1000000000",
               {"--method", "reinforcement", "--checkpoint", folder / "c", "--checkpoint-every", "0"});
    RunningProgram running(joined(joined(kLauncher, joined({"-n", "1"}, program(endless))),
                                  joined({":"}, told_rank(folder / "pid", endless))),
                           kSetup);
    REQUIRE(running.wait_until([&] { return fs::exists(folder / "c"); }));
    kill(number_in(folder / "pid"), SIGKILL);
    const ProgramResult result = running.wait();
    CAPTURE(result.err);
    CHECK(result.code != 0);
    CHECK(result.code != 124);
    CHECK(errors_in(result.err) == 1);
    CHECK_THAT(result.err, contains("rank 1 (") && contains("has ended") && contains("--resume"));
    CHECK((folder.names() == std::vector<std::string>{"c", "pid"}));
    run_well(program(render(folder / "b.pfm", "1", {"--method", "reinforcement", "--resume", folder / "c"})));
}

TEST_CASE("a scene that cannot be opened ends the job with one message and code 3") {
    const TempDir folder;
    const ProgramResult result =
        RunningProgram(on_ranks(2, {"render", folder / "none.obj", "-o", folder / "a.pfm"}), kSetup).wait();
    CAPTURE(result.err);
    CHECK(result.code == 3);
    CHECK(errors_in(result.err) == 1);
    CHECK(folder.names().empty());
}

TEST_CASE("scenes are read by rank 0 alone and sent to the others") {
    const TempDir folder;
    const TempDir elsewhere;
    fs::copy(PL_SOURCE_DIR "/assets/scenes/cornell", folder.path(), fs::copy_options::recursive);
    const Arguments arguments{"render", "./cornell.json", "-o", "a.pfm", "--size", "16x16", "--spp", "2"};
    run_well(joined(joined(kLauncher, joined({"-wdir", folder.path().string(), "-n", "1"}, program(arguments))),
                    joined({":", "-wdir", elsewhere.path().string(), "-n", "1"}, program(arguments))));
    CHECK(fs::exists(folder / "a.pfm"));
    CHECK(elsewhere.names().empty());
}

namespace {

Arguments bench(const std::string& folder, const std::string& scene) {
    return {"bench",           scene,   "-o",    folder, "--backend", "cpu",
            "--size",          "16x16", "--spp", "8",    "--seeds",   "2",
            "--reference-spp", "32",    "-t",    "1",    "--method",  "default,reinforcement"};
}

/// All of a bench's runs but times and hosts. Of the points the first and the last one, which no busy machine leaves out.
json runs_of(const std::string& folder) {
    json runs = json::parse(read_all(folder + "/results.json")).at("runs");
    for (json& run : runs) {
        for (const char* member : {"host", "measure_seconds"}) run.erase(member);
        run["points"] = json::array({run.at("points").front(), run.at("points").back()});
        for (json& point : run.at("points")) point.erase("seconds");
    }
    return runs;
}

}  // namespace

TEST_CASE("a bench over ranks has the numbers of one process, and names the hosts") {
    const TempDir folder;
    run_well(program(bench(folder / "one", "cornell")));
    run_well(on_ranks(3, bench(folder / "many", "cornell")));
    CHECK((runs_of(folder / "one") == runs_of(folder / "many")));
    const json results = json::parse(read_all(folder / "many/results.json"));
    CHECK(results.at("complete") == true);
    for (const json& run : results.at("runs")) CHECK_FALSE(run.at("host").get<std::string>().empty());
    for (const char* name : {"one", "many"})
        CHECK(fs::exists(folder / (name + std::string("/pictures/cornell-reinforcement-cpu-8.exr"))));
}

TEST_CASE("a rank that cannot open the scene of a bench ends it with one message and code 3") {
    const TempDir folder;
    const TempDir elsewhere;
    fs::copy(PL_SOURCE_DIR "/assets/scenes/cornell", folder.path(), fs::copy_options::recursive);
    const Arguments arguments = bench("b", "./cornell.json");
    const ProgramResult result =
        RunningProgram(
            joined(joined(kLauncher, joined({"-wdir", folder.path().string(), "-n", "1"}, program(arguments))),
                   joined({":", "-wdir", elsewhere.path().string(), "-n", "1"}, program(arguments))),
            kSetup)
            .wait();
    CAPTURE(result.err);
    CHECK(result.code == 3);
    CHECK(errors_in(result.err) == 1);
    CHECK_THAT(result.err, contains("rank 1 (") && contains("cornell.json"));
}

TEST_CASE("a bench over ranks that is interrupted keeps its finished runs and goes on", "[merge]") {
    const TempDir folder;
    const Arguments arguments = bench(folder / "b", "cornell");
    RunningProgram running(
        joined(joined(kLauncher, told_rank(folder / "pid", arguments)), joined({":", "-n", "1"}, program(arguments))),
        kSetup);
    REQUIRE(running.wait_until([&] { return fs::exists(folder / "b/runs") && !fs::is_empty(folder / "b/runs"); }));
    kill(number_in(folder / "pid"), SIGTERM);
    const ProgramResult result = running.wait();
    CAPTURE(result.err);
    CHECK((result.code == 130 || result.code == 0));  // 0: it had ended before the signal
    run_well(on_ranks(2, arguments));
    run_well(program(bench(folder / "one", "cornell")));
    CHECK((runs_of(folder / "b") == runs_of(folder / "one")));
}

TEST_CASE("ranks of another version are refused with one message and code 4") {
    const TempDir folder;
    const ProgramResult result =
        RunningProgram(joined(on_ranks(1, render(folder / "a.pfm", "1", {})), {":", "-n", "1", PL_OTHER_VERSION}),
                       kSetup)
            .wait();
    CAPTURE(result.err);
    CHECK(result.code == 4);
    CHECK(errors_in(result.err) == 1);
    CHECK_THAT(result.err, contains("rank 1 (") && contains("another version of the program"));
    CHECK(folder.names().empty());
}

TEST_CASE("a refused option is told once", "[merge]") {
    const ProgramResult result = RunningProgram(on_ranks(3, {"render", "cornell", "--bogus"}), kSetup).wait();
    CHECK(result.code == 2);
    CHECK(errors_in(result.err) == 1);
}

#if PL_VIEWER
TEST_CASE("all ranks render the picture of a window, which follows its keys and has the bits of one process") {
    const TempDir folder;
    // The camera moves before anything is learned, so that the field depends on no time.
    write_all(folder / "script", "0 wait shown_device ~ 2 ranks\n1 key W\n4 keyup W\n5 wait moving == no\n"
                                 "6 tap Home\n7 wait at_home == yes\n8 wait shown_divider == 1\n9 tap 3\n"
                                 "10 wait shown_method == reinforcement\n11 wait shown_spp == 6\n"
                                 "12 tap s ctrl\n13 wait message ~ saved\n14 quit\n");
    const Arguments settings{"cornell", "--size", "48x40", "--volumes", "60", "--spp", "6", "-t", "1"};
    const Arguments window =
        joined({"view"}, joined(settings, {"--script", folder / "script", "--software", "--window", "800x600"}));
    ProgramSetup setup = kSetup;
    setup.folder = folder.path();
    setup.unset = {"DISPLAY"};
    setup.set.push_back("SDL_VIDEODRIVER=dummy");
    const ProgramResult result = RunningProgram(on_ranks(2, window), setup).wait();
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    run_well(program(joined({"render"}, joined(settings, {"--method", "reinforcement", "-o", folder / "one.exr"}))));
    std::string saved;
    for (const std::string& name : folder.names())
        if (name.ends_with(".exr") && name != "one.exr") saved = name;
    REQUIRE_FALSE(saved.empty());
    CHECK((read_exr(folder / saved).pixels == read_exr(folder / "one.exr").pixels));
}
#endif

}  // namespace pl::test
