// --checkpoint, --checkpoint-every and --resume from a shell.
// --save-field and --load-field from a shell.
#include <csignal>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
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
    if (stats["guiding"].is_object()) stats["guiding"].erase("guided_share");
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
    check_refused(3, resume("version"), "version: checkpoint of another version: expected 13, got 99");
    check_refused(3, resume("text"), "text: not a checkpoint");
    check_refused(3, resume("none"), "no such file");
    check_refused(2, render_refined(folder / "x.pfm", 2, {"--checkpoint-every", "3"}), "expected --checkpoint FILE");
    check_refused(1, render_refined(folder / "x.pfm", 2, {"--checkpoint", folder / "gone/c"}),
                  "gone/c: cannot be written");
}

namespace {

using nlohmann::json;

const std::vector<std::string> kLearningMethods{"precomputed", "reinforcement"};

Arguments render_door(const std::string& output, const Arguments& more) {
    return joined({"render", "door", "-o", output, "--size", "32x32", "--spp", "4", "--guiding", "always"}, more);
}

/// Few volumes, so that tables have samples after a few passes.
const Arguments kSmallField{"--volumes", "60", "--bins", "64"};

json stats_in(const TempDir& folder) { return json::parse(read_all(folder / "s.json")); }

}  // namespace

TEST_CASE("a run that loads a field goes on from it") {
    for (const std::string& method : kLearningMethods) {
        CAPTURE(method);
        const TempDir folder;
        run_well(joined(render_door(folder / "a.pfm", {"--method", method, "--save-field", folder / "f"}),
                        joined(kSmallField, {"--stats", folder / "s.json"})));
        const json first = stats_in(folder);
        run_well(render_door(folder / "b.pfm", {"--load-field", folder / "f", "--save-field", folder / "g", "--stats",
                                                folder / "s.json"}));
        const json second = stats_in(folder);
        CHECK(second["method"] == method);
        CHECK(second["field"]["volumes"] == first["field"]["volumes"]);
        CHECK(second["field"]["bins"] == 64);
        CHECK(second["spp"] == 4);
        CHECK(second["paths"] == 4 * 32 * 32);
        // The map of the first run is neither computed nor charged again.
        CHECK(second["seconds"]["place"] == 0.0);
        CHECK(second["seconds"]["precompute"] == 0.0);
        CHECK(second["seconds"]["load"] > 0.0);
        if (method == "precomputed") {
            CHECK(first["seconds"]["precompute"] > 0.0);
            CHECK(second["field"]["records"] == first["field"]["records"]);
            CHECK(second["field"]["passes"] == 1);
            // The map is constant: the picture is the same, and so is the file, with the time of the first run.
            CHECK(read_all(folder / "a.pfm") == read_all(folder / "b.pfm"));
            CHECK(read_all(folder / "f") == read_all(folder / "g"));
        } else {
            CHECK(first["field"]["passes"] == 4);
            CHECK(second["field"]["passes"] == 8);
            CHECK(second["field"]["records"] > first["field"]["records"]);
            CHECK(read_all(folder / "a.pfm") != read_all(folder / "b.pfm"));
            // Guided paths find the light through the door's gap, and the first pass of a new field has none.
            CHECK(second["zero_contribution_paths"] < first["zero_contribution_paths"]);
        }
        CHECK((folder.names() == std::vector<std::string>{"a.pfm", "b.pfm", "f", "g", "s.json"}));
    }
}

TEST_CASE("field files have the same bits for any number of threads") {
    const TempDir folder;
    for (const std::string& method : kLearningMethods) {
        const auto saved = [&](const Arguments& more) {
            run_well(joined(render_door(folder / "x.pfm", {"--method", method, "--save-field", folder / "f"}),
                            joined(kSmallField, more)));
            return read_all(folder / "x.pfm");
        };
        CAPTURE(method);
        const std::string picture = saved({"-t", "1"});
        const std::string field = read_all(folder / "f");
        CHECK(saved({"-t", "2"}) == picture);
        CHECK(read_all(folder / "f") == field);

        const auto loaded = [&](const Arguments& more) {
            run_well(render_door(folder / "y.pfm", joined({"--load-field", folder / "f"}, more)));
            return read_all(folder / "y.pfm");
        };
        const std::string next = loaded({});
        CHECK(loaded({"-t", "1"}) == next);
    }
}

TEST_CASE("the command in a picture loads the field again") {
    const TempDir folder;
    run_well(joined(render_door(folder / "a.png", {"--method", "reinforcement", "--save-field", folder / "f"}),
                    kSmallField));
    run_well(render_door(folder / "b.png", {"--load-field", folder / "f"}));
    ImageMetadata metadata;
    const std::vector<std::uint8_t> pixels = read_png8(folder / "b.png", &metadata).rgb;
    const auto command =
        std::find_if(metadata.begin(), metadata.end(), [](const auto& entry) { return entry.first == "command"; });
    REQUIRE(command != metadata.end());
    CHECK_THAT(command->second, contains("--load-field"));
    std::filesystem::remove(folder / "b.png");
    REQUIRE(run_shell(command->second).code == 0);
    CHECK((read_png8(folder / "b.png").rgb == pixels));
}

TEST_CASE("a loaded field is inspected as it is, unless training is requested") {
    for (const std::string& method : kLearningMethods) {
        CAPTURE(method);
        const TempDir folder;
        const auto inspected = [&](const Arguments& more) {
            run_well(
                joined({"inspect", "door", "--pixel", "16,28", "--size", "32x32", "-o", folder / "x.json"}, more));
            return json::parse(read_all(folder / "x.json"));
        };
        const json first =
            inspected(joined(kSmallField, {"--method", method, "--spp", "3", "--save-field", folder / "f"}));
        const json again = inspected({"--load-field", folder / "f"});
        CHECK(again["method"] == method);
        CHECK(again["spp"] == 0);
        for (const char* key : {"volume", "position", "radiance", "probability", "visits", "mean_radiance"})
            CHECK(again[key] == first[key]);
        if (method == "reinforcement") {
            const json trained = inspected({"--load-field", folder / "f", "--spp", "2"});
            CHECK(trained["spp"] == 2);
            CHECK(trained["radiance"] != first["radiance"]);
        }
    }
}

TEST_CASE("fields that do not fit are refused with the right exit code, and no picture is written") {
    const TempDir folder;
    run_well(joined(render_door(folder / "a.pfm", {"--method", "reinforcement", "--save-field", folder / "f"}),
                    kSmallField));
    std::filesystem::remove(folder / "a.pfm");
    const std::string good = read_all(folder / "f");
    std::string damaged = good;
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 4);
    write_all(folder / "damaged", damaged);
    write_all(folder / "cut", good.substr(0, good.size() / 2));
    write_all(folder / "text", "v 0 0 0\n");
    struct Wrong {
        int code;
        Arguments arguments;
        std::string message;
    };
    const std::vector<Wrong> wrongs{
        {3, render_door(folder / "a.pfm", {"--load-field", folder / "damaged"}),
         "damaged: damaged field: expected the check"},
        {3, render_door(folder / "a.pfm", {"--load-field", folder / "cut"}), "cut: damaged field: expected"},
        {3, render_door(folder / "a.pfm", {"--load-field", folder / "text"}), "text: not a learned field"},
        {3, render_door(folder / "a.pfm", {"--load-field", folder / "gone"}), "gone: cannot be read: no such file"},
        {3,
         {"render", "cornell", "-o", folder / "a.pfm", "--load-field", folder / "f"},
         "f: the field was learned in an"},
        {3,
         {"inspect", "cornell", "--pixel", "1,1", "-o", folder / "a.csv", "--load-field", folder / "f"},
         "f: the field was learned in another scene: expected scene hash"},
        {2, render_door(folder / "a.pfm", {"--load-field", folder / "f", "--method", "default"}),
         "--method reinforcement"},
        {2, render_door(folder / "a.pfm", {"--load-field", folder / "f", "--bins", "256"}), "learned with --bins 64"},
        {2, render_door(folder / "a.pfm", {"--save-field", folder / "g"}), "--method default learns nothing"},
        {3,
         {"view", "cornell", "--backend", "cpu", "--load-field", folder / "f"},
         "f: the field was learned in another"},
        {3, {"view", "door", "--backend", "cpu", "--load-field", folder / "gone"}, "gone: cannot be read"},
        {2, {"view", "door", "--save-field", folder / "g"}, "--save-field: the viewer saves the learned field when"},
        {1,
         render_door(folder / "a.pfm",
                     {"--method", "reinforcement", "--save-field", folder / "gone/g", "--time-limit", "1000000"}),
         "gone/g: cannot be written"},
    };
    for (const Wrong& wrong : wrongs) check_refused(wrong.code, wrong.arguments, wrong.message);
    CHECK((folder.names() == std::vector<std::string>{"cut", "damaged", "f", "text"}));
}

TEST_CASE("an interruption keeps the field learned so far, and another run completes it") {
    const TempDir folder;
    RunningProgram running(
        program({"render", "door", "-o", folder / "a.pfm", "--size", "32x32", "--spp", "1000000000", "--method",
                 "reinforcement", "--volumes", "60", "--save-field", folder / "f", "--json"}));
    REQUIRE(running.wait_for_output("\"event\":\"progress\""));
    running.send(SIGINT);
    const ProgramResult result = running.wait();
    CHECK(result.code == 130);
    CHECK_THAT(result.out, contains("\"event\":\"field\""));
    CHECK((folder.names() == std::vector<std::string>{"a.pfm", "f"}));
    run_well(render_door(folder / "b.pfm", {"--load-field", folder / "f", "--stats", folder / "s.json"}));
    CHECK(stats_in(folder)["field"]["passes"] > 4);
}

TEST_CASE("a radiance map that was interrupted is completed by the run that loads it") {
    const TempDir folder;
    const Arguments map{"render", "door", "--size", "16x16", "--spp", "1", "--method", "precomputed", "-t", "2"};
    const Arguments size{"--volumes", "500", "--bins", "256"};
    run_well(joined(map, joined(size, {"-o", folder / "whole.pfm"})));
    RunningProgram running(
        program(joined(map, joined(size, {"-o", folder / "part.pfm", "--save-field", folder / "f", "--json"}))));
    REQUIRE(running.wait_for_output("\"event\":\"start\""));
    running.send(SIGINT);
    const int code = running.wait().code;
    CHECK((code == 130 || code == 0));  // 0: it had ended before the signal
    run_well(joined(map, {"-o", folder / "rest.pfm", "--load-field", folder / "f"}));
    CHECK(read_all(folder / "rest.pfm") == read_all(folder / "whole.pfm"));
}

TEST_CASE("a killed program leaves the old field") {
    const TempDir folder;
    write_all(folder / "f", "old");
    RunningProgram running(program({"render", "door", "-o", folder / "a.pfm", "--size", "16x16", "--method",
                                    "reinforcement", "--spp", "1000000000", "--save-field", folder / "f", "--json"}));
    REQUIRE(running.wait_for_output("\"event\":\"start\""));
    running.send(SIGKILL);
    CHECK(running.wait().code == 128 + SIGKILL);
    CHECK(read_all(folder / "f") == "old");
}

}  // namespace pl::test
