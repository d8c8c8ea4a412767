// Refused options, and their messages.
#include "core/fields/field_kernels.h"
#include "tests/app/parsing.h"
#include "tests/support/files/input_error.h"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

/// A complete command with `words` at its end.
std::vector<std::string> render_with(const std::vector<std::string>& words) {
    std::vector<std::string> arguments{"render", "s", "-o", "x.png"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    return arguments;
}

}  // namespace

TEST_CASE("wrong values name the option, the expected and the given value") {
    struct Wrong {
        std::vector<std::string> words;
        std::string expected;
    };
    const std::vector<Wrong> wrongs{
        {{"--spp", "-4"}, "--spp: expected a whole number from 1"},
        {{"--spp", "0"}, "--spp: expected"},
        {{"--spp", "1.5"}, "--spp: expected"},
        {{"--spp", ""}, "--spp: expected"},
        {{"--spp", "12abc"}, "--spp: expected"},
        {{"--spp", "99999999999999999999"}, "--spp: expected"},
        {{"--time-limit", "0"}, "--time-limit: expected a number of seconds above 0"},
        {{"--time-limit", "-1"}, "--time-limit: expected"},
        {{"--time-limit", "nan"}, "--time-limit: expected"},
        {{"--size", "0x512"}, "--size: expected WIDTHxHEIGHT, each from 1 to 16384"},
        {{"--size", "512"}, "--size: expected"},
        {{"--size", "512x"}, "--size: expected"},
        {{"--size", "5x5x5"}, "--size: expected"},
        {{"--size", "16385x1"}, "--size: expected"},
        {{"--width", "0"}, "--width: expected a whole number from 1 to 16384"},
        {{"--height", "16385"}, "--height: expected"},
        {{"--default-light", "yes"}, "--default-light: expected on or off, got 'yes'"},
        {{"--default-light", ""}, "--default-light: expected on or off"},
        {{"--up-axis", "w"}, "--up-axis: expected auto, x, y or z, got 'w'"},
        {{"--up-axis", "Z"}, "--up-axis: expected auto, x, y or z"},
        {{"--crop", ""}, "--crop: expected a window X,Y,W,H, four whole numbers, got ''"},
        {{"--crop", "1,2,3"}, "--crop: expected a window X,Y,W,H"},
        {{"--crop", "1,2,3,4,5"}, "--crop: expected a window X,Y,W,H"},
        {{"--crop", "-1,0,8,8"}, "--crop: expected a whole number from 0 to 16383, got '-1'"},
        {{"--crop", "0,0,0,8"}, "--crop: expected a whole number from 1 to 16384, got '0'"},
        {{"--crop", "0,0,8,nan"}, "--crop: expected a whole number from 1 to 16384, got 'nan'"},
        {{"--crop", "0.5,0,8,8"}, "--crop: expected a whole number from 0 to 16383, got '0.5'"},
        {{"--crop", "0,0,8,18446744073709551616"}, "--crop: expected a whole number from 1 to 16384"},
        {{"--crop", "0,,8,8"}, "--crop: expected a whole number from 0 to 16383, got ''"},
        {{"--crop", "500,0,16,16"},
         "--crop: expected a window within the picture of 512x512 pixels, got 16x16 at 500,0"},
        {{"--size", "64x32", "--crop", "0,0,64,33"},
         "--crop: expected a window within the picture of 64x32 pixels, got 64x33 at 0,0"},
        {{"--crop", "16383,16383,16384,16384"}, "got 16384x16384 at 16383,16383"},
        {{"-D", ""}, "--define: expected NAME=VALUE, such as opening=5, got ''"},
        {{"-D", "name"}, "--define: expected NAME=VALUE"},
        {{"-D", "=3"}, "--define: expected NAME=VALUE"},
        {{"-D", "a=1\n2"}, "--define: expected NAME=VALUE"},
        {{"--roulette", "none"}, "--roulette: expected spare, albedo or off, got 'none'"},
        {{"--roulette", ""}, "--roulette: expected spare, albedo or off, got ''"},
        {{"--bins", "200"}, "--bins: expected a square number"},
        {{"--bins", "1"}, "--bins: expected"},
        {{"--bins", "2025"}, "--bins: expected"},
        {{"--learn", "probes=0"}, "--learn: probes: expected a whole number from 1 to 1024"},
        {{"--learn", "probes=8"}, "--learn: probes: expected a square number"},
        {{"--fov", "0"}, "--fov: expected an angle between 0 and 180"},
        {{"--fov", "180"}, "--fov: expected"},
        {{"--fov", "inf"}, "--fov: expected"},
        {{"--eye", "1,2"}, "--eye: expected three numbers X,Y,Z"},
        {{"--eye", "1,2,nan"}, "--eye: expected"},
        {{"--up", "0,0,0"}, "--up: expected a direction"},
        {{"--eye", "4,5,6"}, "--eye, --target: expected two different points"},
        {{"--bsdf-fraction", "0.05"}, "--bsdf-fraction: expected a number from 0.1 to 1, or learned, got '0.05'"},
        {{"--bsdf-fraction", "1.01"}, "--bsdf-fraction: expected"},
        {{"--nee", "yes"}, "--nee: expected on or off, got 'yes'"},
        {{"--method", "reinforcment"},
         "--method: expected default, precomputed or reinforcement, got 'reinforcment', "
         "did you mean 'reinforcement'?"},
        {{"--view", "voroni"}, "did you mean 'voronoi'?"},
        {{"--backend", "gpu"}, "--backend: expected auto, cpu or cuda"},
        {{"--tonemap", "filmic"}, "--tonemap: expected clamp, reinhard or aces"},
        {{"--exposure", "65"}, "--exposure: expected"},
        {{"--max-depth", "0"}, "--max-depth: expected"},
        {{"--threads", "0"}, "--threads: expected"},
        {{"--volumes", "0"}, "--volumes: expected"},
        {{"--field-budget", "0"}, "--field-budget: expected"},
        {{"--learn", "refine=1.01"}, "--learn: refine: expected a number from 0 to 1, or auto, got '1.01'"},
        {{"--learn", "passes=9,refine=-0.1"}, "--learn: refine: expected a number from 0 to 1"},
        {{"--learn", "refine=nan"}, "--learn: refine: expected"},
        {{"--learn", "refine=half"}, "--learn: refine: expected"},
        {{"--learn", "rate=means"}, "--learn: rate: expected mean or forgetful, got 'means', did you mean 'mean'?"},
        {{"--learn", "rate=power"}, "--learn: rate: expected mean or forgetful, got 'power'"},
        {{"--learn", "passes"}, "--learn: expected NAME=VALUE, such as passes=16, got 'passes'"},
        {{"--learn", "probe=1"},
         "--learn: expected refine, passes, target, from, rate or probes, got 'probe', did you mean 'probes'?"},
        {{"--learn", ""}, "--learn: expected refine, passes"},
        {{"--learn", "probes=4,"}, "--learn: expected refine, passes"},
        {{"--field", "sdtree"},
         "--field: expected table, sd-tree, lobes or neural, got 'sdtree', did you mean 'sd-tree'?"},
        {{"--field", "sd-tree", "--learn", "target=sarsa"},
         "--learn target=sarsa: expected --field table with it, got --field sd-tree"},
        {{"--field", "neural", "--learn", "target=monte-carlo"},
         "--learn target=monte-carlo: expected --field table with it, got --field neural"},
        {{"--field", "sd-tree", "--method", "precomputed"},
         "--field sd-tree: expected --field table with --method precomputed, whose probes fill tables"},
        {{"--field", "lobes", "--method", "precomputed"},
         "--field lobes: expected --field table with --method precomputed, whose probes fill tables"},
        {{"--field", "neural", "--method", "precomputed"},
         "--field neural: expected --field table with --method precomputed, whose probes fill tables"},
        {{"--learn", "target=montecarlo"},
         "--learn: target: expected expected-sarsa, sarsa or monte-carlo, got 'montecarlo', did you mean "
         "'monte-carlo'?"},
        {{"--learn", "from=direct"},
         "--learn: from: expected all or indirect, got 'direct', did you mean 'indirect'?"},
        {{"--roulette", "abledo"}, "--roulette: expected spare, albedo or off, got 'abledo', did you mean 'albedo'?"},
        {{"--seed", "-1"}, "--seed: expected a whole number of at least 0"},
        {{"--seed", "18446744073709551616"}, "--seed: expected"},
    };
    for (const Wrong& wrong : wrongs) {
        CAPTURE(wrong.words);
        CHECK_THAT(complaint(render_with(wrong.words)), contains(wrong.expected));
    }
}

TEST_CASE("a crop is a camera and a size, whatever gave the whole picture its own") {
    SceneDescription scene = plain_scene();
    scene.settings = {{"size", "640x360"}};
    const Options whole = parse(render_with({}), scene);
    const Options part = parse(render_with({"--crop", "320,45,160,90"}), scene);
    CHECK(part.render.width == 160);
    CHECK(part.render.height == 90);
    CHECK(part.render.camera.fov_deg < whole.render.camera.fov_deg);
    CHECK(part.render.camera.shift.x == Approx(80.0f / 90.0f));
    CHECK(part.render.camera.shift.y == Approx(1.0f));
    // The copied command has no crop, and is of the same picture to the bit.
    const std::string command = command_text(Command::Render, part, scene_defaults("s", scene));
    CHECK_THAT(command, contains("--size 160x90") && contains("--camera '{\"shift_x\":") && !contains("aperture"));
    CHECK_FALSE(command.find("--crop") != std::string::npos);
    std::vector<std::string> arguments = shell_words(command);
    arguments.erase(arguments.begin());
    const Options again = parse(arguments, scene);
    CHECK(again.render.camera.fov_deg == part.render.camera.fov_deg);
    CHECK(again.render.camera.shift == part.render.camera.shift);
    CHECK(again.render.width == 160);
    const Options all = parse(render_with({"--crop", "0,0,640,360"}), scene);
    CHECK(all.render.camera.fov_deg == whole.render.camera.fov_deg);
    CHECK(all.render.camera.shift == whole.render.camera.shift);
}

TEST_CASE("parameters of a scene are kept in their order and come back from a copied command") {
    const std::vector<std::string> given{"-D", "a=1,2", "--define", "b=x y", "-Dc=", "-D", "a=$b=3"};
    const Options options = parse(render_with(given));
    using Parameters = std::vector<std::pair<std::string, std::string>>;
    CHECK(options.load.parameters == Parameters{{"a", "1,2"}, {"b", "x y"}, {"c", ""}, {"a", "$b=3"}});
    CHECK_THAT(command_text(Command::Render, options, scene_defaults("s", plain_scene())),
               contains(" --define a=1,2 --define 'b=x y' --define c= --define 'a=$b=3'"));
}

TEST_CASE("roulette off is a setting like its rules") {
    SceneDescription scene = plain_scene();
    scene.settings = {{"roulette", "off"}};
    CHECK(parse(render_with({}), scene).render.roulette == kNoRoulette);
    CHECK(parse(render_with({"--roulette", "spare"}), scene).render.roulette == RouletteRule::Spare);
    const Options options = parse(render_with({"--roulette", "off"}));
    CHECK_THAT(command_text(Command::Render, options, scene_defaults("s", plain_scene())),
               contains(" --roulette off"));
}

TEST_CASE("the limits of values are values") {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"--bsdf-fraction", "0.1"},
                                               {"--bsdf-fraction", "1"},
                                               {"--bins", "4"},
                                               {"--bins", "1024"},
                                               {"--learn", "probes=1"},
                                               {"--learn", "probes=1024"},
                                               {"--size", "16384x1"},
                                               {"--seed", "18446744073709551615"},
                                               {"--fov", "179.99"},
                                               {"--max-depth", "1"},
                                               {"--learn", "refine=auto"},
                                               {"--learn", "refine=0,refine=0.5"},
                                               {"--learn", "refine=1"}}) {
        CAPTURE(words);
        CHECK_NOTHROW(parse(render_with(words)));
    }
    CHECK(parse(render_with({"--bsdf-fraction", "0.1"})).render.mixture.bsdf_fraction >= 0.1f);
    CHECK(parse(render_with({"--bsdf-fraction", "0.1"})).render.mixture.learned == 0);
    CHECK(parse(render_with({"--bsdf-fraction", "learned"})).render.mixture == MixtureSettings{});
}

TEST_CASE("what is learned how is one option of many values, on the command line and in scene files") {
    SceneDescription scene = plain_scene();
    scene.settings = {{"learn", "refine=0.25,passes=8"}};
    const Options options = parse(render_with({"--learn", "target=sarsa,passes=9", "--learn", "rate=mean"}), scene);
    CHECK(options.render.field.refine_share == 0.25f);
    CHECK(options.render.learn_passes == 9);
    CHECK(options.render.field.learning.target == LearningTarget::Sarsa);
    CHECK(options.render.field.rate == LearningRate::SampleMean);
    // The copied command has what differs from the scene.
    const std::string command = command_text(Command::Render, options, scene_defaults("s", scene));
    CHECK_THAT(command, contains(" --learn passes=9 --learn target=sarsa --learn rate=mean"));
    CHECK(command.find("refine") == std::string::npos);
}

TEST_CASE("the viewer refuses to save a field by an option, and says how it saves one") {
    CHECK_THAT(complaint({"view", "s", "--save-field", "f"}),
               contains("--save-field: the viewer saves") && contains("Ctrl+Shift+S"));
}

TEST_CASE("unknown words name the nearest one, if any is near") {
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"--backend", "gpu"}, {"--method", "rl"}, {"--tonemap", "filmic"}, {"--zz", "1"}})
        CHECK(complaint(render_with(words)).find("did you mean") == std::string::npos);
    CHECK(complaint({"man"}).find("did you mean") == std::string::npos);
    CHECK_THAT(complaint({"cornel"}), contains("did you mean 'cornell'?"));
    CHECK_THAT(complaint({"rendr", "s"}), contains("did you mean 'render'?"));
    CHECK_THAT(complaint(render_with({"--sppp", "3"})), contains("did you mean '--spp'?"));
    CHECK_THAT(complaint(render_with({"--metod=default"})), contains("did you mean '--method'?"));
    CHECK_THAT(complaint({"devices", "--jsn"}), contains("did you mean '--json'?"));
    CHECK_THAT(complaint({"info", "s", "--bins", "4"}), contains("unknown option '--bins' of 'info'"));
    CHECK_THAT(complaint({"render", "s", "t", "-o", "x.png"}), contains("unexpected argument 't'"));
}

TEST_CASE("SD-trees and lobes take the CPU and refuse CUDA, fields with tables do not") {
    CHECK(parse(render_with({"--method", "reinforcement"})).backend == "auto");
    CHECK(is_for_devices(Representation::Table));
    CHECK_FALSE(is_for_devices(Representation::SdTree));
    CHECK_FALSE(is_for_devices(Representation::Lobes));
    CHECK(is_for_devices(Representation::Neural));
    for (const ChoiceInfo<Representation>& info : kRepresentations) {
        const std::string name(info.name);
        const Representation representation = info.value;
        const std::vector<std::string> given{"--method", "reinforcement", "--field", name};
        const Options options = parse(render_with(given));
        CHECK(options.render.field.representation == representation);
        CHECK(options.backend == (is_for_devices(representation) ? "auto" : "cpu"));
        std::vector<std::string> on_cuda = given;
        on_cuda.insert(on_cuda.end(), {"--backend", "cuda"});
        if (is_for_devices(representation))
            CHECK(parse(render_with(on_cuda)).backend == "cuda");
        else
            CHECK_THAT(error_message(ErrorKind::Unavailable, [&] { parse(render_with(on_cuda)); }),
                       contains("--field " + name + ": expected --backend cpu or auto, got cuda"));
    }
}

TEST_CASE("views of the field need a method with a field") {
    CHECK_THAT(complaint(render_with({"--view", "radiance-map"})), contains("precomputed or reinforcement"));
    CHECK_NOTHROW(parse(render_with({"--view", "radiance-map", "--method", "precomputed"})));
    CHECK_NOTHROW(parse(render_with({"--view", "voronoi"})));
}

TEST_CASE("only a learned field can be saved") {
    CHECK_THAT(
        complaint(render_with({"--save-field", "f"})),
        contains("--save-field: --method default learns nothing: expected --method precomputed or reinforcement"));
    CHECK_THAT(complaint(render_with({"--save-field", "f", "--method", "precomputed", "--view", "voronoi"})),
               contains("--save-field: nothing is learned for --view voronoi: expected --view beauty or one of the "
                        "learned field, such as radiance-map"));
    for (const char* view : {"beauty", "radiance-map", "visits"})
        CHECK(parse(render_with({"--save-field", "f", "--method", "reinforcement", "--view", view})).save_field ==
              "f");
    CHECK(parse({"inspect", "s", "--pixel", "1,2", "-o", "x.csv", "--save-field", "f"}).save_field == "f");
}

namespace {

Options parse_with_field(const std::vector<std::string>& arguments, const LearnedField& field,
                         const SceneDescription& scene = plain_scene()) {
    return resolve_options(parse_command_line(arguments), scene, &field);
}

std::vector<std::string> loading(const std::vector<std::string>& words) {
    std::vector<std::string> arguments = render_with({"--load-field", "my.field"});
    arguments.insert(arguments.end(), words.begin(), words.end());
    return arguments;
}

std::string complaint_with_field(const std::vector<std::string>& words, const LearnedField& field) {
    try {
        parse_with_field(loading(words), field);
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Usage);
        return error.what();
    }
    return "nothing";
}

}  // namespace

TEST_CASE("a loaded field brings its method and settings") {
    LearnedField field;
    field.method = MethodId::Precomputed;
    field.settings = {.volumes = 70, .bins = 64};
    SceneDescription scene = plain_scene();
    scene.settings = {{"method", "reinforcement"}, {"volumes", "5"}, {"bins", "16"}, {"seed", "9"}};
    const Options options = parse_with_field(loading({}), field, scene);
    CHECK(options.render.method == MethodId::Precomputed);
    CHECK((options.render.field == field.settings));
    CHECK(options.render.seed == 9);
    // Inspection takes the method from the field, too.
    CHECK(parse_with_field({"inspect", "s", "--pixel", "1,2", "-o", "x.csv", "--load-field", "f"}, field)
              .render.method == MethodId::Precomputed);
    // The command in the picture loads the field again, without options that contradict it.
    const std::string command = command_text(Command::Render, options, scene_defaults("s", scene));
    CHECK_THAT(command, contains("--load-field my.field") && contains("--bins 64") && contains("--volumes 70"));
}

TEST_CASE("options beside a loaded field have to agree with it") {
    LearnedField field;
    field.method = MethodId::Precomputed;
    field.settings.bins = 64;
    CHECK_NOTHROW(
        parse_with_field(loading({"--bins", "64", "--method", "precomputed", "--field-budget", "16"}), field));
    CHECK_NOTHROW(parse_with_field(loading({"--seed", "5", "--nee", "on", "--bsdf-fraction", "0.7"}), field));
    CHECK_NOTHROW(parse_with_field(loading({"--learn", "passes=9,probes=1"}), field));
    CHECK_NOTHROW(parse_with_field(loading({"-D", "opening=5", "--camera", R"({"shift_x": 1})"}), field));
    struct Wrong {
        std::vector<std::string> words;
        std::string message;
    };
    const std::vector<Wrong> wrongs{
        {{"--bins", "256"}, "--bins 256: the field in my.field was learned with --bins 64"},
        {{"--volumes", "9"}, "--volumes 9: the field in my.field was learned without --volumes"},
        {{"--field-budget", "1"}, "--field-budget 1: the field in my.field was learned with --field-budget 16"},
        {{"--learn", "passes=9", "--learn", "refine=0.5"},
         "--learn refine=0.5: the field in my.field was learned with --learn refine=auto"},
        {{"--method", "reinforcement"},
         "--method reinforcement: the field in my.field was learned with --method prec"},
        {{"--method", "default"}, "--method default: the field in my.field was learned with --method precomputed"},
    };
    for (const Wrong& wrong : wrongs) {
        CAPTURE(wrong.words);
        CHECK_THAT(complaint_with_field(wrong.words, field), contains(wrong.message));
    }
}

TEST_CASE("inspection is about a method that learns") {
    const std::vector<std::string> arguments{"inspect", "s", "--pixel", "1,2", "-o", "x.csv"};
    CHECK(parse(arguments).render.method == MethodId::Reinforcement);
    SceneDescription scene = plain_scene();
    scene.settings = {{"method", "default"}};
    CHECK(parse(arguments, scene).render.method == MethodId::Reinforcement);
    CHECK_THAT(complaint({"inspect", "s", "--pixel", "1,2", "-o", "x.csv", "--method", "default"}),
               contains("precomputed or reinforcement"));
}

TEST_CASE("inspection needs one place") {
    const auto inspect = [](std::vector<std::string> place) {
        place.insert(place.begin(), {"inspect", "s", "-o", "x.csv"});
        return place;
    };
    CHECK_THAT(complaint(inspect({})), contains("either --at"));
    CHECK_THAT(complaint(inspect({"--at", "1,2,3", "--pixel", "1,2"})), contains("either --at"));
    CHECK_THAT(complaint(inspect({"--at", "1,2,3,0,0,0"})), contains("normal"));
    CHECK_THAT(complaint(inspect({"--at", "1,2,3,4"})), contains("three or six numbers"));
    CHECK_THAT(complaint(inspect({"--pixel", "-1,0"})), contains("--pixel: expected"));
    CHECK_THAT(complaint(inspect({"--pixel", "1"})), contains("--pixel: expected"));
    const Options options = parse(inspect({"--at", "1,2,3,0,0,-2"}));
    CHECK((options.at->position == glm::vec3(1, 2, 3)));
    CHECK((*options.at->normal == glm::vec3(0, 0, -1)));
}

}  // namespace pl::test
