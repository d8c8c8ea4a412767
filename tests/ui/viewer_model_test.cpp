#include <filesystem>
#include <fstream>
#include <mutex>

#include "core/base/error.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/ui/fake_backend.h"
#include "ui/script_values.h"
#include "ui/viewer_model.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A model over the fake back ends, with what it saves kept in memory.
struct Bench {
    FakeDevices devices;
    std::shared_ptr<FakeControl> control = devices.cpu;
    ViewerOptions options;
    std::mutex mutex;
    std::vector<std::filesystem::path> saved;
    TemporaryFolder folder;
    double clock = 0.0;

    Bench() {
        options.scene_name = "small";
        options.settings.width = 64;
        options.settings.height = 64;
        options.settings.camera = small_scene()->camera;
        options.settings.field.volumes = 16;
        options.settings.field.bins = 16;
        options.screenshot_dir = folder.path();
        options.make_backend = devices.maker();
        options.backends = {{"cpu", "", ""}, {"cuda", "", ""}};
        options.load_scene = [](const std::string& name) -> std::shared_ptr<const SceneDescription> {
            if (name == "broken.obj") throw Error(ErrorKind::Input, "broken.obj:7: expected a number, got 'x'");
            auto scene = std::make_shared<SceneDescription>(*small_scene());
            scene->camera.eye.y = 1.5f;
            return scene;
        };
        options.save_image = [this](const std::filesystem::path& path, const Snapshot&, const ViewerPicture&) {
            const std::lock_guard lock(mutex);
            saved.push_back(path);
        };
        options.command_line = [](const ViewerPicture& picture) { return "pathlight render " + picture.scene; };
    }

    /// Runs the model's frames until the condition holds.
    template <class Condition>
    bool run_until(ViewerModel& model, Condition&& condition) {
        return eventually([&] {
            model.update(clock += 1.0 / 60.0);
            return condition();
        });
    }
};

bool has_frame(const ViewerModel& model) { return model.frame() != nullptr; }

}  // namespace

TEST_CASE("Viewer model: a scene that cannot be read leaves the old one and says why") {
    Bench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.open("broken.obj");
    REQUIRE(bench.run_until(model, [&] { return !model.toasts().empty(); }));
    CHECK(model.toasts().back().level == LogLevel::Error);
    CHECK_THAT(model.toasts().back().text, contains("broken.obj:7"));
    CHECK(model.scene_name() == "small");
    CHECK(model.status().state == WorkerState::Rendering);
}

TEST_CASE("Viewer model: reloading keeps the camera, another scene brings its own") {
    Bench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.fly({.right = 1.0f}, 0.1);
    const Vec3f eye = model.controls().camera().eye;
    model.reload();
    REQUIRE(bench.run_until(model, [&] { return model.frame()->description->camera.eye.y == 1.5f; }));
    CHECK(model.frame()->snapshot.camera.eye.x == eye.x);
    CHECK(model.controls().camera().eye.x == eye.x);
    model.open("other.obj");
    REQUIRE(bench.run_until(model, [&] { return model.scene_name() == "other.obj"; }));
    CHECK(model.controls().camera().eye.y == 1.5f);
    REQUIRE(bench.run_until(model, [&] { return model.frame()->snapshot.camera.eye.y == 1.5f; }));
    // Home is the new scene's camera.
    model.fly({.up = 1.0f}, 0.1);
    model.camera_home();
    CHECK(model.controls().camera().eye.y == 1.5f);
}

TEST_CASE("Viewer model: motion ends by itself a tenth of a second after the last input") {
    Bench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.update(1.0);
    model.look({5.0f, 0.0f});
    CHECK(model.moving());
    model.update(1.09);
    CHECK(model.moving());
    model.look({5.0f, 0.0f});
    model.update(1.18);
    CHECK(model.moving());
    model.update(1.20);
    CHECK_FALSE(model.moving());
    CHECK(model.camera_generation() == 2);
}

TEST_CASE("Viewer model: exposure and overlays restart nothing") {
    Bench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().passes >= 5; }));
    const std::uint64_t generation = model.status().generation;
    model.set_exposure(3.0f);
    model.set_curve(ToneCurve::Aces);
    model.set_cells(true);
    model.set_cells_opacity(2.0f);
    model.window().hemisphere = false;
    REQUIRE(bench.run_until(model, [&] { return has_frame(model) && model.frame()->cells != nullptr; }));
    CHECK(model.status().generation == generation);
    CHECK(model.status().passes >= 5);
    CHECK(model.window().cells_opacity == 1.0f);
    model.set_exposure(1000.0f);
    CHECK(model.display().exposure_ev == 16.0f);
}

TEST_CASE("Viewer model: views go round in both directions") {
    Bench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.step_view(-1);
    CHECK(model.settings().view == View::Unvisited);
    for (std::size_t i = 0; i < all_views().size(); ++i) model.step_view(1);
    CHECK(model.settings().view == View::Unvisited);
    model.step_view(1);
    CHECK(model.settings().view == View::Beauty);
}

TEST_CASE("Viewer model: saves both formats under one new number, without waiting") {
    Bench bench;
    std::ofstream(bench.options.screenshot_dir / "small-default-0001.png") << "x";
    {
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        model.save_picture();
        CHECK(model.toasts().back().level == LogLevel::Warning);  // nothing to save yet
        REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
        model.save_picture();
        model.save_screenshot();
    }  // what was asked for is written before the end
    const auto name = [&](const char* file) { return bench.options.screenshot_dir / file; };
    REQUIRE(bench.saved.size() == 3);
    CHECK(bench.saved[0] == name("small-default-0002.exr"));
    CHECK(bench.saved[1] == name("small-default-0002.png"));
    CHECK(bench.saved[2] == name("small-default-0003.png"));
}

TEST_CASE("Viewer model: what was learned is saved, and gone on from later") {
    Bench bench;
    std::shared_ptr<LearnedField> file;
    bench.options.save_field = [&](const std::filesystem::path& path, const LearnedField& field) {
        file = std::make_shared<LearnedField>(field);
        std::ofstream(path) << "a field";
    };
    bench.options.load_field = [&](const std::filesystem::path& path, const OpenScene&) {
        if (!std::filesystem::exists(path)) throw Error(ErrorKind::Input, path.string() + ": cannot be read");
        return std::make_shared<LearnedField>(*file);
    };
    {
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        const auto told = [&](const char* text) {
            return bench.run_until(model, [&] {
                return !model.toasts().empty() && model.toasts().back().text.find(text) != std::string::npos;
            });
        };
        REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
        model.load_last_field();
        CHECK(told("nothing learned in small was saved in"));
        model.save_field();
        CHECK(told("method 'default' has learned nothing yet"));
        model.set_method(MethodId::Reinforcement);
        const auto learned = [&] { return model.status().field ? model.status().field->passes : 0; };
        REQUIRE(bench.run_until(model, [&] { return learned() >= 20; }));
        model.save_field();
        REQUIRE(told("small-reinforcement-0001.field: reinforcement, "));
        const std::uint64_t saved = file->progress.passes;
        REQUIRE(saved >= 20);

        model.set_method(MethodId::Default);
        FieldSettings other = model.settings().field;
        other.bins = 64;
        model.set_field(other);
        model.forget();
        bench.control->pass_microseconds = 20000;  // so that it cannot catch up
        REQUIRE(bench.run_until(model, [&] { return model.frame()->settings.field.bins == 64; }));
        model.load_last_field();
        REQUIRE(told("going on from "));
        CHECK(model.settings().method == MethodId::Reinforcement);
        CHECK(model.settings().field.bins == 16);
        REQUIRE(bench.run_until(model, [&] { return learned() >= saved; }));
        CHECK(learned() < saved + 20);
        CHECK(model.frame()->backend.name == "cpu");

        model.open((bench.options.screenshot_dir / "gone.field").string());
        CHECK(told("gone.field: cannot be read"));
        CHECK(model.settings().method == MethodId::Reinforcement);
    }
}

TEST_CASE("Viewer model: a viewer started from a field goes on from it") {
    Bench bench;
    {
        RenderWorker worker({.make_backend = bench.options.make_backend,
                             .backends = bench.options.backends,
                             .first_backend = "cpu",
                             .scene = small_scene(),
                             .settings =
                                 [&] {
                                     RenderSettings settings = bench.options.settings;
                                     settings.method = MethodId::Reinforcement;
                                     return settings;
                                 }(),
                             .limits = {.spp = 30, .seconds = 0.0}});
        REQUIRE(eventually([&] { return worker.status().state == WorkerState::Done; }));
        worker.request_learned();
        std::optional<LearnedAnswer> answer;
        REQUIRE(eventually([&] { return (answer = worker.take_learned()).has_value(); }));
        REQUIRE(answer->field);
        bench.options.field = answer->field;
    }
    bench.options.settings.method = MethodId::Reinforcement;
    bench.options.settings.field = bench.options.field->settings;
    bench.control->pass_microseconds = 20000;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model) && model.status().field; }));
    CHECK(bench.run_until(model, [&] { return model.status().field->passes >= 30; }));
    CHECK(model.status().field->passes < 60);
}

TEST_CASE("Viewer model: the lens is made sharp at the picked point") {
    Bench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    const float before = model.controls().camera().focus_distance;
    model.focus_on_picked();
    CHECK(model.controls().camera().focus_distance == before);  // nothing is picked
    model.pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.picked().has_value(); }));
    model.focus_on_picked();
    const CameraDescription& camera = model.controls().camera();
    const Vec3f forward = glm::normalize(camera.target - camera.eye);
    CHECK(camera.focus_distance == Approx(glm::dot(model.picked()->position - camera.eye, forward)));
}

TEST_CASE("Viewer model: a picked volume is selected, deselected, and forgotten with its field") {
    Bench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.inspection() != nullptr; }));
    CHECK(model.selected_volume() != kNoVolume);
    CHECK(script_value(model, "inspected") == "yes");
    model.cancel();
    CHECK(model.selected_volume() == kNoVolume);
    CHECK(model.inspection() == nullptr);

    model.pick({0.5f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return model.inspection() != nullptr; }));
    FieldSettings field = model.settings().field;
    field.bins = 64;
    model.set_field(field);
    CHECK(model.selected_volume() == kNoVolume);

    model.pick({0.01f, 0.01f});
    REQUIRE(bench.run_until(model, [&] { return !model.toasts().empty(); }));
    CHECK_THAT(model.toasts().back().text, contains("nothing to select"));
}

TEST_CASE("Viewer model: Esc closes the help, then interrupts precomputation, then deselects") {
    Bench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    bench.control->pass_microseconds = 0;
    bench.control->hold = true;
    model.set_method(MethodId::Precomputed);
    // The first slice is held: the state shows once it is let go and the next one is under way.
    REQUIRE(bench.run_until(model, [&] { return bench.control->inside.load(); }));
    bench.control->hold = false;
    bench.run_until(model, [&] {
        bench.control->hold = model.status().state == WorkerState::Precomputing;
        return model.status().state == WorkerState::Precomputing || model.status().passes > 0;
    });
    model.window().help = true;
    model.cancel();
    CHECK_FALSE(model.window().help);
    CHECK(model.settings().method == MethodId::Precomputed);
    if (model.status().state == WorkerState::Precomputing) {
        model.cancel();
        CHECK(model.settings().method == MethodId::Default);
    }
    bench.control->hold = false;
}

TEST_CASE("Viewer model: title and command line tell what is shown") {
    Bench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    CHECK_THAT(model.title(), contains(" spp - Default - CPU - small"));
    CHECK(model.command_line() == "pathlight render small");
    model.set_paused(true);
    REQUIRE(bench.run_until(model, [&] { return model.status().state == WorkerState::Paused; }));
    CHECK_THAT(model.title(), contains("paused: "));
}

TEST_CASE("Viewer model: a back end that cannot be made ends the viewer with its own error") {
    Bench bench;
    bench.options.make_backend = [](const std::string&) -> std::unique_ptr<RenderBackend> {
        throw Error(ErrorKind::Unavailable, "no such device");
    };
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    CHECK_THROWS_AS(bench.run_until(model, [] { return false; }), Error);
}

TEST_CASE("Viewer model: the key for back ends goes round, however fast, and title and command line follow") {
    Bench bench;
    bench.options.command_line = [](const ViewerPicture& picture) { return "--backend " + picture.backend; };
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    CHECK(model.wanted_backend() == "cpu");
    for (int press = 0; press < 7; ++press) model.next_backend();
    CHECK(model.wanted_backend() == "cuda");
    REQUIRE(bench.run_until(model, [&] { return model.frame()->backend.name == "cuda"; }));
    CHECK(model.status().backend == "cuda");
    CHECK_THAT(model.title(), contains(" - CUDA - small"));
    CHECK(model.command_line() == "--backend cuda");
    CHECK(script_value(model, "shown_backend") == "cuda");
    CHECK((*model.status().backends)[1].device == "fake cuda");
    CHECK_THAT(model.log().back().text, contains("CUDA: fake cuda"));
    model.set_backend("cpu");
    REQUIRE(bench.run_until(model, [&] { return model.frame()->backend.name == "cpu"; }));
    CHECK((*model.status().backends)[0].device == "fake cpu, 1 thread");
}

TEST_CASE("Viewer model: a back end that cannot be had is told with its reason, and nothing changes") {
    Bench bench;
    bench.options.backends[1].unavailable = "no driver";
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().passes >= 3; }));
    const std::uint64_t generation = model.status().generation;
    model.next_backend();
    REQUIRE(model.toasts().size() == 1);
    CHECK(model.toasts().back().level == LogLevel::Warning);
    CHECK(model.toasts().back().text == "CUDA is unavailable: no driver");
    CHECK(model.wanted_backend() == "cpu");
    const std::uint32_t passes = model.status().passes;
    REQUIRE(bench.run_until(model, [&] { return model.status().passes > passes; }));
    CHECK(model.status().generation == generation);
    CHECK(bench.devices.cuda->made == 0);

    bench.options.backends.pop_back();
    ViewerModel lonely(bench.options, small_scene(), bench.options.settings, 0.0);
    lonely.next_backend();
    CHECK(lonely.toasts().back().text == "there is no other back end");
}

TEST_CASE("Viewer model: a back end that breaks is told in a toast, and the CPU goes on") {
    Bench bench;
    bench.options.first_backend = "cuda";
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    bench.devices.cuda->fail = true;
    REQUIRE(bench.run_until(model, [&] { return model.frame()->backend.name == "cpu"; }));
    REQUIRE_FALSE(model.toasts().empty());
    CHECK(model.toasts().back().level == LogLevel::Error);
    CHECK(model.toasts().back().text == "CUDA failed: the device is gone. CPU takes over");
    CHECK(model.log().back().text == model.toasts().back().text);
    model.next_backend();  // tries it again
    CHECK(bench.run_until(model, [&] { return model.frame()->backend.name == "cuda"; }));
}
