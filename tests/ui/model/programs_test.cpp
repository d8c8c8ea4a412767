// Programs of others, played by shell scripts in a folder that is all of PATH.
#include "ui/model/programs.h"

#include <cstdlib>

#include "core/base/error.h"
#include "core/io/files.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/ui/installed_programs.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Programs: found in PATH, run with a file as input, and their failure is an error") {
    InstalledPrograms installed;
    CHECK(find_program("reader").empty());
    installed.add("reader", "cat > \"$1\"");
    installed.add("failing", "exit 3");
    installed.folder.write("no-program", "text");
    CHECK(find_program("reader") == installed.folder.path() / "reader");
    CHECK(find_program("no-program").empty());
    const std::filesystem::path input = installed.folder.write("input", "some bytes");
    const std::filesystem::path output = installed.folder.path() / "out put";
    run_program(find_program("reader"), {output.string()}, input);
    CHECK(read_text_file(output) == "some bytes");
    installed.add("writer", "cat");
    run_program(find_program("writer"), {}, input, installed.folder.path() / "written");
    CHECK(read_text_file(installed.folder.path() / "written") == "some bytes");
    CHECK_THROWS_WITH(run_program(find_program("failing"), {"-x", "y"}),
                      "failing -x y: expected exit status 0, got 3");
    CHECK_THROWS_AS(run_program(installed.folder.path() / "no-program", {}), Error);
}

TEST_CASE("Programs: a film is made of the frames of a folder where ffmpeg is installed, else that is said") {
    InstalledPrograms installed;
    CHECK(make_film("some/frames", 24) ==
          "the frames are in some/frames; ffmpeg, which is not installed, makes films");
    installed.add("ffmpeg", "for last; do :; done\necho \"$@\" > \"$last\"");
    const std::filesystem::path frames = installed.folder.path() / "frames";
    CHECK(make_film(frames, 24) == "the film is " + frames.string() + ".mp4, its frames are in " + frames.string());
    CHECK_THAT(read_text_file(frames.string() + ".mp4"),
               contains("-framerate 24 -i " + frames.string() + "/frame_%04d.png"));
}

TEST_CASE("Programs: a picture is copied by the program of the desktop, and without one it is said what to install") {
    InstalledPrograms installed;
    const std::filesystem::path picture = installed.folder.write("picture.png", "pixels");
    CHECK_THROWS_WITH(copy_picture(picture),
                      "a picture cannot be copied: install wl-clipboard (Wayland) or xclip (X11)");
    for (const char* name : {"xclip", "wl-copy"}) installed.add(name, "cat > \"${0}.copied\"");
    const auto copied = [&](const std::string& name) {
        const std::filesystem::path file = installed.folder.path() / (name + ".copied");
        return std::filesystem::exists(file) ? read_text_file(file) : "";
    };
    ::unsetenv("WAYLAND_DISPLAY");
    copy_picture(picture);
    CHECK(copied("xclip") == "pixels");
    CHECK(copied("wl-copy").empty());
    ::setenv("WAYLAND_DISPLAY", "wayland-0", 1);
    copy_picture(picture);
    ::unsetenv("WAYLAND_DISPLAY");
    CHECK(copied("wl-copy") == "pixels");
}

TEST_CASE(
    "Programs: a picture is pasted by the program of the desktop; an empty clipboard and other content are none") {
    InstalledPrograms installed;
    const std::filesystem::path png = installed.folder.path() / "pasted.png";
    CHECK_THROWS_WITH(paste_picture(png),
                      "a picture cannot be pasted: install wl-clipboard (Wayland) or xclip (X11)");
    ::unsetenv("WAYLAND_DISPLAY");
    installed.add("wl-paste", "echo \"$@\"");
    REQUIRE(paste_picture(png));
    CHECK(read_text_file(png) == "--type image/png\n");
    installed.add("xclip", "echo \"$@\"");
    REQUIRE(paste_picture(png));
    CHECK(read_text_file(png) == "-selection clipboard -t image/png -o\n");
    installed.add("xclip", "exit 0");
    CHECK_FALSE(paste_picture(png));
    installed.add("xclip", "echo pixels; exit 1");
    CHECK_FALSE(paste_picture(png));
}
