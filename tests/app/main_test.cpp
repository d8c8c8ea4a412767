// Every exit code of the program, with its message.
#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/program/outcome.h"

namespace pl::test {
namespace {

/// A triangle seen from in front.
const char* const kTriangle = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";

Arguments render_tiny(const std::string& scene, const std::string& output, const Arguments& more = {}) {
    return joined({"render", scene, "-o", output, "--size", "8x8", "--spp", "1"}, more);
}

}  // namespace

TEST_CASE("0: questions are answered on standard output") {
    for (const Arguments& question : std::vector<Arguments>{{"--help"},
                                                            {"help", "bench"},
                                                            {"--version"},
                                                            {"--list-methods"},
                                                            {"--list-views"},
                                                            {"--licenses"},
                                                            {"render", "--help"},
                                                            {"view", "--help-all"},
                                                            {"devices"}}) {
        const ProgramResult result = run_program(question);
        CAPTURE(question, result.err);
        CHECK(result.code == 0);
        CHECK_FALSE(result.out.empty());
        CHECK(result.err.empty());
    }
}

TEST_CASE("0: examples of the help that need no files of their own work") {
    const TempDir folder;
    std::size_t run = 0;
    for (const char* command : {"info", "devices", "convert", "selftest"})
        for (const std::string& line : lines_of(run_program({command, "--help"}).out)) {
            if (!line.starts_with("  pathlight ") || line.find(".xml") != std::string::npos) continue;
            const ProgramResult result = run_shell(line, {.folder = folder.path()});
            CAPTURE(line, result.err);
            CHECK(result.code == 0);
            ++run;
        }
    CHECK(run == 11);
}

TEST_CASE("names in files do not speak to the terminal") {
    const TempDir folder;
    write_all(folder / "e.gltf",
              R"({"asset":{"version":"2.0"},"extensionsUsed":["X\u001b[31m\u009b1m"],
                  "buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
                  "bufferViews":[{"buffer":0,"byteLength":36}],
                  "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],
                  "materials":[{"name":"\u001b]0;OWNED\u0007red"}],
                  "cameras":[{"name":"\u001b[2J","type":"perspective","perspective":{"yfov":0.6}}],
                  "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
                  "nodes":[{"mesh":0},{"camera":0,"name":"\u009b2J"}],"scenes":[{"nodes":[0,1]}],"scene":0})");
    for (const Arguments& more : std::vector<Arguments>{{}, {"--json"}}) {
        const ProgramResult result = run_program(joined({"info", folder / "e.gltf"}, more));
        CAPTURE(result.out, result.err);
        REQUIRE(result.code == 0);
        CHECK_THAT(result.out, contains("OWNED"));
        CHECK_THAT(result.err, contains("31m"));
        for (const std::string& text : {result.out, result.err})
            for (const char* control : {"\x1b", "\x07", "\xC2\x9B"}) CHECK(text.find(control) == std::string::npos);
    }
}

// Sanitizers reserve more address space than any limit leaves.
#ifndef __SANITIZE_ADDRESS__

TEST_CASE("2: pictures and volumes that do not fit the memory are refused with both numbers of bytes") {
    const TempDir folder;
    const std::string limited = "ulimit -v 2000000; pathlight render cornell -t 1 -o " + (folder / "x.pfm");
    const ProgramResult picture = run_shell(limited + " --size 16384x16384");
    CAPTURE(picture.err);
    CHECK(picture.code == 2);
    CHECK_THAT(picture.err, contains("picture size 16384x16384: ") && contains(" bytes (34.4 GB)"));
    const ProgramResult volumes =
        run_shell(limited + " --size 16x16 --method reinforcement --volumes 1000000 --bins 1024");
    CAPTURE(volumes.err);
    CHECK(volumes.code == 2);
    CHECK_THAT(volumes.err, contains("1000000 radiance volumes of 1024 directions: ") && contains(" bytes ("));
    CHECK(folder.names().empty());
    CHECK(run_shell(limited + " --size 16x16 --spp 1").code == 0);
}

TEST_CASE("3: scenes whose files together do not fit the memory are refused, not shown without some of them") {
    const TempDir folder;
    const ByteImage image{.width = 4096, .height = 4096, .rgb = std::vector<std::uint8_t>(3 << 24, 100)};
    std::string faces = "mtllib t.mtl\n" + std::string(kTriangle), materials;
    for (const std::string number : {"1", "2", "3", "4"}) {
        write_png8(folder / ("t" + number + ".png"), image);
        faces += "vt 0 0\nusemtl m" + number + "\nf 1/1 2/1 3/1\n";
        materials += "newmtl m" + number + "\nmap_Kd t" + number + ".png\n";
        write_all(folder / ("t" + number + ".obj"), faces);
    }
    write_all(folder / "t.mtl", materials);
    const auto info = [&](const std::string& scene) {
        return run_shell("ulimit -v 1200000; pathlight info " + (folder / scene));
    };
    const ProgramResult all = info("t4.obj");
    CAPTURE(all.err);
    CHECK(all.code == 3);
    CHECK_THAT(all.err,
               contains(".png: expected to need at most the memory that is left here, ") && contains(" bytes ("));
    // One alone fits.
    write_all(folder / "t.mtl", "newmtl m1\nmap_Kd t1.png\n");
    CHECK(info("t1.obj").code == 0);
}

#endif

TEST_CASE("1: files that cannot be written are found out before rendering") {
    const TempDir folder;
    write_all(folder / "file", "");
    for (const std::string& name :
         {folder / "missing/x.png", folder / "file/x.png", folder.path().string() + "/d.png"}) {
        std::filesystem::create_directory(folder / "d.png");
        // Rendering would take a thousand years: only the check before it can end this.
        const ProgramResult result = run_program({"render", "cornell", "-o", name, "--spp", "1000000000"});
        CHECK(result.code == 1);
        CHECK_THAT(result.err, contains(name) && contains("cannot be written"));
    }
    const ProgramResult stats = run_program(
        {"render", "cornell", "-o", folder / "x.png", "--stats", folder / "missing/s.json", "--spp", "1000000000"});
    CHECK(stats.code == 1);
    CHECK((folder.names() == std::vector<std::string>{"d.png", "file"}));
}

TEST_CASE("1: a full disk leaves the old file and nothing else") {
    const TempDir folder;
    write_all(folder / "x.pfm", "old");
    // 64x64 pixels are 48 kB; the shell allows one block of at most 1 kB.
    const ProgramResult result =
        run_shell("trap '' XFSZ; ulimit -f 1; pathlight render cornell -o x.pfm --size 64x64 --spp 1",
                  {.folder = folder.path()});
    CHECK(result.code == 1);
    CHECK(read_all(folder / "x.pfm") == "old");
    CHECK((folder.names() == std::vector<std::string>{"x.pfm"}));

    std::filesystem::create_symlink("/dev/full", folder / "full.pfm");
    const ProgramResult full = run_program(render_tiny("cornell", folder / "full.pfm"));
    CHECK(full.code == 1);
    CHECK_THAT(full.err, contains("No space left"));
}

TEST_CASE("1: standard output that cannot be written is not silent") {
    const ProgramResult result = run_program({"devices"}, {.output_device = "/dev/full"});
    CHECK(result.code == 1);
    CHECK_THAT(result.err, contains("standard output"));
}

TEST_CASE("2: usage") {
    const TempDir folder;
    struct Wrong {
        Arguments arguments;
        std::string message;
    };
    const std::vector<Wrong> wrongs{
        {{"rendr"}, "did you mean 'render'?"},
        {{"reference", "cornell"}, "needs a folder to write to"},
        {{"bench", "cornell"}, "needs a folder to write to"},
        {{"compare", "a.exr"}, "needs two pictures"},
        {{"report"}, "needs one folder"},
        {render_tiny("cornell", folder / "x.png", {"--expsure", "1"}), "did you mean '--exposure'?"},
        {render_tiny("cornell", folder / "x.png", {"--spp", "-1"}), "--spp: expected"},
        {render_tiny("cornell", folder / "x.png", {"--view", "radiance-map"}), "precomputed or reinforcement"},
        {render_tiny("cornell", folder / "x.png", {"--target-error", "0"}), "--target-error: expected"},
        {render_tiny("cornell", folder / "x.png", {"--target-error", "0.1", "--view", "normal"}),
         "expected --view beauty"},
        {render_tiny("cornell", folder / "x.png", {"--reference", folder / "r"}),
         "unknown option '--reference' of 'render'"},
        {render_tiny("cornell", folder / "x.jpg"), "expected .exr, .pfm or .png, got .jpg"},
        {render_tiny("cornell", "jpg:-"), "-o: expected -, png:-, exr:- or pfm:-, got 'jpg:-'"},
        {render_tiny("cornell", folder / "x.png", {"--crop", "4,4,5,4"}),
         "--crop: expected a window within the picture of 8x8 pixels, got 5x4 at 4,4"},
        {render_tiny("cornell", folder / "x.png", {"-D", "spp=4"}), "cornell.json has no such knob: it has none"},
        {{"info", "cornell", "-D", "spp"}, "--define: expected NAME=VALUE"},
        {{"replay", "cornell", "--crop", "0,0,8,8"}, "unknown option '--crop' of 'replay'"},
        {{"render", "cornell"}, "-o FILE"},
        {{"render", "-o", folder / "x.png"}, "needs a SCENE"},
        {{"inspect", "cornell", "-o", folder / "x.png"}, "--at"},
        {{"inspect", "cornell", "--pixel", "8,0", "-o", folder / "x.csv", "--size", "8x8"},
         "--pixel: expected a pixel of 8x8"},
        {{"trace", "cornell", "--pixel", "1,1"}, "--pixel X,Y and --sample N[-M]"},
        {{"trace", "cornell", "--sample", "0"}, "--pixel X,Y and --sample N[-M]"},
        {{"trace", "--pixel", "1,1", "--sample", "0"}, "needs a SCENE"},
        {{"trace", "cornell", "--pixel", "1,1", "--sample", "-1"}, "--sample: expected"},
        {{"trace", "cornell", "--pixel", "0,8", "--sample", "0", "--size", "8x8"},
         "--pixel: expected a pixel of 8x8"},
        {{"inspect", "cornell", "--pixel", "1,1", "-o", folder / "x.exr"}, "expected .json, .csv or .png"},
    };
    for (const Wrong& wrong : wrongs) check_refused(2, wrong.arguments, wrong.message);
    CHECK(folder.names().empty());
}

TEST_CASE("3: input that is missing or invalid, with file and line") {
    const TempDir folder;
    write_all(folder / "good.obj", kTriangle);
    struct Wrong {
        std::string file;
        std::string content;
        std::string message;
    };
    const std::vector<Wrong> wrongs{
        {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 9\n", "index.obj:5"},
        {"number.obj", "v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n", "number.obj:2"},
        {"empty.obj", "", "empty.obj"},
        {"cut.json", "{\n\"schema\": \"pathlight.scene/1\",\n\"obj\": \"good.o", "cut.json:3"},
        {"key.json", "{\"schema\": \"pathlight.scene/1\",\n\"obj\": \"good.obj\",\n\"camra\": {}}", "'camera'"},
        {"key.json", "{\"schema\": \"pathlight.scene/1\",\n\"obj\": \"good.obj\",\n\"camra\": {}}", "key.json:3"},
        {"gone.json", "{\"schema\": \"pathlight.scene/1\",\n\"obj\": \"gone.obj\"}", "gone.obj"},
        {"set.json", "{\"schema\": \"pathlight.scene/1\", \"obj\": \"good.obj\",\n\"settings\": {\"bins\": 5}}",
         "set.json:2"},
    };
    for (const Wrong& wrong : wrongs) {
        write_all(folder / wrong.file, wrong.content);
        const ProgramResult result = run_program(render_tiny(folder / wrong.file, folder / "x.png"));
        CAPTURE(wrong.file, result.err);
        CHECK(result.code == 3);
        CHECK_THAT(result.err, contains(wrong.message));
        CHECK_FALSE(std::filesystem::exists(folder / "x.png"));
    }
    const ProgramResult unknown = run_program(render_tiny("cornel", folder / "x.png"));
    CHECK(unknown.code == 3);
    CHECK_THAT(unknown.err, contains("'cornell'"));
    CHECK(run_program({"info", folder / "missing.obj"}).code == 3);
    CHECK(run_program({"info", folder.path().string() + "/"}).code == 3);
    CHECK(run_program(render_tiny("cornell", folder / "x.png", {"--camera", folder / "missing.json"})).code == 3);
}

TEST_CASE("4: a back end or a display that is not there") {
    const TempDir folder;
    const ProgramResult cuda = run_program(render_tiny("cornell", folder / "x.png", {"--backend", "cuda"}));
    if (cuda.code != 0) {
        CHECK(cuda.code == 4);
        CHECK_THAT(cuda.err, contains("--backend cuda: "));
    }
    const ProgramResult window =
        run_program({"view", "cornell"}, {.unset = {"DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"}});
    CHECK(window.code == 4);
    CHECK_THAT(window.err, contains("pathlight render cornell -o "));
}

TEST_CASE("the message of an error is also an event") {
    const ProgramResult result = run_program({"info", "cornel", "--json"});
    CHECK(result.code == 3);
    CHECK_THAT(result.out, contains("\"event\":\"error\"") && contains("\"exit_code\":3"));
}

}  // namespace pl::test
