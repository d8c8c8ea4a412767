// What the program tells: statistics, events, progress, information, and where each of them goes.
#include <csignal>

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "tests/app/stats_keys.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::ordered_json;

std::vector<std::string> keys_of(const ordered_json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

ordered_json stats_of(const Arguments& more) {
    const TempDir folder;
    Arguments arguments{
        "render", "cornell", "-o", folder / "x.pfm", "--stats", folder / "s.json", "--size", "20x12", "--spp",
        "4",      "-t",      "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_program(arguments);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return ordered_json::parse(read_all(folder / "s.json"));
}

/// A terminal of its own, as a program sees it.
class Terminal {
public:
    Terminal() : handle_(posix_openpt(O_RDWR | O_NOCTTY)) {
        REQUIRE(handle_ >= 0);
        REQUIRE(grantpt(handle_) == 0);
        REQUIRE(unlockpt(handle_) == 0);
        // Holding the other end open keeps what was written readable after the program has ended.
        other_end_ = open(ptsname(handle_), O_RDWR | O_NOCTTY);
    }
    ~Terminal() {
        close(other_end_);
        close(handle_);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    std::string device() const { return ptsname(handle_); }
    std::string text() const {
        fcntl(handle_, F_SETFL, O_NONBLOCK);
        std::string all;
        char buffer[4096];
        for (ssize_t count; (count = read(handle_, buffer, sizeof buffer)) > 0;)
            all.append(buffer, static_cast<std::size_t>(count));
        return all;
    }

private:
    int handle_;
    int other_end_ = -1;
};

}  // namespace

TEST_CASE("statistics have every key in its order, and plausible values") {
    for (const std::string method : {"default", "precomputed", "reinforcement"}) {
        CAPTURE(method);
        const ordered_json stats = stats_of({"--method", method, "--volumes", "60", "--bins", "64"});
        CHECK(keys_of(stats) == kStatsKeys);
        CHECK(keys_of(stats["seconds"]) == kSecondsKeys);
        CHECK(stats["schema"] == "pathlight.stats/1");
        CHECK(stats["scene"] == "cornell");
        CHECK(stats["scene_hash"].get<std::string>().size() == 16);
        CHECK(stats["method"] == method);
        CHECK(stats["view"] == "beauty");
        CHECK(stats["backend"] == "cpu");
        CHECK_FALSE(stats["device"].get<std::string>().empty());
        CHECK(stats["threads"] == 2);
        CHECK(stats["width"] == 20);
        CHECK(stats["height"] == 12);
        CHECK(stats["spp"] == 4);
        CHECK(stats["seed"] == 1);
        CHECK(stats["max_depth"] == 64);
        CHECK(stats["nee"] == false);
        CHECK(stats["paths"] == 20 * 12 * 4);
        CHECK(stats["segments"] >= stats["paths"]);
        CHECK(stats["shadow_rays"] == 0);
        CHECK(stats["zero_contribution_paths"] < stats["paths"]);
        CHECK(stats["zero_contribution_paths"] > 0);
        CHECK(stats["mean_path_length"].get<double>() ==
              Approx(stats["segments"].get<double>() / stats["paths"].get<double>()));
        CHECK(stats["invalid_samples"] == 0);
        CHECK(stats["escaped_paths"] <= stats["paths"]);
        CHECK(stats["mean_radiance"].size() == 3);
        CHECK(stats["effects_needed"].empty());
        CHECK(stats["effects_compiled"].empty());
        CHECK_THAT(stats["kernel"].get<std::string>(), contains(method));

        double sum = 0.0;
        for (const auto& [name, seconds] : stats["seconds"].items()) {
            CHECK(seconds.get<double>() >= 0.0);
            if (name != "total") sum += seconds.get<double>();
        }
        CHECK(stats["seconds"]["total"].get<double>() == Approx(sum));
        CHECK(stats["seconds"]["render"] > 0.0);
        CHECK((stats["seconds"]["precompute"] > 0.0) == (method == "precomputed"));
        CHECK((stats["seconds"]["learn"] > 0.0) == (method == "reinforcement"));
        CHECK((stats["seconds"]["place"] > 0.0) == (method != "default"));
    }
}

TEST_CASE("statistics of the field: null without one, complete with one") {
    CHECK(stats_of({})["field"].is_null());
    const ordered_json field = stats_of({"--method", "reinforcement", "--volumes", "60", "--bins", "64"})["field"];
    CHECK(keys_of(field) == kFieldKeys);
    CHECK(field["volumes"] >= 60);
    CHECK(field["bins"] == 64);
    CHECK(field["bytes"] > 60 * 64 * 4);
    CHECK(field["passes"] == 4);
    CHECK(field["records"] > 0);
    CHECK(field["added_volumes"] == 0);
}

TEST_CASE("statistics tell how many volumes refinement added") {
    const ordered_json field = stats_of(
        {"--method", "reinforcement", "--volumes", "60", "--bins", "16", "--refine", "0.5", "--spp", "17"})["field"];
    CHECK(field["added_volumes"] > 20);
    CHECK(field["added_volumes"] <= field["volumes"].get<int>() / 3);
}

TEST_CASE("statistics of next-event estimation") {
    const ordered_json stats = stats_of({"--nee", "on"});
    CHECK(stats["nee"] == true);
    CHECK(stats["shadow_rays"] > 0);
    CHECK(stats["effects_needed"] == ordered_json::array({"next-event-estimation"}));
    CHECK(stats["effects_compiled"] == ordered_json::array({"next-event-estimation"}));
    // Light samples find the lamp: fewer paths bring nothing.
    CHECK(stats["zero_contribution_paths"] < stats_of({})["zero_contribution_paths"]);
}

TEST_CASE("the scene's hash follows the light, not the file's name or camera") {
    const TempDir folder;
    const auto hash_of = [&](const std::string& name, const std::string& obj, const std::string& more) {
        write_all(folder / (name + ".obj"), obj);
        write_all(folder / (name + ".json"),
                  "{\"schema\": \"pathlight.scene/1\", \"obj\": \"" + name + ".obj\"" + more + "}");
        const ProgramResult result = run_program({"info", folder / (name + ".json"), "--json"});
        REQUIRE(result.code == 0);
        return ordered_json::parse(lines_of(result.out).back())["scene_hash"].get<std::string>();
    };
    const std::string triangle = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";
    const std::string hash = hash_of("a", triangle, "");
    CHECK(hash_of("b", triangle, "") == hash);
    CHECK(hash_of("a", triangle, ", \"camera\": {\"eye\": [0, 0, 9], \"target\": [0, 0, 0]}") == hash);
    CHECK(hash_of("a", "v -1 -1 0\nv 1 -1 0\nv 0 1.0000001 0\nf 1 2 3\n", "") != hash);
    CHECK(hash_of("a", triangle, ", \"environment\": {\"radiance\": [1, 1, 1]}") != hash);
}

TEST_CASE("events are lines of JSON on standard output and nothing else is") {
    const TempDir folder;
    for (const Arguments& arguments : std::vector<Arguments>{
             {"render", "cornell", "-o", folder / "x.png", "--size", "8x8", "--spp", "2", "--json"},
             {"inspect", "cornell", "--pixel", "4,7", "-o", folder / "x.csv", "--size", "8x8", "--spp", "2",
              "--json"},
             {"info", "cornell", "--json"},
             {"devices", "--json"},
             {"--list-methods", "--json"},
             {"--list-views", "--json"}}) {
        const ProgramResult result = run_program(arguments);
        CAPTURE(arguments, result.out);
        REQUIRE(result.code == 0);
        REQUIRE_FALSE(lines_of(result.out).empty());
        for (const std::string& line : lines_of(result.out)) {
            const ordered_json event = ordered_json::parse(line);
            CHECK(event.at("schema") == "pathlight.event/1");
            CHECK(event.contains("event"));
        }
    }
    const ProgramResult render =
        run_program({"render", "cornell", "-o", folder / "x.png", "--size", "8x8", "--spp", "2", "--json"});
    const ordered_json last = ordered_json::parse(lines_of(render.out).back());
    CHECK(last["event"] == "done");
    CHECK(keys_of(last["stats"]) == kStatsKeys);
}

TEST_CASE("results go to standard output, messages to standard error, and quiet is quiet") {
    const TempDir folder;
    const Arguments quick{"render", "cornell", "-o", folder / "x.png", "--size", "8x8", "--spp", "2"};
    const auto with = [&](const Arguments& more) {
        Arguments all = quick;
        all.insert(all.end(), more.begin(), more.end());
        return run_program(all);
    };
    const ProgramResult plain = with({});
    CHECK_THAT(plain.out, contains("x.png") && contains("8x8"));
    CHECK(plain.err.empty());
    const ProgramResult quiet = with({"-q"});
    CHECK(quiet.out.empty());
    CHECK(quiet.err.empty());
    const ProgramResult verbose = with({"-v"});
    CHECK_THAT(verbose.err, contains("kernel "));
    const ProgramResult logged = with({"--log-file", folder / "log"});
    CHECK(logged.err.empty());
    CHECK_THAT(read_all(folder / "log"), contains("kernel "));
    CHECK(run_program({"info", "cornell", "-q"}).out == run_program({"info", "cornell"}).out);
}

TEST_CASE("a warning about the scene is told once") {
    const TempDir folder;
    write_all(folder / "a.obj", "usemtl nowhere\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n");
    const ProgramResult result = run_program({"info", folder / "a.obj"});
    CHECK(result.code == 0);
    CHECK(lines_of(result.err).size() == 1);
    CHECK_THAT(result.err, contains("warning: ") && contains("nowhere"));
    CHECK(run_program({"info", folder / "a.obj", "-q"}).err.empty());
}

TEST_CASE("progress is a bar on a terminal only") {
    const TempDir folder;
    const Arguments endless{"render", "cornell", "-o", folder / "x.png", "--size", "64x64", "--spp", "1000000000"};
    {
        const Terminal terminal;
        RunningProgram running(program(endless), {.set = {"TERM=xterm"}, .terminal = terminal.device()});
        std::string text;
        REQUIRE(running.wait_until([&] { return (text += terminal.text()).find(" spp") != std::string::npos; }));
        running.send(SIGINT);
        CHECK(running.wait().code == 130);
        CHECK_THAT(text, contains("\r\033[K["));
    }
    // Long enough for five bars.
    for (const char* silent : {"--no-progress", "-q"}) {
        const Terminal terminal;
        Arguments arguments = endless;
        arguments.insert(arguments.end(), {"--time-limit", "0.5", silent});
        CHECK(run_program(arguments, {.set = {"TERM=xterm"}, .terminal = terminal.device()}).code == 0);
        CHECK(terminal.text().empty());
    }
}

TEST_CASE("without a terminal progress is plain lines", "[merge]") {
    const TempDir folder;
    RunningProgram running(
        program({"render", "cornell", "-o", folder / "x.png", "--size", "16x16", "--spp", "1000000000"}));
    REQUIRE(running.wait_until([&] { return running.err().find(" spp") != std::string::npos; }));
    running.send(SIGINT);
    const ProgramResult result = running.wait();
    CHECK(result.code == 130);
    CHECK(result.err.find_first_of("\r\033") == std::string::npos);
}

TEST_CASE("errors are red on a terminal unless NO_COLOR is set") {
    const auto text_with = [](const std::vector<std::string>& set) {
        const Terminal terminal;
        CHECK(run_program({"info", "cornel"}, {.unset = {"NO_COLOR"}, .set = set, .terminal = terminal.device()})
                  .code == 3);
        return terminal.text();
    };
    CHECK_THAT(text_with({"TERM=xterm"}), contains("\033[1;31merror: "));
    CHECK(text_with({"TERM=xterm", "NO_COLOR=1"}).find('\033') == std::string::npos);
    CHECK(text_with({"TERM=dumb"}).find('\033') == std::string::npos);
}

TEST_CASE("info tells what the scene holds and which effects it needs, and why") {
    const ProgramResult cornell = run_program({"info", "cornell", "--json"});
    const ordered_json box = ordered_json::parse(lines_of(cornell.out).back());
    CHECK(box["triangles"] > 10);
    CHECK(box["lights"] == 2);
    CHECK(box["materials"].size() == 4);
    CHECK(box["camera"]["eye"] == ordered_json::array({278.0, 273.0, -800.0}));
    CHECK(box["effects_needed"].empty());

    const TempDir folder;
    write_all(folder / "a.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvn 0 0 1\nvn 0.1 0 1\nf 1//1 2//1 3//2\n");
    write_all(folder / "a.json",
              R"({"schema": "pathlight.scene/1", "obj": "a.obj", "environment": {"radiance": [1, 2, 3]}})");
    const ProgramResult both = run_program({"info", folder / "a.json", "--json"});
    const ordered_json effects = ordered_json::parse(lines_of(both.out).back())["effects_needed"];
    REQUIRE(effects.size() == 2);
    CHECK(effects[0]["name"] == "smooth-normals");
    CHECK_THAT(effects[0]["reason"].get<std::string>(), contains("1 triangles"));
    CHECK(effects[1]["name"] == "environment");
    CHECK_THAT(effects[1]["reason"].get<std::string>(), contains("1,2,3"));
    CHECK_THAT(run_program({"info", folder / "a.json"}).out, contains("environment: ") && contains("kernel"));
}

TEST_CASE("devices tells what there is, and why something is not") {
    const ProgramResult result = run_program({"devices", "--json"});
    const std::vector<std::string> lines = lines_of(result.out);
    REQUIRE(lines.size() >= 2);
    const ordered_json cpu = ordered_json::parse(lines[0]);
    CHECK(cpu["backend"] == "cpu");
    CHECK(cpu["available"] == true);
    // One line for every GPU, or one that says why there is none.
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const ordered_json cuda = ordered_json::parse(lines[i]);
        CHECK(cuda["backend"] == "cuda");
        CHECK(cuda["available"] == cuda["reason"].is_null());
        if (cuda["available"] == false) CHECK_FALSE(cuda["reason"].get<std::string>().empty());
        if (lines.size() > 2) CHECK_FALSE(cuda["device"].is_null());
    }
}

}  // namespace pl::test
