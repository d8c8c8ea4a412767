// Loading on the helper thread: only the newest request waits, a failure is told, and knobs reach the picture.
// The scene in the window: loading, and materials that are edited, refused and restored.
#include "ui/model/viewed_scene.h"

#include <atomic>
#include <cmath>
#include <mutex>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/measure/picture_identity.h"
#include "core/scene/scene_hash.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"
#include "tests/ui/file_bench.h"
#include "ui/model/references.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

using Names = std::vector<std::string>;

TEST_CASE("Recent files: newest first, each once, ten of them") {
    RecentFiles recent;
    for (const char* name : {"a", "b", "c", "a"}) recent.add(name);
    CHECK(recent.names() == Names{"a", "c", "b"});
    for (int i = 0; i < 12; ++i) recent.add(std::to_string(i));
    REQUIRE(recent.names().size() == RecentFiles::kMost);
    CHECK(recent.names().front() == "11");
    CHECK(recent.names().back() == "2");
}

TEST_CASE("Recent files: a stored list comes back in its order, without what breaks the rules") {
    RecentFiles recent;
    recent.add("old");
    recent.set({"x", "y", "x", "z"});
    CHECK(recent.names() == Names{"x", "y", "z"});
    recent.set(Names(20, "same"));
    CHECK(recent.names() == Names{"same"});
}

namespace {

/// A scene with one knob, which moves the camera's home; loads can be held.
struct KnobBench : ModelBench {
    std::atomic<bool> hold{false};
    std::atomic<bool> loading{false};
    std::mutex mutex;
    std::vector<SceneRequest> requests;  ///< in the order of their loads

    KnobBench() : ModelBench(16) {
        options.load_scene = [this](const SceneRequest& request) { return load(request); };
    }
    static std::shared_ptr<SceneDescription> scene(float value = 2.0f) {
        auto made = std::make_shared<SceneDescription>(*small_scene());
        made->knobs = {
            {.name = "gap", .does = "width", .low = 1.0f, .high = 5.0f, .default_value = 2.0f, .value = value}};
        made->positions[0].y += 0.01f * (value - 2.0f);
        return made;
    }
    std::shared_ptr<const SceneDescription> load(const SceneRequest& request) {
        {
            const std::lock_guard lock(mutex);
            requests.push_back(request);
        }
        loading = true;
        while (hold) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        loading = false;
        if (request.name == "broken.obj") throw Error(ErrorKind::Input, "broken.obj:7: expected a number");
        const float value = request.knobs.empty() ? 2.0f : request.knobs.back().second;
        if (value > 5.0f) throw Error(ErrorKind::Usage, "gap=9: expected 1 to 5");
        return scene(value);
    }
    std::vector<SceneRequest> loaded() {
        const std::lock_guard lock(mutex);
        return requests;
    }
    bool shows(ViewerModel& model, float value) {
        return run_until(model,
                         [&] { return has_frame(model) && model.frame()->description->knobs.at(0).value == value; });
    }
};

SceneRequest small_with_gap(float value) { return {"small", {{"gap", value}}}; }

}  // namespace

TEST_CASE("Scene loader: a knob loads the scene again, camera and edited materials stay") {
    KnobBench bench;
    ViewerModel model(bench.options, KnobBench::scene(), bench.options.settings, 0.0);
    REQUIRE(bench.shows(model, 2.0f));
    CHECK(model.scene().shown() == SceneRequest{"small"});
    model.camera().fly({.right = 1.0f}, 0.1);
    MaterialDescription gray = model.scene().materials().now()[0];
    gray.albedo = glm::vec3{0.25f};
    model.scene().set_material(0, gray);
    const float eye = model.camera().camera().eye.x;

    model.scene().set_knob(0, 3.5f);
    CHECK(model.scene().knobs()[0].value == 3.5f);
    REQUIRE(bench.shows(model, 3.5f));
    CHECK(model.camera().camera().eye.x == eye);
    CHECK(model.frame()->snapshot.camera.eye.x == eye);
    CHECK(bench.run_until(model, [&] { return model.frame()->description->materials[0] == gray; }));
    CHECK(model.scene().shown() == small_with_gap(3.5f));
    CHECK(model.files().pictures().picture().scene == small_with_gap(3.5f));
    CHECK(model.files().pictures().picture().description->knobs[0].value == 3.5f);

    model.scene().reload();
    REQUIRE(bench.run_until(model, [&] { return model.scene().materials().edited_names().empty(); }));
    CHECK(model.scene().knobs()[0].value == 3.5f);
    model.scene().reset_knobs();
    CHECK(bench.shows(model, 2.0f));
    CHECK(bench.loaded().back() == SceneRequest{"small"});
}

TEST_CASE("Scene loader: of the values during a load only the newest is loaded") {
    KnobBench bench;
    ViewerModel model(bench.options, KnobBench::scene(), bench.options.settings, 0.0);
    bench.hold = true;
    model.scene().set_knob(0, 2.5f);
    REQUIRE(eventually([&] { return bench.loading.load(); }));
    for (const float value : {2.75f, 3.0f, 4.0f}) model.scene().set_knob(0, value);
    bench.hold = false;
    REQUIRE(bench.shows(model, 4.0f));
    CHECK(bench.loaded() == std::vector{small_with_gap(2.5f), small_with_gap(4.0f)});
    CHECK(model.scene().knobs()[0].value == 4.0f);
}

TEST_CASE("Scene loader: a refused value leaves the old one, with the reason") {
    KnobBench bench;
    ViewerModel model(bench.options, KnobBench::scene(), bench.options.settings, 0.0);
    model.scene().set_knob(0, 3.0f);
    REQUIRE(bench.shows(model, 3.0f));
    model.scene().set_knob(0, 9.0f);
    REQUIRE(bench.run_until(model, [&] { return told(model, "gap=9: expected 1 to 5"); }));
    CHECK(model.scene().knobs()[0].value == 3.0f);
    CHECK(model.scene().shown() == small_with_gap(3.0f));
    model.scene().set_knob(1, 3.0f);  // there is none
    CHECK(model.scene().shown() == small_with_gap(3.0f));
}

TEST_CASE("Scene loader: another scene replaces waiting values, and knobs rest until it is there") {
    KnobBench bench;
    ViewerModel model(bench.options, KnobBench::scene(), bench.options.settings, 0.0);
    bench.hold = true;
    model.scene().set_knob(0, 2.5f);
    model.scene().set_knob(0, 3.0f);
    model.scene().open("other");
    model.scene().set_knob(0, 4.0f);
    model.scene().reload();
    bench.hold = false;
    REQUIRE(bench.run_until(model, [&] { return model.scene().name() == "other"; }));
    CHECK(model.scene().knobs()[0].value == 2.0f);
    CHECK(bench.loaded() == std::vector{small_with_gap(2.5f), SceneRequest{"other"}});
    model.scene().open("broken.obj");
    REQUIRE(bench.run_until(model, [&] { return told(model, "broken.obj:7"); }));
    CHECK(model.scene().name() == "other");
    model.scene().set_knob(0, 4.0f);
    CHECK(bench.shows(model, 4.0f));
}

TEST_CASE("Materials: a file can name the first of each name, and edits of others are known to be missing") {
    auto scene = std::make_shared<SceneDescription>();
    for (const char* name : {"a", "", "a", "b"}) scene->materials.push_back({.name = name});
    EditedMaterials materials(scene);
    REQUIRE(materials.named().size() == 2);
    CHECK(materials.are_edits_named());
    materials.set(3, with_albedo(scene->materials[3], 0.5f));
    CHECK(materials.named()[1].albedo == glm::vec3{0.5f});
    CHECK(materials.are_edits_named());
    materials.set(2, with_albedo(scene->materials[2], 0.5f));
    CHECK(materials.named()[0].albedo == glm::vec3{0.0f});
    CHECK_FALSE(materials.are_edits_named());
}

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
    CHECK(model.status().picture == picture_key(scene_hash(changed), settings));
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
    CHECK(model.scene().selected_material() == 1u);
    CHECK(bench.run_until(model, [&] { return model.status().scene->materials[0].albedo.x == 0.5f; }));
}
