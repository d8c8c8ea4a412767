// Options: parsing, precedence, and the way back to a command line.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <fmt/format.h>

#include "app/help.h"
#include "app/option_parsers.h"
#include "app/parse_values.h"
#include "app/version.h"
#include "core/io/load_scene.h"
#include "tests/app/parsing.h"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

/// A float of any finite bit pattern.
float any_float(std::mt19937& random) {
    for (;;) {
        const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (std::isfinite(value)) return value;
    }
}

glm::vec3 any_vector(std::mt19937& random) { return {any_float(random), any_float(random), any_float(random)}; }

/// Options that can be given, far from the defaults.
Options any_options(std::mt19937& random) {
    const auto whole = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    const auto real = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
    Options o;
    o.scene = "some folder/it's a $scene.json";
    o.output = "out \"1\".exr";
    o.render.method = all_methods()[static_cast<std::size_t>(whole(1, 2))].id;
    o.render.view = all_views()[static_cast<std::size_t>(whole(0, kViewCount - 1))].id;
    o.render.width = whole(1, 16384);
    o.render.height = whole(1, 16384);
    o.render.camera = {any_vector(random),   any_vector(random), any_vector(random),
                       real(0.001f, 179.9f), real(0.0f, 2.0f),   real(0.001f, 99.0f)};
    if (whole(0, 1) == 1) o.render.camera.shift = {any_float(random), any_float(random)};
    o.render.camera.is_mirrored = whole(0, 1) == 1;
    o.render.seed = (std::uint64_t{random()} << 32) | random();
    o.render.max_depth = whole(1, 65536);
    o.render.next_event = whole(0, 1) == 1;
    if (random() % 2 == 0) o.render.mixture = {.learned = 0, .bsdf_fraction = real(0.1f, 1.0f)};
    o.render.field.volumes = whole(0, 1) * whole(1, 1000000);
    o.render.field.budget_megabytes = real(0.5f, 9000.0f);
    o.render.field.bins = whole(2, 32);
    o.render.field.bins *= o.render.field.bins;
    o.render.field.precompute_samples = whole(1, 32);
    o.render.field.precompute_samples *= o.render.field.precompute_samples;
    if (random() % 2 == 0) o.render.field.refine_share = real(0.0f, 1.0f);
    o.render.field.rate = whole(0, 1) == 1 ? LearningRate::Forgetful : LearningRate::SampleMean;
    o.render.field.learning = {static_cast<LearningTarget>(whole(0, 2)), static_cast<LearnedLight>(whole(0, 1))};
    o.render.roulette = static_cast<RouletteRule>(whole(0, 2));
    o.render.guiding = static_cast<GuidingRule>(whole(0, 1));
    o.display.exposure_ev = real(-64.0f, 64.0f);
    o.display.curve = static_cast<ToneCurve>(whole(0, 2));
    if (whole(0, 1) == 1) o.spp = static_cast<std::uint32_t>(whole(1, 1000000000));
    if (whole(0, 1) == 1) o.time_limit_seconds = real(0.001f, 1.0e9f);
    if (whole(0, 1) == 1) o.load.default_light = whole(0, 1) == 1;
    if (whole(0, 1) == 1) o.load.up_axis = static_cast<UpAxis>(whole(0, 3));
    if (whole(0, 1) == 1) o.load.camera = "the side's camera";
    if (whole(0, 1) == 1) o.load.materials = "edited materials.json";
    for (int i = whole(0, 2); i > 0; --i) o.load.parameters.emplace_back("p" + std::to_string(i), "it's, $2 = 3");
    o.threads = whole(0, 1024);
    o.backend = whole(0, 1) == 1 ? "cpu" : "auto";
    return o;
}

void require_equal(const Options& a, const Options& b) {
    REQUIRE(a.scene == b.scene);
    REQUIRE(a.output == b.output);
    REQUIRE(a.render.method == b.render.method);
    REQUIRE(a.render.view == b.render.view);
    REQUIRE(a.render.width == b.render.width);
    REQUIRE(a.render.height == b.render.height);
    REQUIRE((a.render.camera.eye == b.render.camera.eye));
    REQUIRE((a.render.camera.target == b.render.camera.target));
    REQUIRE((a.render.camera.up == b.render.camera.up));
    REQUIRE(a.render.camera.fov_deg == b.render.camera.fov_deg);
    REQUIRE(a.render.camera.aperture_radius == b.render.camera.aperture_radius);
    REQUIRE(a.render.camera.focus_distance == b.render.camera.focus_distance);
    REQUIRE((a.render.camera.shift == b.render.camera.shift));
    REQUIRE(a.render.camera.is_mirrored == b.render.camera.is_mirrored);
    REQUIRE(a.render.seed == b.render.seed);
    REQUIRE(a.render.max_depth == b.render.max_depth);
    REQUIRE(a.render.next_event == b.render.next_event);
    REQUIRE(a.render.roulette == b.render.roulette);
    REQUIRE(a.render.mixture == b.render.mixture);
    REQUIRE((a.render.field == b.render.field));
    REQUIRE(a.display.exposure_ev == b.display.exposure_ev);
    REQUIRE(a.display.curve == b.display.curve);
    REQUIRE(a.spp == b.spp);
    REQUIRE(a.time_limit_seconds == b.time_limit_seconds);
    REQUIRE(a.load.default_light == b.load.default_light);
    REQUIRE(a.load.up_axis == b.load.up_axis);
    REQUIRE(a.load.camera == b.load.camera);
    REQUIRE(a.load.materials == b.load.materials);
    REQUIRE(a.load.parameters == b.load.parameters);
    REQUIRE(a.threads == b.threads);
    REQUIRE(a.backend == b.backend);
}

}  // namespace

TEST_CASE("a copied command gives back the options it was made from") {
    std::mt19937 random(7);
    const SceneDescription scene = plain_scene();
    for (int i = 0; i < 300; ++i) {
        const Options options = any_options(random);
        const std::string command = command_text(Command::Render, options, scene_defaults(options.scene, scene));
        std::vector<std::string> words = shell_words(command);
        REQUIRE(words.front() == "pathlight");
        words.erase(words.begin());
        CAPTURE(command);
        require_equal(parse(words, scene), options);
    }
}

TEST_CASE("a copied command leaves out the settings of the scene") {
    SceneDescription scene = plain_scene();
    scene.settings = {{"method", "precomputed"}, {"size", "640x360"}, {"nee", "on"}};
    Options options = scene_defaults("plain.json", scene);
    CHECK(command_text(Command::Render, options, scene_defaults("plain.json", scene)) ==
          "pathlight render plain.json");

    // Settings that differ from the scene's are part of the command, also if they are the program's defaults.
    options.render.method = MethodId::Default;
    options.render.next_event = false;
    CHECK(command_text(Command::Render, options, scene_defaults("plain.json", scene)) ==
          "pathlight render plain.json --method default --nee off");

    // Options shared with other subcommands are listed once.
    options.spp = 7;
    CHECK(command_text(Command::Render, options, scene_defaults("plain.json", scene)) ==
          "pathlight render plain.json --method default --nee off --spp 7");
}

TEST_CASE("options go over the scene's settings, settings over defaults") {
    SceneDescription scene = plain_scene();
    scene.settings = {{"spp", "7"}, {"seed", "9"}, {"height", "100"}, {"width", "300"}};
    const Options options = parse({"render", "s", "-o", "x.png", "--seed", "11"}, scene);
    CHECK(options.spp == 7u);
    CHECK(options.render.seed == 11u);
    CHECK(options.render.width == 300);
    CHECK(options.render.height == 100);
    CHECK(options.render.max_depth == 64);
    CHECK(options.render.camera.eye.x == 1.0f);
}

TEST_CASE("one side of the picture keeps the scene's aspect") {
    SceneDescription scene = plain_scene();
    scene.settings = {{"size", "300x100"}};
    const Options narrow = parse({"render", "s", "-o", "x.png", "--width", "30"}, scene);
    CHECK(narrow.render.width == 30);
    CHECK(narrow.render.height == 10);
    const Options tall = parse({"render", "s", "-o", "x.png", "--height=7"}, scene);
    CHECK(tall.render.width == 21);
    const Options square = parse({"render", "s", "-o", "x.png", "--width", "30"});
    CHECK(square.render.height == 30);
    const Options both = parse({"render", "s", "-o", "x.png", "--size", "5x9", "--height", "4"}, scene);
    CHECK(both.render.width == 5);
    CHECK(both.render.height == 4);
}

TEST_CASE("the limits: 64 samples unless something else is given") {
    CHECK(parse({"render", "s", "-o", "x.png"}).spp_limit() == 64);
    CHECK(parse({"render", "s", "-o", "x.png", "--spp", "3"}).spp_limit() == 3);
    CHECK(parse({"render", "s", "-o", "x.png", "--time-limit", "3"}).spp_limit() ==
          std::numeric_limits<std::uint32_t>::max());
    CHECK(parse({"render", "s", "-o", "x.png", "--time-limit", "3", "--spp", "5"}).spp_limit() == 5);
    CHECK(parse({"render", "s", "-o", "x.png", "--target-error", "3"}).spp_limit() ==
          std::numeric_limits<std::uint32_t>::max());
}

TEST_CASE("a target error in a scene is for rendered pictures of light only") {
    SceneDescription scene;
    scene.settings = {{"target-error", "0.5"}};
    CHECK(parse({"render", "s", "-o", "x.png"}, scene).target_error == 0.5);
    CHECK_FALSE(parse({"render", "s", "-o", "x.png", "--view", "normal"}, scene).target_error);
    CHECK_FALSE(parse({"inspect", "s", "--at", "0,0,0", "-o", "x.png"}, scene).target_error);
    CHECK_FALSE(parse({"bench", "s", "-o", "x"}, scene).target_error);
    CHECK_FALSE(parse({"view", "s"}, scene).target_error);
}

TEST_CASE("spellings: aliases, equals signs, negative numbers, the last of two") {
    const Options options =
        parse({"render", "--scene=s", "--outfile", "x.pfm", "--samples=5", "-t3", "--eye", "-1,-2,-3.5", "--exposure",
               "-2", "--seed", "1", "--seed", "2", "--headless", "--fov=+30"});
    CHECK(options.scene == "s");
    CHECK(options.output == "x.pfm");
    CHECK(options.spp == 5u);
    CHECK(options.threads == 3);
    CHECK((options.render.camera.eye == glm::vec3(-1, -2, -3.5f)));
    CHECK(options.display.exposure_ev == -2.0f);
    CHECK(options.render.seed == 2u);
    CHECK(options.render.camera.fov_deg == 30.0f);
}

TEST_CASE("without a subcommand the viewer opens, on the Cornell box") {
    CHECK(parse_command_line({}).command == Command::View);
    CHECK(parse_command_line({}).options.scene == "cornell");
    CHECK(parse_command_line({"--software"}).options.software);
    CHECK(parse_command_line({"door"}).options.scene == "door");
    CHECK(parse_command_line({"some/file.obj", "--spp", "3"}).options.scene == "some/file.obj");
    CHECK(parse_command_line({"view", "door"}).options.scene == "door");
}

TEST_CASE("help, version and lists are answers, whatever else is missing") {
    CHECK_THAT(*parse_command_line({"--help"}).answer, contains("inspect SCENE"));
    CHECK_THAT(*parse_command_line({"-h"}).answer, contains("Exit codes"));
    CHECK_THAT(*parse_command_line({"render", "--help"}).answer, contains("--method"));
    CHECK_THAT(*parse_command_line({"render", "--help-all"}).answer, contains("--bsdf-fraction"));
    CHECK_THAT(*parse_command_line({"--help-all"}).answer, contains("--ui-trace"));
    CHECK_THAT(*parse_command_line({"--list-methods"}).answer, contains("reinforcement"));
    CHECK_THAT(*parse_command_line({"render", "--list-views"}).answer,
               contains("radiance-map") && contains("bsdf-share"));
    CHECK_THAT(*parse_command_line({"--list-methods", "--json"}).answer, contains("{\"schema\""));
}

TEST_CASE("the version names all that a report of a fault needs") {
    const std::vector<std::string> lines = lines_of(*parse_command_line({"--version"}).answer);
    REQUIRE(lines.size() == 6);
    CHECK(lines[0].starts_with("pathlight "));
    CHECK(lines[1] == "commit     " + std::string(commit_id()));
    CHECK((lines[2].starts_with("compiler   GCC ") || lines[2].starts_with("compiler   Clang ")));
    CHECK((lines[3] == "back ends  cpu, cuda" || lines[3] == "back ends  cpu (built without cuda)"));
    CHECK_THAT(lines[4], contains("vectors    baseline") && contains("this machine: "));
    CHECK((lines[5] == "MPI        yes" || lines[5] == "MPI        no"));
    CHECK(*parse_command_line({"render", "--version"}).answer == *parse_command_line({"--version", "-v"}).answer);
}

TEST_CASE("'help' is the help of a subcommand") {
    CHECK(parse_command_line({"help"}).answer == parse_command_line({"--help"}).answer);
    for (const CommandInfo& info : all_commands())
        CHECK(parse_command_line({"help", std::string(info.name)}).answer ==
              parse_command_line({std::string(info.name), "--help"}).answer);
    CHECK_THAT(complaint({"help", "rendr"}),
               contains("unknown subcommand 'rendr'") && contains("did you mean 'render'?"));
    CHECK_THAT(complaint({"help", "render", "bench"}), contains("'help': expected one subcommand, got render bench"));
    CHECK_THAT(complaint({"hepl"}), contains("did you mean 'help'?"));
}

TEST_CASE(
    "every option that can be given is in the full help of its subcommand, about twenty are in that of render") {
    const auto is_listed = [](const std::string& help, const OptionSpec& spec) {
        return help.find("--" + std::string(spec.name)) != std::string::npos;
    };
    for (const CommandInfo& info : all_commands()) {
        const std::string command(info.name);
        const std::string usual = *parse_command_line({command, "--help"}).answer;
        const std::string all = *parse_command_line({command, "--help-all"}).answer;
        int shown = 0;
        for (const OptionSpec& spec : option_table()) {
            if (spec.group.empty() || !spec.commands.has(info.id)) continue;
            CAPTURE(command, std::string(spec.name));
            CHECK(is_listed(all, spec));
            if (!spec.is_expert) CHECK(is_listed(usual, spec));
            shown += spec.is_expert ? 0 : 1;
        }
        CHECK(shown <= 25);
        if (info.id == Command::Render) CHECK(shown >= 15);
        for (const std::string& help : {usual, all, program_help()})
            for (const std::string& line : lines_of(help)) {
                CAPTURE(line);
                CHECK(line.size() <= 100);
            }
    }
}

TEST_CASE("every option is in the manual, or in the page on measuring") {
    const std::string pages =
        read_all(PL_SOURCE_DIR "/docs/manual.md") + read_all(PL_SOURCE_DIR "/docs/measuring.md");
    for (const OptionSpec& spec : option_table()) {
        if (spec.group.empty()) continue;
        const std::string flags(spec.flags);
        CAPTURE(flags);
        CHECK(pages.find("--" + std::string(spec.name)) != std::string::npos);
        for (const std::string& flag : split(flags, ',')) CHECK(pages.find("`" + flag) != std::string::npos);
    }
    for (const CommandInfo& info : all_commands())
        CHECK_THAT(pages, contains(fmt::format("pathlight {}", info.id == Command::View ? "[view]" : info.name)));
}

TEST_CASE("each subcommand's help ends with three examples that can be given") {
    const std::vector<std::string> scenes = list_scenes(find_assets_dir());
    for (const CommandInfo& info : all_commands()) {
        const std::string help = *parse_command_line({std::string(info.name), "--help"}).answer;
        for (const std::string_view example : info.examples) {
            CAPTURE(std::string(example));
            std::vector<std::string> words = shell_words(std::string(example));
            REQUIRE(words.front() == "pathlight");
            words.erase(words.begin());
            const CommandLine line = parse_command_line(words);
            CHECK_FALSE(line.answer);
            CHECK(line.command == info.id);
            std::vector<std::string> opened{line.options.scene};
            if (info.inputs == Inputs::Scenes) opened = line.options.inputs;
            for (const std::string& scene : opened)
                CHECK((scene.empty() || scene.find('.') != std::string::npos ||
                       std::ranges::find(scenes, scene) != scenes.end()));
        }
        CHECK(help.ends_with(
            fmt::format("\nExamples:\n  {}\n  {}\n  {}\n", info.examples[0], info.examples[1], info.examples[2])));
    }
}

TEST_CASE("a camera file goes over the scene's camera, single options over both") {
    const TempDir folder;
    write_all(folder / "camera.json",
              R"({"eye": [7, 8, 9], "fov_deg": 33, "aperture_radius": 0.5, "focus_distance": 6})");
    const Options options = parse({"render", "s", "-o", "x.png", "--fov", "44", "--camera", folder / "camera.json"});
    CHECK((options.render.camera.eye == glm::vec3(7, 8, 9)));
    CHECK((options.render.camera.target == glm::vec3(4, 5, 6)));
    CHECK(options.render.camera.fov_deg == 44.0f);
    CHECK(options.render.camera.aperture_radius == 0.5f);
    CHECK(options.render.camera.focus_distance == 6.0f);

    write_all(folder / "camera.json", "{\n \"eye\": [7, 8, 9],\n \"fov\": 33\n}");
    try {
        parse({"render", "s", "-o", "x.png", "--camera", folder / "camera.json"});
        FAIL("an unknown key was accepted");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Input);
        CHECK_THAT(error.what(), contains("camera.json:3") && contains("fov_deg"));
    }
}

TEST_CASE("a camera is parts of a file, parts as text, and the name of one that the scene lists, over each other") {
    const TempDir folder;
    write_all(folder / "lens.json", R"({"aperture_radius": 0.5, "focus_distance": 6})");
    write_all(folder / "plain", R"({"shift_y": 0.25})");
    const Options options =
        parse({"render", "s", "-o", "x.png", "--camera", "far", "--camera", folder / "lens.json", "--camera",
               R"({"focus_distance": 7, "mirrored": true})", "--camera", folder / "plain", "--up", "0,0,1"});
    CHECK(options.load.camera == "far");
    CHECK(options.render.camera.aperture_radius == 0.5f);
    CHECK(options.render.camera.focus_distance == 7.0f);
    CHECK(options.render.camera.is_mirrored);
    CHECK((options.render.camera.shift == glm::vec2(0.0f, 0.25f)));
    CHECK((options.render.camera.up == glm::vec3(0, 0, 1)));
    CHECK_THAT(command_text(Command::Render, options, scene_defaults("s", plain_scene())),
               contains(R"( --camera far --camera '{"aperture_radius":0.5,"focus_distance":7}' )"
                        R"(--camera '{"shift_x":0,"shift_y":0.25}' --camera '{"mirrored":true}')"));
    for (const auto& [text, expected] : {std::pair{R"({"focus": 7})", "focus_distance"},
                                         {R"({"aperture_radius": -1})", "expected a number of at least 0"},
                                         {R"({"fov_deg": 180})", "expected an angle between 0 and 180 degrees"},
                                         {R"({"focus_distance": 0})", "expected a number above 0"},
                                         {"{", "--camera: JSON:1"}})
        CHECK_THAT(complaint({"render", "s", "-o", "x.png", "--camera", text}), contains(expected));
    CHECK_THROWS(parse({"render", "s", "-o", "x.png", "--camera", folder / "missing.json"}));
}

TEST_CASE("scene files may set exactly the options that the table says") {
    const TempDir folder;
    write_all(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const OptionSpec& spec : option_table()) {
        CAPTURE(std::string(spec.name));
        write_all(folder / "a.json", "{\"schema\": \"pathlight.scene/1\", \"obj\": \"a.obj\", \"settings\": {\"" +
                                         std::string(spec.name) + "\": 1}}");
        bool accepted = true;
        try {
            load_scene(folder / "a.json", "");
        } catch (const Error& error) {
            CHECK_THAT(error.what(), contains("unknown key"));
            accepted = false;
        }
        // An option may mean different things in different subcommands.
        const bool may_be_set =
            std::any_of(option_table().begin(), option_table().end(),
                        [&spec](const OptionSpec& other) { return other.name == spec.name && other.in_scene_files; });
        CHECK(accepted == may_be_set);
    }
}

TEST_CASE("a wrong setting of a scene file is told with its file and line") {
    const TempDir folder;
    write_all(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_all(folder / "a.json", "{\"schema\": \"pathlight.scene/1\",\n\"obj\": \"a.obj\",\n\"settings\": {\n"
                                 "\"seed\": 3,\n\"spp\": -5}}");
    const SceneDescription scene = load_scene(folder / "a.json", "");
    try {
        parse({"render", "s", "-o", "x.png"}, scene);
        FAIL("-5 samples were accepted");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Input);
        CHECK_THAT(error.what(), contains("a.json:5") && contains("expected a whole number from 1"));
    }
}

TEST_CASE("numbers print as text that reads back to the same bits") {
    std::mt19937 random(3);
    for (int i = 0; i < 10000; ++i) {
        const float value = any_float(random);
        REQUIRE(std::bit_cast<std::uint32_t>(parse_float(print_float(value))) == std::bit_cast<std::uint32_t>(value));
    }
}

}  // namespace pl::test
