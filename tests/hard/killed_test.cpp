// The program is killed at many moments: no file is ever half of one, and the same command goes on or starts over.
#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <thread>

#include <nlohmann/json.hpp>

#include "core/io/field_file.h"
#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

using namespace pl;
using namespace pl::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Starts the command and kills it after so many seconds, unless it has ended before. No verdict depends on the moment.
void kill_after(const Arguments& command, double seconds) {
    RunningProgram running(program(command));
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    running.send(SIGKILL);
    const int code = running.wait().code;
    CHECK((code == 0 || code == 128 + SIGKILL));
}

/// Names in a folder that are neither expected nor hidden files of a
/// killed writer.
std::vector<std::string> strange_names(const fs::path& folder, const std::vector<std::string>& expected) {
    std::vector<std::string> strange;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        const bool temporary = name.starts_with(".pathlight-") && name.ends_with(".tmp");
        if (!temporary && std::find(expected.begin(), expected.end(), name) == expected.end())
            strange.push_back(name);
    }
    return strange;
}

Arguments render_command(const TempDir& folder) {
    return {"render",
            "door",
            "-o",
            folder / "x.exr",
            "--size",
            "256x256",
            "--spp",
            "2",
            "--method",
            "reinforcement",
            "--volumes",
            "3000",
            "--save-field",
            folder / "x.field",
            "--stats",
            folder / "x.json",
            "-q"};
}

/// Moments of a run and beyond its end, so that many fall into the writing of files.
void kill_renders(int kills) {
    const TempDir folder;
    const Clock::time_point start = Clock::now();
    REQUIRE(run_program(render_command(folder)).code == 0);
    const double whole = seconds_since(start);
    const LinearImage expected = read_exr(folder / "x.exr");
    const std::string field = read_all(folder / "x.field");
    std::mt19937 random(7);
    for (int i = 0; i < kills; ++i) {
        // Half of them at the end, where files are written.
        const double share =
            std::uniform_real_distribution<double>(i % 2 == 0 ? 0.0 : 0.8, i % 2 == 0 ? 0.9 : 1.05)(random);
        for (const char* name : {"x.exr", "x.field", "x.json"}) write_all(folder / name, "old");
        kill_after(render_command(folder), share * whole);
        CAPTURE(i, share);
        CHECK(strange_names(folder.path(), {"x.exr", "x.field", "x.json"}).empty());
        if (read_all(folder / "x.exr") != "old") CHECK(read_exr(folder / "x.exr").pixels == expected.pixels);
        if (read_all(folder / "x.field") != "old") CHECK_NOTHROW(read_field(folder / "x.field"));
        const std::string stats = read_all(folder / "x.json");
        if (stats != "old") CHECK_NOTHROW(json::parse(stats));
    }
    REQUIRE(run_program(render_command(folder)).code == 0);
    CHECK(folder.names() == std::vector<std::string>{"x.exr", "x.field", "x.json"});
    CHECK(read_exr(folder / "x.exr").pixels == expected.pixels);
    CHECK(read_field(folder / "x.field").progress.records == read_field(folder / "x.field").progress.records);
    CHECK(read_all(folder / "x.field").size() == field.size());
}

Arguments bench_command(const TempDir& folder, const std::string& name) {
    return {"bench",           "cornell", "-o",        folder / name, "--size",          "16x16",
            "--spp",           "8",       "--seeds",   "2",           "--reference-spp", "64",
            "--backend",       "cpu",     "--volumes", "40",          "--bins",          "16",
            "--measure-share", "1000000", "-q"};
}

std::map<std::pair<std::string, int>, double> errors_in(const std::string& folder) {
    std::map<std::pair<std::string, int>, double> errors;
    const json results = json::parse(read_all(folder + "/results.json"));
    for (const json& run : results.at("runs"))
        if (!run.at("warm_up").get<bool>())
            errors[{run.at("method"), run.at("seed")}] = run.at("points").back().at("metrics").at("relmse");
    return errors;
}

/// Every file that is there can be read.
void check_readable(const fs::path& folder) {
    if (!fs::exists(folder)) return;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string suffix = entry.path().extension();
        CAPTURE(entry.path().string());
        if (entry.path().filename().string().starts_with(".pathlight-")) continue;
        if (suffix == ".json") CHECK_NOTHROW(json::parse(read_all(entry.path())));
        if (suffix == ".exr") CHECK_NOTHROW(read_exr(entry.path()));
    }
}

/// Hidden files of writers that were killed, in a folder and below.
int leftovers_in(const fs::path& folder) {
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        count += entry.path().filename().string().starts_with(".pathlight-") ? 1 : 0;
    return count;
}

void kill_benches(int kills) {
    const TempDir folder;
    const Clock::time_point start = Clock::now();
    REQUIRE(run_program(bench_command(folder, "whole")).code == 0);
    const double whole = seconds_since(start);
    std::mt19937 random(8);
    for (int i = 0; i < kills; ++i) {
        kill_after(bench_command(folder, "killed"), std::uniform_real_distribution<double>(0.0, whole)(random));
        CAPTURE(i);
        check_readable(folder / "killed");
    }
    const ProgramResult result = run_program(bench_command(folder, "killed"));
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    CHECK(json::parse(read_all(folder / "killed/results.json")).at("complete") == true);
    CHECK(errors_in(folder / "killed") == errors_in(folder / "whole"));
    CHECK(leftovers_in(folder / "killed") == 0);
}

void kill_references(int kills) {
    const TempDir folder;
    const Arguments command{"reference", "cornell", "-o", folder / "r", "--size", "32x32", "--spp", "200", "-q"};
    const Clock::time_point start = Clock::now();
    REQUIRE(run_program(command).code == 0);
    const double whole = seconds_since(start);
    std::map<std::string, std::string> expected;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "r"))
        if (entry.path().extension() == ".exr") expected[entry.path().filename()] = read_all(entry.path());
    REQUIRE_FALSE(expected.empty());
    fs::remove_all(folder / "r");
    std::mt19937 random(9);
    for (int i = 0; i < kills; ++i) {
        kill_after(command, std::uniform_real_distribution<double>(0.0, whole)(random));
        check_readable(folder / "r");
    }
    REQUIRE(run_program(command).code == 0);
    std::size_t found = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "r"))
        if (entry.path().extension() == ".exr") {
            const LinearImage picture = read_exr(entry.path());
            CHECK(picture.width == 32);
            ++found;
        }
    CHECK(found == expected.size());
}

}  // namespace

TEST_CASE("A render that is killed at any moment leaves whole files or the old ones", "[hard]") { kill_renders(8); }
TEST_CASE("A render that is killed at 200 moments leaves whole files or the old ones", "[hard][nightly]") {
    kill_renders(200);
}
TEST_CASE("A bench that is killed again and again ends with the same errors", "[hard]") { kill_benches(3); }
TEST_CASE("A bench that is killed at 100 moments ends with the same errors", "[hard][nightly]") { kill_benches(100); }
TEST_CASE("A reference that is killed again and again is completed", "[hard]") { kill_references(2); }
TEST_CASE("A reference that is killed at 100 moments is completed", "[hard][nightly]") { kill_references(100); }
