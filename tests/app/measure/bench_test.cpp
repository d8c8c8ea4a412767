// `pathlight bench` from a shell: its files, continuing after an interruption, references, and the gate.
#include <algorithm>
#include <csignal>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

Arguments bench(const std::string& folder, const Arguments& more = {}) {
    return joined({"bench", "cornell", "-o", folder, "--size", "16x16", "--spp", "8", "--seeds", "2",
                   "--reference-spp", "32", "--backend", "cpu", "--volumes", "40", "--bins", "16",
                   // Pictures this small cost less to render than to measure.
                   "--measure-share", "1000000"},
                  more);
}

json results_in(const std::string& folder) { return json::parse(read_all(folder + "/results.json")); }

void make_bench(const std::string& folder, const Arguments& more = {}) {
    const ProgramResult result = run_program(bench(folder, more));
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
}

/// Errors by method and seed.
std::map<std::pair<std::string, int>, double> errors_in(const std::string& folder) {
    std::map<std::pair<std::string, int>, double> errors;
    const json results = results_in(folder);
    for (const json& run : results.at("runs"))
        if (!run.at("warm_up").get<bool>())
            errors[{run.at("method"), run.at("seed")}] = run.at("points").back().at("metrics").at("relmse");
    return errors;
}

/// The folder's results with all charged times multiplied, as a gate.
std::string with_times(const TempDir& folder, double factor) {
    json results = results_in(folder / "b");
    for (json& run : results.at("runs"))
        for (json& point : run.at("points"))
            for (const char* clock : {"place", "precompute", "learn", "render"})
                point.at("seconds").at(clock) = factor * point.at("seconds").at(clock).get<double>();
    write_all(folder / "base.json", results.dump());
    return folder / "base.json";
}

}  // namespace

TEST_CASE("a bench leaves everything it knows") {
    const TempDir folder;
    make_bench(folder / "b");
    const json results = results_in(folder / "b");
    CHECK(results.at("schema") == "pathlight.bench/1");
    CHECK(results.at("complete") == true);
    CHECK(results.at("definitions").at("metrics").at("epsilon") == 0.01);
    CHECK(results.at("summary").size() == 3);
    CHECK(results.at("comparisons").size() == 2);
    CHECK(results.at("runs").size() == 3 * (1 + 2));
    int warm_ups = 0;
    for (const json& run : results.at("runs")) {
        warm_ups += run.at("warm_up").get<bool>();
        CHECK(run.at("learned_before") == "nothing");
        std::vector<int> steps;
        for (const json& point : run.at("points")) steps.push_back(point.at("spp"));
        CHECK((steps == std::vector<int>{2, 4, 6, 8}));
        const json& seconds = run.at("points").back().at("seconds");
        for (const char* clock : {"load", "build", "upload", "place", "precompute", "learn", "render"})
            CHECK(seconds.at(clock).get<double>() >= 0.0);
        const double charged = seconds.at("place").get<double>() + seconds.at("precompute").get<double>() +
                               seconds.at("learn").get<double>() + seconds.at("render").get<double>();
        CHECK_THAT(seconds.at("charged").get<double>(), WithinRel(charged, 1e-12));
        const std::string method = run.at("method");
        CHECK((seconds.at("precompute").get<double>() > 0.0) == (method == "precomputed"));
        CHECK((seconds.at("learn").get<double>() > 0.0) == (method == "reinforcement"));
        CHECK((seconds.at("place").get<double>() > 0.0) == (method != "default"));
        // The precomputed curve starts with a coarse map, which is completed if guiding pays.
        const json& first = run.at("points").front().at("seconds");
        CHECK(first.at("precompute") <= seconds.at("precompute"));
        CHECK((first.at("precompute").get<double>() > 0.0) == (method == "precomputed"));
    }
    CHECK(warm_ups == 3);
    for (const json& cell : results.at("summary")) {
        CHECK(cell.at("mse").at(0).get<double>() > 0.0);
        const double flip = cell.at("flip").at(0);
        CHECK((flip > 0.0 && flip < 1.0));
    }
    // Header, and four points of nine runs.
    CHECK(lines_of(read_all(folder / "b/series.csv")).size() == 1 + 4 * 9);
    CHECK(lines_of(read_all(folder / "b/summary.csv")).size() == 1 + 3);
    CHECK_THAT(read_all(folder / "b/summary.md"), contains("only 2 runs: no interval"));
    // Pictures of the first seed, as half floats: within a thousandth of the values of the reference.
    CHECK(std::distance(fs::directory_iterator(folder / "b/pictures"), fs::directory_iterator{}) == 3 * 4 + 1);
    CHECK(read_exr(folder / "b/pictures/cornell-reference.exr").height == 16);
    CHECK(results.at("references").at("cornell").at("spp") == json::array({32, 32}));
    CHECK_THAT(results.at("command").get<std::string>(),
               contains("pathlight bench cornell --backend cpu") && contains("--seeds 2"));
    CHECK(read_exr(folder / "b/pictures/cornell-default-cpu-8.exr").width == 16);
}

TEST_CASE("a bench leaves out points that take too long to measure, and its clocks name the commit and the upload") {
    const TempDir folder;
    make_bench(folder / "b", {"--measure-share", "0", "--seeds", "5", "--spp", "16"});
    const json results = results_in(folder / "b");
    REQUIRE(results.at("commits").size() == 1);
    CHECK_FALSE(results.at("commits").at(0).get<std::string>().empty());
    for (const json& run : results.at("runs")) {
        std::vector<int> steps;
        for (const json& point : run.at("points")) steps.push_back(point.at("spp"));
        CHECK((steps == std::vector<int>{2, 16}));
        CHECK(run.at("commit") == results.at("commits").at(0));
    }
    CHECK_THAT(lines_of(read_all(folder / "b/series.csv")).front(), contains(",build_s,upload_s,place_s,"));
    CHECK(run_program({"report", folder / "b"}).code == 0);
    CHECK_THAT(read_all(folder / "b/report.html"),
               contains("commit " + results.at("commits").at(0).get<std::string>()));
    CHECK_THAT(read_all(folder / "b/cornell-time.svg"), contains("<polyline"));
}

TEST_CASE("the errors of a bench do not depend on its order or its folder") {
    const TempDir folder;
    make_bench(folder / "b");
    make_bench(folder / "c", {"--method", "reinforcement,default", "-t", "1"});
    const auto all = errors_in(folder / "b");
    const auto some = errors_in(folder / "c");
    CHECK(some.size() == 4);
    for (const auto& [run, error] : some) CHECK(all.at(run) == error);
    // The first method is the baseline.
    CHECK(results_in(folder / "c").at("comparisons").at(0).at("base") == "reinforcement");
}

TEST_CASE("a bench goes on: nothing that was finished is done again or lost") {
    const TempDir folder;
    make_bench(folder / "b");
    std::map<std::string, std::string> before;
    for (const auto& entry : fs::directory_iterator(folder / "b/runs"))
        before[entry.path().filename()] = read_all(entry.path());
    make_bench(folder / "b", {"--seeds", "3"});
    for (const auto& [name, text] : before)
        if (name.find("warm-up") == std::string::npos) CHECK(read_all(folder / ("b/runs/" + name)) == text);
    CHECK(errors_in(folder / "b").size() == 9);
    check_refused(2, bench(folder / "b", {"--spp", "9"}), "/scenes/0/settings/spp \"8\", got \"9\"");
    check_refused(2, bench(folder / "b", {"--method", "default"}), "of another plan");
    write_all(folder / "b/runs/cornell-default-cpu-seed-1.json", "{\"schema\": \"pathlight.run/1\"}");
    check_refused(3, bench(folder / "b"), "cornell-default-cpu-seed-1.json");
}

TEST_CASE("130: an interrupted bench keeps its runs and goes on with the same command") {
    const TempDir folder;
    const Arguments many = bench(folder / "b", {"--seeds", "100000", "--json"});
    RunningProgram running(program(many));
    REQUIRE(running.wait_for_output("\"warm_up\":false"));
    running.send(SIGINT);
    const ProgramResult result = running.wait();
    CHECK(result.code == 130);
    CHECK_THAT(result.err, contains("the same command continues"));
    const std::size_t kept = errors_in(folder / "b").size();
    CHECK(kept >= 1);
    CHECK(results_in(folder / "b").at("complete") == false);
    const auto errors = errors_in(folder / "b");
    make_bench(folder / "b", {"--seeds", std::to_string(kept)});  // at least as many as the folder has of any method
    CHECK(results_in(folder / "b").at("complete") == true);
    for (const auto& [run, error] : errors) CHECK(errors_in(folder / "b").at(run) == error);
}

TEST_CASE("what a scene asks for to look well is no limit of a measurement") {
    const TempDir folder;
    for (const char* file : {"cornell.obj", "cornell.mtl"})
        fs::copy_file(fs::path(PL_SOURCE_DIR) / "assets/scenes/cornell" / file, folder.path() / file);
    write_all(folder / "quick.json", R"({"schema": "pathlight.scene/1", "obj": "cornell.obj",
        "settings": {"spp": 2, "view": "normal", "method": "precomputed", "size": "16x16"}})");
    Arguments arguments = bench(folder / "b", {"--seeds", "1", "--method", "default"});
    arguments[1] = folder / "quick.json";
    const ProgramResult result = run_program(arguments);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const json results = results_in(folder / "b");
    CHECK(results.at("runs").size() == 2);
    CHECK(results.at("runs").at(0).at("points").back().at("spp") == 8);
    CHECK(results.at("runs").at(0).at("method") == "default");
}

TEST_CASE("blocks hold every method once, in an order that changes") {
    const TempDir folder;
    const ProgramResult result = run_program(bench(folder / "b", {"--seeds", "6", "--json"}));
    REQUIRE(result.code == 0);
    std::vector<std::string> order;
    for (const std::string& line : lines_of(result.out)) {
        const json event = json::parse(line);
        if (event.at("event") == "run" && !event.at("warm_up").get<bool>()) order.push_back(event.at("method"));
    }
    REQUIRE(order.size() == 18);
    std::set<std::vector<std::string>> orders;
    for (std::size_t block = 0; block < 6; ++block) {
        const std::vector<std::string> methods(order.begin() + static_cast<std::ptrdiff_t>(3 * block),
                                               order.begin() + static_cast<std::ptrdiff_t>(3 * block + 3));
        CHECK(std::set<std::string>(methods.begin(), methods.end()).size() == 3);
        orders.insert(methods);
    }
    CHECK(orders.size() > 1);
}

TEST_CASE("3: a bench refuses references of other light") {
    const TempDir folder;
    const Arguments own{"--reference", folder / "refs", "--method", "default"};
    REQUIRE(run_program({"reference", "cornell", "-o", folder / "refs", "--size", "16x16", "--spp", "32"}).code == 0);
    make_bench(folder / "b", own);
    check_refused(3, bench(folder / "c", {"--reference", folder / "refs", "--max-depth", "4"}), "differs in depth");
    check_refused(3, bench(folder / "c", {"--reference", folder / "none"}), "holds no reference");
    // The light's power has changed, the name has not.
    fs::create_directory(folder / "changed");
    for (const char* file : {"cornell.json", "cornell.obj", "cornell.mtl"})
        fs::copy_file(fs::path(PL_SOURCE_DIR) / "assets/scenes/cornell" / file, folder.path() / "changed" / file);
    std::string materials = read_all(folder / "changed/cornell.mtl");
    const std::size_t emission = materials.find("\nKe ");
    REQUIRE(emission != std::string::npos);
    materials.insert(emission + 4, 1, '1');
    write_all(folder / "changed/cornell.mtl", materials);
    Arguments arguments = bench(folder / "c", own);
    arguments[1] = folder / "changed/cornell.json";
    check_refused(3, arguments, "differs in geometry, materials or lights");
}

TEST_CASE("5: the gate fails only when the whole interval is slower") {
    const TempDir folder;
    const Arguments five{"--seeds", "5", "--method", "default"};
    make_bench(folder / "b", five);
    const auto gated = [&](const std::string& base, const Arguments& more = {}) {
        Arguments arguments = bench(folder / "b", five);
        arguments.insert(arguments.end(), {"--gate", base});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments);
    };
    const ProgramResult same = gated(with_times(folder, 1.0));
    CHECK(same.code == 0);
    CHECK_THAT(same.out, contains("gate cornell/default/cpu: takes 1 times"));
    CHECK(gated(with_times(folder, 1000.0)).code == 0);  // faster than it was
    const ProgramResult slower = gated(with_times(folder, 1e-6));
    CHECK(slower.code == 5);
    CHECK_THAT(slower.err, contains("slower by more than 10 %: cornell/default/cpu"));
    CHECK(gated(with_times(folder, 1e-6), {"--tolerance", "1e6"}).code == 5);
    CHECK(gated(with_times(folder, 0.9), {"--tolerance", "100000"}).code == 0);
    CHECK(gated(folder / "none.json").code == 3);
}

TEST_CASE("a bench compares representations as methods of their own") {
    const TempDir folder;
    make_bench(folder / "b", {"--method", "default,reinforcement", "--field", "table,neural", "--nee", "off"});
    const json results = results_in(folder / "b");
    std::vector<std::string> methods;
    for (const json& row : results.at("summary")) methods.push_back(row.at("method"));
    CHECK((methods == std::vector<std::string>{"default", "reinforcement-table", "reinforcement-neural"}));
    CHECK(results.at("comparisons").size() == 2);
    const auto errors = errors_in(folder / "b");
    CHECK(errors.at({"reinforcement-table", 1}) != errors.at({"reinforcement-neural", 1}));
    // One representation, and the table without any.
    make_bench(folder / "c", {"--method", "reinforcement", "--field", "neural", "--nee", "off"});
    CHECK(errors_in(folder / "c").at({"reinforcement", 1}) == errors.at({"reinforcement-neural", 1}));
    make_bench(folder / "d", {"--method", "reinforcement", "--nee", "off"});
    CHECK(errors_in(folder / "d").at({"reinforcement", 1}) == errors.at({"reinforcement-table", 1}));
}

TEST_CASE("2: what bench does not understand") {
    const TempDir folder;
    check_refused(2, {"bench", "-o", folder / "b"}, "'bench' needs a SCENE");
    check_refused(2, {"bench", "cornell"}, "needs a folder to write to");
    check_refused(2, {"bench", "cornell", "cornell", "-o", folder / "b"}, "'cornell' twice");
    check_refused(2, bench(folder / "b", {"--method", "default,fast"}), "got 'fast'");
    check_refused(2, bench(folder / "b", {"--backend", "cpu,auto"}), "--backend: expected");
    check_refused(2, bench(folder / "b", {"--field", "table,trees"}), "got 'trees'");
    check_refused(2, bench(folder / "b", {"--seeds", "0"}), "--seeds: expected");
    check_refused(3, {"bench", "cornell", "nowhere", "-o", folder / "b"}, "nowhere");
    CHECK(folder.names().empty());
}

}  // namespace pl::test
