// Pictures of the known scenes: made while the dialog is open, kept, made anew if a file is damaged.
// The dialog that opens scenes: folders on the helper thread, names, files, and what cannot be read.
#include "ui/model/open_dialog.h"

#include <fstream>

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "ui/model/thumbnail.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

struct GalleryBench : FileBench {
    std::filesystem::path cache = folder.path() / "cache";

    GalleryBench() { options.scenes = {"broken.obj", "other", "small"}; }
    /// Opens the dialog of a new window until the gallery is complete. Returns the back ends made for that.
    int open_dialog() {
        ViewerModel model(options, small_scene(), options.settings, 0.0);
        SceneGallery& gallery = model.open_dialog().gallery();
        gallery.set_folder(cache);
        REQUIRE(run_until(model, [&] { return model.frame() != nullptr; }));
        const int before = control->made;
        model.open_dialog().toggle();
        REQUIRE(run_until(model, [&] { return gallery.size() == 2 && !gallery.is_working(); }));
        CHECK_FALSE(gallery.picture("broken.obj"));
        CHECK(gallery.picture("small")->width == kThumbnailWidth);
        CHECK(told(model, "no picture of the scene broken.obj: broken.obj:7"));
        REQUIRE(run_until(model, [&] { return model.status().state == WorkerState::Rendering; }));
        return control->made - before;
    }
};

}  // namespace

TEST_CASE("Gallery: pictures are rendered once, and read from then on") {
    GalleryBench bench;
    CHECK(bench.open_dialog() >= 1);
    CHECK(std::filesystem::exists(bench.cache));
    CHECK(bench.open_dialog() == 0);
    for (const auto& file : std::filesystem::directory_iterator(bench.cache)) std::ofstream(file.path()) << "damaged";
    CHECK(bench.open_dialog() >= 1);
    CHECK(bench.open_dialog() == 0);
}

TEST_CASE("Gallery: a folder that cannot be written is told, and pictures are shown all the same") {
    GalleryBench bench;
    std::ofstream(bench.cache) << "no folder";
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.open_dialog().gallery().set_folder(bench.cache / "below");
    model.open_dialog().toggle();
    REQUIRE(bench.run_until(model, [&] { return model.open_dialog().gallery().size() == 2; }));
    REQUIRE(bench.run_until(model, [&] { return !model.open_dialog().gallery().is_working(); }));
    CHECK(told(model, "cannot be kept"));
}

TEST_CASE("Gallery: the picture in the window rests while others are made, and goes on when the dialog closes") {
    GalleryBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.frame() != nullptr; }));
    bench.control->hold = true;
    model.open_dialog().toggle();
    REQUIRE(bench.run_until(model, [&] { return model.open_dialog().gallery().is_working(); }));
    CHECK(model.link().is_held(RenderLink::Hold::Gallery));
    model.cancel();
    model.update(bench.clock += 0.1);
    bench.control->hold = false;
    REQUIRE(bench.run_until(model, [&] { return !model.open_dialog().gallery().is_working(); }));
    CHECK_FALSE(model.link().is_held(RenderLink::Hold::Gallery));
    CHECK(model.open_dialog().gallery().size() < 2);
    // Another look completes it.
    model.open_dialog().toggle();
    REQUIRE(bench.run_until(model, [&] { return model.open_dialog().gallery().size() == 2; }));
}

TEST_CASE("Gallery: drafts of all scenes come before the first whole picture, and are not kept") {
    GalleryBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    SceneGallery& gallery = model.open_dialog().gallery();
    gallery.set_folder(bench.cache);
    bench.control->pass_microseconds = 4000;
    model.open_dialog().toggle();
    REQUIRE(bench.run_until(model, [&] { return gallery.picture("other") && gallery.picture("small"); }));
    CHECK(gallery.size() == 0);
    CHECK(gallery.shown() == 2);
    CHECK_FALSE(std::filesystem::exists(bench.cache));
    const auto draft = gallery.picture("small");
    bench.control->pass_microseconds = 0;
    REQUIRE(bench.run_until(model, [&] { return gallery.size() == 2; }));
    CHECK(gallery.picture("small") != draft);
}

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
