// `pathlight view` from a shell, driven by a script on SDL's dummy driver: options, files and commands of the window.
#include <algorithm>
#include <csignal>
#include <filesystem>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

/// Runs the viewer on a script in a folder, at rest after so many samples.
ProgramResult run_script(const TempDir& folder, const std::string& script, const Arguments& more = {},
                         const std::string& spp = "2") {
    write_all(folder / "script", script);
    Arguments arguments{"view",    "cornell", "--script", "script", "--software", "--window",
                        "800x600", "--size",  "32x24",    "--spp",  spp};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments, {.folder = folder.path(), .unset = {"DISPLAY"}, .set = {"SDL_VIDEODRIVER=dummy"}});
}

std::string command_in(const std::filesystem::path& png) {
    ImageMetadata metadata;
    read_png8(png, &metadata);
    for (const auto& [name, text] : metadata)
        if (name == "command") return text;
    return "";
}

std::filesystem::path only_file(const TempDir& folder, const std::string& suffix) {
    for (const std::string& name : folder.names())
        if (name.ends_with(suffix)) return folder / name;
    return "";
}

}  // namespace

TEST_CASE("the command of a saved picture makes that picture") {
    const TempDir folder;
    const ProgramResult result =
        run_script(folder, "1 tap ]\n2 tap 3\n3 wait shown_method == reinforcement\n3 wait shown_spp == 2\n"
                           "4 tap s ctrl\n5 wait message ~ saved\n6 quit\n");
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const std::filesystem::path shown = only_file(folder, ".png");
    const std::filesystem::path linear = only_file(folder, ".exr");
    REQUIRE_FALSE(shown.empty());
    REQUIRE_FALSE(linear.empty());
    const std::string command = command_in(shown);
    CHECK_THAT(command, contains("--exposure 0.5") && contains("--method reinforcement") && contains("--size 32x24"));

    REQUIRE(run_shell(command, {.folder = folder.path()}).code == 0);
    CHECK((read_png8(folder / "cornell.png").rgb == read_png8(shown).rgb));
    REQUIRE(run_shell(command + " -o again.exr", {.folder = folder.path()}).code == 0);
    CHECK((read_exr(folder / "again.exr").pixels == read_exr(linear).pixels));
}

TEST_CASE("a signal closes the window in order, whatever a script waits for") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const TempDir folder;
        write_all(folder / "script", "1 shot s.png\n2 wait shown_spp == 1000000000\n");
        RunningProgram running(program({"view", "cornell", "--script", "script", "--software", "--size", "32x24",
                                        "--ui-trace", "trace"}),
                               {.folder = folder.path(), .unset = {"DISPLAY"}, .set = {"SDL_VIDEODRIVER=dummy"}});
        REQUIRE(running.wait_until([&] { return std::filesystem::exists(folder / "s.png"); }));
        running.send(signal);
        const ProgramResult result = running.wait();
        CHECK(result.code == 130);
        CHECK_FALSE(result.err.empty());  // the percentiles that the end of the window tells
    }
}

// The window writes 48 frames of 64 samples unless told otherwise; the first three are enough.
TEST_CASE("replay makes the frames that the window writes of its bookmarks, to the bit") {
    const TempDir folder;
    const ProgramResult result = run_script(
        folder,
        "1 wait shown_spp == 2\n2 tap F8\n3 key W\n9 keyup W\n10 wait moving == no\n11 wait shown_divider == 1\n"
        "12 tap F8\n13 expect bookmarks == 2\n14 aim_at 0.5 0.5 Bookmarks\n15 down left\n16 up left\n"
        "20 aim_at 0.5 0.5 write path\n21 down left\n22 up left\n23 wait writing == yes\n24 wait written >= 3\n"
        "25 tap Escape\n27 expect message ~ frames are in\n28 wait busy == no\n29 quit\n",
        {"--window", "1280x1500"});
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    REQUIRE(run_shell("pathlight replay cornell --path cornell-sequence-0001/cameras.json -o again --frames 48 "
                      "--spp 64 --size 32x24",
                      {.folder = folder.path()})
                .code == 0);
    for (const std::string name : {"frame_0001.png", "frame_0002.png", "frame_0003.png"}) {
        CAPTURE(name);
        CHECK(
            (read_png8(folder / ("again/" + name)).rgb == read_png8(folder / ("cornell-sequence-0001/" + name)).rgb));
    }
    CHECK(read_png8(folder / "again/frame_0001.png").rgb != read_png8(folder / "again/frame_0048.png").rgb);
}

TEST_CASE("the command of a picture that is not finished makes it with its samples") {
    const TempDir folder;
    const ProgramResult result =
        run_script(folder,
                   "1 tap 3\n2 wait shown_method == reinforcement\n2 wait shown_spp >= 3\n3 tap Space\n"
                   "4 wait state == paused\n8 tap s ctrl\n9 wait message ~ saved\n10 quit\n",
                   {}, "100000");
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const std::filesystem::path linear = only_file(folder, ".exr");
    REQUIRE_FALSE(linear.empty());
    const std::string command = command_in(only_file(folder, ".png"));
    INFO(command);
    CHECK_THAT(command, !contains("100000") && !contains("--load-field"));
    REQUIRE(run_shell(command + " -o again.exr", {.folder = folder.path()}).code == 0);
    CHECK((read_exr(folder / "again.exr").pixels == read_exr(linear).pixels));
}

TEST_CASE("the command of a picture that began with a learned field continues from that field's file") {
    const TempDir folder;
    const ProgramResult result = run_script(
        folder, "1 tap 3\n2 wait learned >= 2\n3 tap r\n4 wait learned >= 4\n4 wait shown_spp == 2\n5 tap C ctrl\n"
                "6 wait message ~ continues from the field\n7 wait busy == no\n8 quit\n");
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const std::filesystem::path field = only_file(folder, ".field");
    REQUIRE_FALSE(field.empty());
    CHECK_THAT(result.err + result.out, !contains("error"));
}

TEST_CASE("the copied command of a scene with edited materials makes the picture with a file of them") {
    const TempDir folder;
    const ProgramResult result = run_script(
        folder, "1 wait shown_spp == 2\n1 tap P\n2 aim 0.5 0.92\n3 down left\n4 up left\n5 wait material == white\n"
                "6 aim_at 0.5 0.5 Material\n7 down left\n8 up left\n10 aim_at 0.1 0.5 Color\n11 down left\n"
                "12 aim_at 0.02 0.5 Color\n13 aim_at 0.0 0.5 Color\n14 up left\n15 expect edited == 1\n"
                "16 wait moving == no\n17 wait shown_divider == 1\n18 wait state == done\n19 tap s ctrl\n"
                "20 wait message ~ saved\n20 wait busy == no\n21 tap C ctrl\n22 wait message ~ "
                "materials-0002.json\n23 quit\n");
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    const std::filesystem::path materials = only_file(folder, ".json");
    REQUIRE_FALSE(materials.empty());
    const std::string command = command_in(only_file(folder, ".png"));
    const std::string edited = command + " --materials " + materials.filename().string() + " -o again.exr";
    REQUIRE(run_shell(edited, {.folder = folder.path()}).code == 0);
    CHECK((read_exr(folder / "again.exr").pixels == read_exr(only_file(folder, "default-0001.exr")).pixels));
    REQUIRE(run_shell(command + " -o plain.exr", {.folder = folder.path()}).code == 0);
    CHECK((read_exr(folder / "plain.exr").pixels != read_exr(folder / "again.exr").pixels));
}

TEST_CASE("the window opens with the settings of the command line") {
    const TempDir folder;
    const ProgramResult result = run_script(
        folder,
        "1 expect method == precomputed\n1 expect nee == yes\n1 expect exposure == -1\n1 expect "
        "size == 32x24\n"
        "1 expect eye_z == -700\n2 wait state == done\n3 expect spp == 2\n4 quit\n",
        {"--method", "precomputed", "--nee", "on", "--exposure", "-1", "--eye", "278,273,-700", "--volumes", "50"});
    CAPTURE(result.err);
    CHECK(result.code == 0);
}

TEST_CASE("the window is remembered between starts, and options have priority") {
    const TempDir folder;
    const auto run = [&](const std::string& script, Arguments more = {}) {
        write_all(folder / "script", script);
        Arguments arguments{"view", "cornell", "--script", "script", "--software", "--size", "32x24", "--spp", "2"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramResult result =
            run_program(arguments, {.folder = folder.path(), .unset = {"DISPLAY"}, .set = {"SDL_VIDEODRIVER=dummy"}});
        CAPTURE(script, result.err);
        REQUIRE(result.code == 0);
        return result.err;
    };
    const Arguments here{"--remember", "state"};
    run("1 tap F3\n2 tap F6\n3 tap ]\n4 resize 1000 700\n8 tap H\n10 quit\n", here);
    CHECK_THAT(read_all(folder / "state/viewer.json"), contains("\"layout\": \"explore\"") && contains("1000"));
    // A picture is as the command line says.
    run("1 expect layout == explore\n1 expect settings_panel == no\n1 expect hemisphere == no\n"
        "1 expect exposure == 0\n1 expect window == 1000x700\n2 quit\n",
        here);
    run("1 expect window == 800x600\n1 expect ui_scale == 1.5\n2 quit\n",
        {"--remember", "state", "--window", "800x600", "--ui-scale", "1.5"});
    run("1 expect window == 1000x700\n1 expect ui_scale == 1\n2 tap F3 ctrl\n4 expect settings_panel == yes\n"
        "4 expect layout == research\n4 expect window == 1440x900\n5 quit\n",
        here);
    CHECK_FALSE(std::filesystem::exists(folder / "state/viewer.json"));
    // Without the option a script has no memory.
    run("1 tap F6\n2 quit\n");
    CHECK_FALSE(std::filesystem::exists(folder / "state/viewer.json"));
    // Faults of the file are messages.
    write_all(folder / "state/viewer.json", "{");
    run("1 expect message ~ as at a first start\n1 expect settings_panel == yes\n2 quit\n", here);
    write_all(folder / "file", "no folder");
    CHECK_THAT(run("1 tap F6\n2 quit\n", {"--remember", "file"}), contains("the window is not remembered"));
}

TEST_CASE("the window shows a scene without light by the default light, or black on request") {
    const TempDir folder;
    write_all(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const std::string choice : {"on", "off"}) {
        const std::string light = choice == "on" ? "default" : "none";
        const ProgramResult result = run_script(folder,
                                                "1 wait state == done\n2 expect shown_light == " + light +
                                                    "\n3 tap s ctrl\n4 wait message ~ saved\n5 quit\n",
                                                {"--scene", "a.obj", "--default-light", choice});
        CAPTURE(choice, result.err);
        REQUIRE(result.code == 0);
        const std::filesystem::path shown = only_file(folder, ".png");
        const std::vector<std::uint8_t> bytes = read_png8(shown).rgb;
        CHECK(std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t b) { return b == 0; }) == (choice == "off"));
        CHECK_THAT(command_in(shown), contains("--default-light " + choice));
        std::filesystem::remove(shown);
    }
}

TEST_CASE("a back end that is not there is told before a window opens") {
    const TempDir folder;
    const ProgramResult result = run_script(folder, "1 quit\n", {"--backend", "cuda"});
    if (result.code != 0) {
        CHECK(result.code == 4);
        CHECK_THAT(result.err, contains("--backend cuda"));
    }
}

}  // namespace pl::test
