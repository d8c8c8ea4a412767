// Learned fields: saved, loaded, and continued from.
#include <filesystem>
#include <fstream>
#include <set>

#include "core/io/field_file.h"
#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "tests/ui/installed_programs.h"
#include "ui/compare/half_image.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Picture files: saves both formats under one new number") {
    FileBench bench;
    std::ofstream(bench.options.screenshot_dir / "small-default-0001.png") << "x";
    {
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        model.files().pictures().save_exr_and_png();
        CHECK(model.messages().toasts().back().level == MessageLevel::Warning);  // nothing to save yet
        REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
        model.files().pictures().save_exr_and_png();
        model.files().pictures().save_png();
    }  // requested pictures are written before the end
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(bench.options.screenshot_dir))
        names.insert(entry.path().filename().string());
    CHECK(names == std::set<std::string>{"small-default-0001.png", "small-default-0002.exr", "small-default-0002.png",
                                         "small-default-0003.png"});
    ImageMetadata metadata;
    CHECK(read_exr(bench.options.screenshot_dir / "small-default-0002.exr", &metadata).width == 64);
    CHECK(text_of(metadata, "command") == "pathlight render small");
}

TEST_CASE(
    "Picture files: one with linear values that is opened becomes side B, ends turns, and is refused if damaged") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.comparison().set_turns(true);
    const std::filesystem::path path = bench.folder.path() / "other.exr";
    write_exr(path, {.width = 2, .height = 1, .pixels = {glm::vec3(0.5f), glm::vec3(2.0f)}});
    model.files().open(path.string());
    REQUIRE(bench.run_until(model, [&] { return model.comparison().opened() != nullptr; }));
    CHECK(model.comparison().opened()->name == "other.exr");
    CHECK(pixels_of(*model.comparison().opened()->pixels)[1] == glm::vec3(2.0f));
    CHECK(model.comparison().state().mode == CompareMode::Split);
    CHECK(model.comparison().state().b.what == SideChoice::What::File);
    CHECK_FALSE(model.comparison().in_turns());
    model.files().open(bench.folder.write("bad.pfm", "PF").string());
    CHECK(bench.run_until(model, [&] { return told(model, "bad.pfm"); }));
    CHECK(model.comparison().opened()->name == "other.exr");
}

TEST_CASE("Picture files: one of display values is compared as it is, and has no linear values") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    const std::filesystem::path path = bench.folder.path() / "other.PNG";
    write_png8(path, {.width = 2, .height = 1, .rgb = {0, 128, 255, 1, 2, 3}});
    model.files().open(path.string());
    REQUIRE(bench.run_until(model, [&] { return told(model, "other.PNG is compared as B, by eye"); }));
    const OpenedPicture& opened = *model.comparison().opened();
    CHECK(opened.is_display);
    // The codes of the file come back at any exposure of the window.
    const HalfCodes codes{DisplaySettings{}};
    CHECK(codes.pixel(opened.pixels->rgb.data()) == 0xff0080ffu);
    CHECK(codes.pixel(opened.pixels->rgb.data() + 3) == 0xff010203u);
}

TEST_CASE("Picture files: the path of a file is pasted as text, URI or in quotes, else the copied picture") {
    InstalledPrograms installed;
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    const auto file = [&](const std::string& name) {
        const std::filesystem::path path = bench.folder.path() / name;
        write_exr(path, {.width = 1, .height = 1, .pixels = {glm::vec3(0.5f)}});
        return path.string();
    };
    const auto compares = [&](const std::string& name) {
        return bench.run_until(model, [&] {
            return model.comparison().opened() != nullptr && model.comparison().opened()->name == name;
        });
    };
    model.files().paste(file("plain.exr") + "\n");
    CHECK(compares("plain.exr"));
    model.files().paste("'" + file("in quotes.exr") + "'");
    CHECK(compares("in quotes.exr"));
    (void)file("50 %.exr");
    model.files().paste("file://" + bench.folder.path().string() + "/50%20%25.exr\r\nfile:///other.exr\r\n");
    CHECK(compares("50 %.exr"));
    model.files().paste("pathlight render cornell");
    CHECK(bench.run_until(model, [&] { return told(model, "a picture cannot be pasted: install"); }));
    installed.add("xclip", "exit 1");
    model.files().paste("");
    CHECK(bench.run_until(model,
                          [&] { return told(model, "the clipboard has neither the path of a file nor a picture"); }));
    CHECK(compares("50 %.exr"));
    const std::filesystem::path png = bench.folder.path() / "source.png";
    write_png8(png, {.width = 1, .height = 1, .rgb = {10, 20, 30}});
    installed.add("xclip", "cat " + png.string());
    model.files().paste("");
    CHECK(compares("the copied picture"));
}

TEST_CASE("Saved fields: a learned field is saved, and rendering continues from it") {
    FileBench bench;
    {
        ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
        const auto told = [&](const char* text) {
            return bench.run_until(model, [&] {
                return !model.messages().toasts().empty() &&
                       model.messages().toasts().back().text.find(text) != std::string::npos;
            });
        };
        REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
        model.files().fields().load_newest();
        CHECK(told("no learned field of small was saved in"));
        model.files().fields().save();
        CHECK(told("method 'default' has learned nothing yet"));
        model.render().set_method(MethodId::Reinforcement);
        const auto learned = [&] { return model.status().field ? model.status().field->passes : 0; };
        REQUIRE(bench.run_until(model, [&] { return learned() >= 20; }));
        model.files().fields().save();
        REQUIRE(told("small-reinforcement-0001.field: reinforcement, "));
        const std::filesystem::path file = bench.options.screenshot_dir / "small-reinforcement-0001.field";
        const std::uint64_t saved = read_field(file).progress.passes;
        REQUIRE(saved >= 20);

        model.render().set_method(MethodId::Default);
        FieldSettings other = model.render().settings().field;
        other.bins = 64;
        model.render().set_field(other);
        model.render().forget();
        bench.control->pass_microseconds = 20000;  // so that it cannot catch up
        REQUIRE(bench.run_until(model, [&] { return model.frame()->settings.field.bins == 64; }));
        model.files().fields().load_newest();
        REQUIRE(told("continuing from "));
        CHECK(model.render().settings().method == MethodId::Reinforcement);
        CHECK(model.render().settings().field.bins == 16);
        REQUIRE(bench.run_until(model, [&] { return learned() >= saved; }));
        CHECK(learned() < saved + 20);
        CHECK(model.frame()->backend.name == "cpu");

        model.files().open((bench.options.screenshot_dir / "gone.field").string());
        CHECK(told("gone.field: "));
        CHECK(model.render().settings().method == MethodId::Reinforcement);
    }
}

TEST_CASE("Saved fields: a viewer started from a field continues from it") {
    FileBench bench;
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
        REQUIRE(eventually([&] { return (answer = worker.take<LearnedAnswer>()).has_value(); }));
        REQUIRE(answer->value);
        bench.options.field = answer->value;
    }
    bench.options.settings.method = MethodId::Reinforcement;
    bench.options.settings.field = bench.options.field->settings;
    bench.control->pass_microseconds = 20000;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model) && model.status().field; }));
    CHECK(bench.run_until(model, [&] { return model.status().field->passes >= 30; }));
    CHECK(model.status().field->passes < 60);
}
