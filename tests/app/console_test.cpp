// Results on standard output, messages and progress on standard error, and events as lines of JSON.
#include <csignal>

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "tests/app/stats_keys.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::ordered_json;

/// A pseudo terminal.
class Terminal {
public:
    Terminal() : handle_(posix_openpt(O_RDWR | O_NOCTTY)) {
        REQUIRE(handle_ >= 0);
        REQUIRE(grantpt(handle_) == 0);
        REQUIRE(unlockpt(handle_) == 0);
        // The other end is held open so that the output stays readable after the program has ended.
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

TEST_CASE("a picture goes to standard output alone") {
    const TempDir folder;
    const auto render = [](const std::string& output, const Arguments& more = {}) {
        Arguments arguments{"render", "cornell", "-o",       output,        "--size",    "8x8",
                            "--spp",  "2",       "--method", "precomputed", "--volumes", "20"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    for (const auto& [output, suffix] :
         {std::pair<std::string, std::string>{"pfm:-", "pfm"}, {"-", "png"}, {"png:-", "png"}, {"exr:-", "exr"}}) {
        const ProgramResult piped = run_program(render(output, {"--save-field", folder / "f"}));
        CAPTURE(output, piped.err);
        CHECK(piped.code == 0);
        CHECK_THAT(piped.err, contains("8x8, precomputed") && contains("f: "));
        const std::string file = folder / ("x." + suffix);
        REQUIRE(run_program(render(file)).code == 0);
        // Metadata have the time of the rendering, and the command.
        if (suffix == "pfm") CHECK(piped.out == read_all(file));
        write_all(folder / ("piped." + suffix), piped.out);
        if (suffix == "png")
            CHECK(read_png8(folder / "piped.png").rgb == read_png8(file).rgb);
        else
            CHECK(read_linear(folder / ("piped." + suffix)).pixels == read_linear(file).pixels);
    }
    CHECK(run_program(render("-", {"-q"})).err.empty());
    const ProgramResult events = run_program(render("-", {"--json"}));
    CHECK(events.code == 2);
    CHECK_THAT(events.err, contains("-o -: expected a file with --json"));
    const Terminal terminal;
    const ProgramResult shown = run_program(render("exr:-"), {.output_device = terminal.device()});
    CHECK(shown.code == 2);
    CHECK_THAT(shown.err, contains("-o exr:-: expected standard output to be a pipe or a file, got a terminal"));
    CHECK(terminal.text().empty());
    const ProgramResult full = run_program(render("-"), {.output_device = "/dev/full"});
    CHECK(full.code == 1);
    CHECK_THAT(full.err, contains("standard output"));
    // Only `render` writes pictures there.
    CHECK(run_program({"inspect", "cornell", "--pixel", "4,7", "-o", "-", "--size", "8x8"}).code == 2);
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
    const std::vector<std::string> told = lines_of(result.err);
    REQUIRE(told.size() == 2);
    CHECK_THAT(told[0], contains("warning: ") && contains("nowhere"));
    CHECK_THAT(told[1], contains("warning: ") && contains("no light in this scene"));
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

}  // namespace pl::test
