#include "tests/bench/gain_setup.h"

#include <cstdio>
#include <cstdlib>

#include "core/base/error.h"
#include "core/fields/field_choices.h"
#include "core/io/load_scene.h"

namespace pl::benchmarks {
namespace {

namespace fs = std::filesystem;

void add_every_scene(GainSetup& setup) {
    for (const std::string& name : list_scenes(PL_SOURCE_DIR "/assets")) setup.scenes.push_back(name);
    const fs::path larger = fs::path(setup.words.at("larger")) / "spaceship" / "spaceship.json";
    if (fs::exists(larger))
        setup.scenes.push_back(larger.lexically_normal().string());
    else
        std::printf("skipped: no %s\n", larger.c_str());
}

void set_key(GainSetup& setup, const std::string& key, const std::string& value) {
    if (const auto word = setup.words.find(key); word != setup.words.end()) {
        word->second = value;
        return;
    }
    const auto number = setup.numbers.find(key);
    if (number == setup.numbers.end()) throw Error(ErrorKind::Usage, "gain_bench: unknown key '" + key + "'");
    number->second = std::strtod(value.c_str(), nullptr);
}

}  // namespace

GainSetup parse_gain_setup(int count, char** words) {
    GainSetup setup;
    bool every = false;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const std::size_t equals = word.find('=');
        if (equals != std::string::npos)
            set_key(setup, word.substr(0, equals), word.substr(equals + 1));
        else if (word == "all")
            every = true;
        else
            setup.scenes.push_back(word);
    }
    if (every) add_every_scene(setup);
    if (setup.scenes.empty()) setup.scenes = {"cornell", "door"};
    return setup;
}

RunLength GainSetup::run_length() const {
    RunLength length{.seconds = numbers.at("seconds")};
    if (numbers.at("short") < numbers.at("spp"))
        length.samples.push_back(static_cast<std::uint32_t>(numbers.at("short")));
    length.samples.push_back(static_cast<std::uint32_t>(numbers.at("spp")));
    return length;
}

std::vector<bool> GainSetup::light_samples() const {
    const int nee = integer("nee");
    if (nee == 2) return {false, true};
    return {nee != 0};
}

std::vector<MethodId> GainSetup::methods() const {
    std::vector<MethodId> methods;
    for (const MethodInfo& method : all_methods())
        if (method.id != MethodId::Precomputed || numbers.at("precomputed") != 0.0) methods.push_back(method.id);
    return methods;
}

RenderSettings settings_of(const GainSetup& setup, const SceneDescription& scene) {
    RenderSettings settings;
    settings.width = setup.width();
    settings.height = setup.height();
    settings.camera = scene.camera;
    if (setup["fraction"] > 0.0)
        settings.mixture = {.learned = 0, .bsdf_fraction = static_cast<float>(setup["fraction"])};
    settings.field.volumes = setup.integer("volumes");
    settings.field.bins = setup.integer("bins");
    settings.field.budget_megabytes = setup["megabytes"];
    settings.field.uniform_floor = static_cast<float>(setup["floor"]);
    settings.field.refine_share = static_cast<float>(setup["refine"]);
    settings.field.rate = static_cast<LearningRate>(setup.integer("rate"));
    settings.field.learning = {.target = static_cast<LearningTarget>(setup.integer("target")),
                               .light = static_cast<LearnedLight>(setup.integer("light"))};
    settings.roulette = static_cast<RouletteRule>(setup.integer("roulette"));
    settings.guiding = static_cast<GuidingRule>(setup.integer("guiding"));
    settings.field.representation =
        kChoices<Representation>.at(static_cast<std::size_t>(setup.integer("field"))).value;
    if (setup["precompute"] > 0.0) settings.field.precompute_samples = setup.integer("precompute");
    return settings;
}

}  // namespace pl::benchmarks
