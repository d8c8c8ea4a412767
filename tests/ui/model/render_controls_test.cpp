// Settings of the rendering: views, back ends.
#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "ui/script/script_values.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Render controls: views are stepped through in both directions") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    model.render().step_view(-1);
    CHECK(model.render().settings().view == View::Unvisited);
    for (std::size_t i = 0; i < all_views().size(); ++i) model.render().step_view(1);
    CHECK(model.render().settings().view == View::Unvisited);
    model.render().step_view(1);
    CHECK(model.render().settings().view == View::Beauty);
}

TEST_CASE("Render controls: back ends are stepped through at any speed, and title and command line follow") {
    FileBench bench;
    bench.options.command_line = [](const ViewerPicture& picture) { return "--backend " + picture.backend; };
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    CHECK(model.render().wanted_backend() == "cpu");
    for (int press = 0; press < 7; ++press) model.render().next_backend();
    CHECK(model.render().wanted_backend() == "cuda");
    REQUIRE(bench.run_until(model, [&] { return model.frame()->backend.name == "cuda"; }));
    CHECK(model.status().backend == "cuda");
    CHECK_THAT(model.title(), contains(" - CUDA - small"));
    CHECK(model.files().pictures().command_line() == "--backend cuda");
    CHECK(script_value(model, "shown_backend") == "cuda");
    CHECK((*model.status().backends)[1].device == "fake cuda");
    CHECK_THAT(model.messages().log().back().text, contains("CUDA: fake cuda"));
    model.render().set_backend("cpu");
    REQUIRE(bench.run_until(model, [&] { return model.frame()->backend.name == "cpu"; }));
    CHECK((*model.status().backends)[0].device == "fake cpu, 1 thread");
}

TEST_CASE("Render controls: an unavailable back end is reported with its reason, and nothing changes") {
    FileBench bench;
    bench.options.backends[1].unavailable = "no driver";
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().passes >= 3; }));
    const std::uint64_t generation = model.status().generation;
    model.render().next_backend();
    REQUIRE(model.messages().toasts().size() == 1);
    CHECK(model.messages().toasts().back().level == MessageLevel::Warning);
    CHECK(model.messages().toasts().back().text == "CUDA is unavailable: no driver");
    CHECK(model.render().wanted_backend() == "cpu");
    const std::uint32_t passes = model.status().passes;
    REQUIRE(bench.run_until(model, [&] { return model.status().passes > passes; }));
    CHECK(model.status().generation == generation);
    CHECK(bench.devices.cuda->made == 0);

    bench.options.backends.pop_back();
    ViewerModel lonely(bench.options, small_scene(), bench.options.settings, 0.0);
    lonely.render().next_backend();
    CHECK(lonely.messages().toasts().back().text == "there is no other back end");
}

TEST_CASE("Render controls: an SD-tree is chosen on the CPU, and keeps the other back end away") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    FieldSettings tree = model.render().settings().field;
    tree.representation = Representation::SdTree;
    model.render().set_field(tree);
    CHECK(model.render().settings().field.representation == Representation::SdTree);
    model.render().set_backend("cuda");
    CHECK(model.render().wanted_backend() == "cpu");
    REQUIRE_FALSE(model.messages().toasts().empty());
    CHECK(model.messages().toasts().back().text == "CUDA has no kernels for the field SD-tree: it needs the CPU");
    FieldSettings sarsa = tree;
    sarsa.learning.target = LearningTarget::Sarsa;
    model.render().set_field(sarsa);
    CHECK(model.render().settings().field.learning.target == LearningTarget::ExpectedSarsa);
    CHECK(model.messages().toasts().back().text == "Sarsa trains tables alone: this field learns by Expected Sarsa");
    FieldSettings lobes = tree;
    lobes.representation = Representation::Lobes;
    model.render().set_field(lobes);
    CHECK(model.render().settings().field.representation == Representation::Lobes);
    model.render().set_backend("cuda");
    CHECK(model.messages().toasts().back().text == "CUDA has no kernels for the field Lobes: it needs the CPU");
    FieldSettings neural = tree;
    neural.representation = Representation::Neural;
    model.render().set_field(neural);
    model.render().set_backend("cuda");
    CHECK(model.render().wanted_backend() == "cuda");
    model.render().set_field(tree);
    CHECK(model.render().settings().field.representation == Representation::Neural);
}

TEST_CASE("Render controls: every representation is chosen") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    for (const ChoiceInfo<Representation>& info : kRepresentations) {
        FieldSettings field = model.render().settings().field;
        field.representation = info.value;
        model.render().set_field(field);
        CHECK(model.render().settings().field.representation == info.value);
    }
}

TEST_CASE("Render controls: a failure of a back end is reported, and the CPU takes over") {
    FileBench bench;
    bench.options.first_backend = "cuda";
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    bench.devices.cuda->fail = true;
    REQUIRE(bench.run_until(model, [&] { return model.frame()->backend.name == "cpu"; }));
    REQUIRE_FALSE(model.messages().toasts().empty());
    CHECK(model.messages().toasts().back().level == MessageLevel::Error);
    CHECK(model.messages().toasts().back().text == "CUDA failed: the device is gone. CPU takes over");
    CHECK(model.messages().log().back().text == model.messages().toasts().back().text);
    model.render().next_backend();  // tries it again
    CHECK(bench.run_until(model, [&] { return model.frame()->backend.name == "cuda"; }));
}
