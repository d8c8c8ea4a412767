// The scene in the window: loading, and materials that are edited, refused and restored.
#include <cmath>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/measure/picture_identity.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"
#include "tests/ui/file_bench.h"
#include "ui/model/stored_reference.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

struct MaterialBench : ModelBench {
    MaterialBench() : ModelBench(16) {}
};

}  // namespace

TEST_CASE("Viewed scene: a scene that cannot be read leaves the old one, with a message") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.files().open("broken.obj");
    REQUIRE(bench.run_until(model, [&] { return !model.messages().toasts().empty(); }));
    CHECK(model.messages().toasts().back().level == MessageLevel::Error);
    CHECK_THAT(model.messages().toasts().back().text, contains("broken.obj:7"));
    CHECK(model.scene().name() == "small");
    CHECK(model.status().state == WorkerState::Rendering);
}

TEST_CASE("Viewed scene: reloading keeps the camera, another scene brings its own") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.camera().fly({.right = 1.0f}, 0.1);
    const Vec3f eye = model.camera().camera().eye;
    model.scene().reload();
    REQUIRE(bench.run_until(model, [&] { return model.frame()->description->camera.eye.y == 1.5f; }));
    CHECK(model.frame()->snapshot.camera.eye.x == eye.x);
    CHECK(model.camera().camera().eye.x == eye.x);
    model.files().open("other.obj");
    REQUIRE(bench.run_until(model, [&] { return model.scene().name() == "other.obj"; }));
    CHECK(model.camera().camera().eye.y == 1.5f);
    REQUIRE(bench.run_until(model, [&] { return model.frame()->snapshot.camera.eye.y == 1.5f; }));
    // Home is the new scene's camera.
    model.camera().fly({.up = 1.0f}, 0.1);
    model.camera().go_home();
    CHECK(model.camera().camera().eye.y == 1.5f);
}

TEST_CASE("Viewed scene: a file that changes is loaded again, with camera and edits, unless it cannot be read") {
    FileBench bench;
    const auto file = bench.folder.write("scene.obj", "0");
    const auto load = [file](const SceneRequest&) {
        const std::string text = read_file(file);
        if (text.find("bad") != std::string::npos) throw Error(ErrorKind::Input, "scene.obj:1: bad");
        auto scene = std::make_shared<SceneDescription>(*small_scene());
        scene->materials[1].emission = glm::vec3{static_cast<float>(text.size())};
        scene->files = {file};
        return std::shared_ptr<const SceneDescription>(scene);
    };
    bench.options.load_scene = load;
    ViewerModel model(bench.options, load({}), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.camera().fly({.right = 1.0f}, 0.1);
    const Vec3f eye = model.camera().camera().eye;
    model.scene().set_material(0, with_albedo(small_scene()->materials[0], 0.25f));
    // The first look at the file may come after the first change: others follow, with time to rest.
    const auto change_until = [&](const std::string& added, const std::string& message) {
        std::string text = read_file(file);
        return eventually([&] {
            bench.folder.write("scene.obj", text += added);
            for (int i = 0; i < 20 && !told(model, message); ++i) {
                std::this_thread::sleep_for(FileWatch::kInterval / 4);
                model.update(bench.clock += 1.0 / 60.0);
            }
            return told(model, message);
        });
    };
    REQUIRE(change_until("1", "scene.obj has changed: loaded again"));
    CHECK(model.scene().materials().file()->materials[1].emission.x >= 2.0f);
    CHECK(model.scene().materials().is_edited(0));
    CHECK(model.camera().camera().eye.x == eye.x);
    const auto before = model.scene().materials().file();
    REQUIRE(change_until("bad", "scene.obj has changed, but the old scene stays: scene.obj:1: bad"));
    CHECK(model.scene().materials().file() == before);
    bench.folder.write("scene.obj", "mended, and long");
    REQUIRE(change_until("2", "scene.obj has changed: loaded again"));
    REQUIRE(bench.run_until(model, [&] { return model.scene().materials().file() != before; }));
}

TEST_CASE("Viewed scene: an edited material reaches the picture, and its scene is another one") {
    MaterialBench bench;
    const auto scene = small_scene();
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    const std::uint64_t before = model.status().picture;
    MaterialDescription coated = with_albedo(scene->materials[0], 0.25f);
    coated.kind = SurfaceKind::Plastic;
    model.scene().set_material(0, coated);
    CHECK(model.scene().materials().is_edited(0));
    CHECK(model.scene().materials().edited_names() == std::vector<std::string>{"floor"});
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0 && model.status().picture != before; }));
    CHECK(model.status().scene->materials[0] == coated);
    SceneDescription changed = *scene;
    changed.materials[0] = coated;
    RenderSettings settings = model.render().settings();
    CHECK(model.status().picture == picture_key(changed, settings));
    REQUIRE(bench.run_until(model, [&] { return model.frame()->description->materials[0] == coated; }));

    model.scene().restore_material(0);
    CHECK(model.scene().materials().edited_names().empty());
    CHECK(bench.run_until(model, [&] { return model.status().picture == before; }));
}

TEST_CASE("Viewed scene: a bad value is refused with the reason, and the old material stays") {
    MaterialBench bench;
    const auto scene = small_scene();
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    for (const float bad : {-0.1f, 1.1f, NAN}) {
        model.scene().set_material(0, with_albedo(scene->materials[0], bad));
        CHECK(model.scene().materials().now()[0] == scene->materials[0]);
    }
    CHECK(told(model, "material 'floor': albedo"));
    model.scene().set_material(7, scene->materials[0]);  // there is none
    model.scene().restore_material(7);
    model.scene().select_material(7);
    CHECK_FALSE(model.scene().selected_material().has_value());
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    CHECK(model.status().scene == scene);
}

TEST_CASE("Viewed scene: two of them are changed and restored together") {
    MaterialBench bench;
    const auto scene = small_scene();
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    model.scene().set_material(0, with_albedo(scene->materials[0], 0.1f));
    model.scene().set_material(1, with_albedo(scene->materials[1], 0.2f));
    model.scene().set_material(0, with_albedo(scene->materials[0], 0.3f));
    REQUIRE(bench.run_until(model, [&] {
        return model.status().scene->materials[0].albedo.x == 0.3f &&
               model.status().scene->materials[1].albedo.x == 0.2f;
    }));
    model.scene().restore_materials();
    CHECK(bench.run_until(model, [&] { return model.status().scene->materials == scene->materials; }));
}

TEST_CASE("Viewed scene: references are looked up with the edited scene") {
    MaterialBench bench;
    const TemporaryFolder folder;
    bench.options.reference_dir = folder.path();
    const auto scene = small_scene();
    SceneDescription changed = *scene;
    changed.materials[0] = with_albedo(scene->materials[0], 0.25f);
    StopFlag stop{true};
    make_stored_reference(folder.path(), {"small", std::make_shared<const SceneDescription>(changed)},
                          bench.options.settings, bench.options.make_backend,
                          {.stop = &stop, .progress = [](double, const std::string&) {}});
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0 && model.status().seconds > 0.0; }));
    CHECK(model.references().current() == nullptr);
    model.scene().set_material(0, changed.materials[0]);
    CHECK(bench.run_until(model, [&] { return model.references().current() != nullptr; }));
}

TEST_CASE("Viewed scene: a new scene has the materials of its file, and pictures name the edited ones") {
    MaterialBench bench;
    const auto scene = small_scene();
    bench.options.load_scene = [](const SceneRequest&) { return small_scene(); };
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    CHECK(model.files().pictures().picture().edited_materials.empty());
    model.scene().select_material(1);
    model.scene().set_material(0, with_albedo(scene->materials[0], 0.25f));
    CHECK(model.files().pictures().picture().edited_materials == std::vector<std::string>{"floor"});
    model.scene().reload();
    REQUIRE(bench.run_until(model, [&] { return model.scene().materials().edited_names().empty(); }));
    CHECK_FALSE(model.scene().selected_material().has_value());
    CHECK(bench.run_until(model, [&] { return model.status().scene->materials[0].albedo.x == 0.5f; }));
}
