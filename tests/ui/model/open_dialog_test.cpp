// The dialog that opens scenes: folders on the helper thread, names, files, and what cannot be read.
#include "ui/model/open_dialog.h"

#include <fstream>

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

struct DialogBench : FileBench {
    DialogBench() {
        options.scenes = {"small", "other"};
        std::filesystem::create_directory(folder.path() / "sub");
        std::filesystem::create_directory(folder.path() / ".hidden");
        for (const char* name :
             {"b.obj", "a.json", "a.mtl", "c.field", ".d.obj", "e.GLB", "f.gltf", "f.bin", "g.xml"})
            std::ofstream(folder.path() / name) << "x";
    }
};

}  // namespace

TEST_CASE("Open dialog: a folder shows its folders and what can be opened, sorted") {
    const DialogBench bench;
    const FolderListing listing = list_folder(bench.folder.path());
    CHECK(listing.folders == std::vector<std::string>{"sub"});
    CHECK(listing.files == std::vector<std::string>{"a.json", "b.obj", "c.field", "e.GLB", "f.gltf", "g.xml"});
    CHECK(listing.folder.is_absolute());
    CHECK_THROWS_WITH(list_folder(bench.folder.path() / "none"), contains("expected a folder or a scene"));
}

TEST_CASE("Open dialog: known scenes have the pictures and lines of their folder") {
    DialogBench bench;
    bench.options.scenes_folder = bench.folder.path();
    std::filesystem::create_directory(bench.folder.path() / "small");
    const ByteImage gray{.width = 2, .height = 2, .rgb = std::vector<std::uint8_t>(12, 77)};
    write_png8(bench.folder.path() / "small" / "small.png", gray, {{"summary", "one triangle"}});
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    OpenDialog& dialog = model.open_dialog();
    dialog.toggle();
    REQUIRE(bench.run_until(model, [&] { return dialog.card_count() > 0; }));
    REQUIRE(dialog.card("small") != nullptr);
    CHECK(dialog.card("small")->summary == "one triangle");
    CHECK(dialog.card("small")->picture->rgb == gray.rgb);
    CHECK(dialog.card("other") == nullptr);
}

TEST_CASE("Open dialog: folders are browsed, and one that cannot be read leaves the old one") {
    DialogBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    OpenDialog& dialog = model.open_dialog();
    dialog.toggle();
    REQUIRE(bench.run_until(model, [&] { return !dialog.listing().folder.empty(); }));
    dialog.open(bench.folder.path().string());
    REQUIRE(bench.run_until(model, [&] { return dialog.listing().files.size() == 6; }));
    CHECK(dialog.is_shown());
    dialog.open((bench.folder.path() / "none").string());
    REQUIRE(bench.run_until(model, [&] { return told(model, "expected a folder or a scene"); }));
    CHECK(dialog.listing().files.size() == 6);
    model.cancel();
    CHECK_FALSE(dialog.is_shown());
}

TEST_CASE("Open dialog: scenes and files open, become recent, and a broken one does not") {
    DialogBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    OpenDialog& dialog = model.open_dialog();
    dialog.toggle();
    dialog.open("other");
    CHECK_FALSE(dialog.is_shown());
    REQUIRE(bench.run_until(model, [&] { return model.scene().name() == "other"; }));
    const std::string file = (bench.folder.path() / "b.obj").string();
    dialog.open(file);
    REQUIRE(bench.run_until(model, [&] { return model.scene().name() == file; }));
    dialog.open("broken.obj");
    REQUIRE(bench.run_until(model, [&] { return told(model, "broken.obj:7"); }));
    CHECK(model.scene().name() == file);
    const std::string lasting = std::filesystem::absolute(file).lexically_normal().string();
    CHECK(model.scene().recent().names() == std::vector<std::string>{lasting, "other", "small"});
}
