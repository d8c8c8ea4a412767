// compare_backends [OPTIONS]: CPU and CUDA in one process, to the bit. One record per case (see record.h): films with both halves,
// learned tables and counters are equal, or which share of the values differs, and by how much at most. Every shipped scene by
// every method and learning target, with and without light samples; or with --random, random settings until the time is over.
// Exit code 0 if all cases are equal, 1 if any differs, else as pathlight.
#include <algorithm>

#include <CLI/CLI.hpp>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/io/load_scene.h"
#include "core/session/methods.h"
#include "tests/parity/random_case.h"
#include "tests/parity/record.h"

using namespace pl;
using namespace pl::parity;

namespace {

struct Options {
    std::vector<std::string> scenes;
    int side = 128;
    std::uint32_t passes = 16;
    int volumes = 200;
    double seconds = 0.0;  ///< 0: no limit
    std::uint64_t seed = 1;
    std::uint32_t first = 0;
    bool random = false;
    bool spoil = false;
};

/// Prints the cases and counts those that differ.
class Comparison {
public:
    explicit Comparison(const Options& options) : options_(options) {}

    void add(const std::string& kind, const std::string& name, const BackendCase& compared) {
        const CaseResult result = compare_backends(compared, options_.spoil && cases_ == 0);
        print_result(kind, name, compared, result);
        ++cases_;
        differing_ += result.is_equal() ? 0 : 1;
    }
    bool is_over() const { return options_.seconds > 0.0 && watch_.seconds() >= options_.seconds; }
    void print_summary(const std::string& kind) const {
        Record(kind).field("cases", cases_).field("differing", differing_);
    }
    int differing() const { return differing_; }

private:
    const Options& options_;
    Stopwatch watch_;
    int cases_ = 0;
    int differing_ = 0;
};

struct Learner {
    MethodId method;
    LearningTarget target;
    const char* name;
    Representation representation = Representation::Table;
};

/// All methods, and those that learn with every target, and by networks.
std::vector<Learner> all_learners() {
    std::vector<Learner> learners;
    for (const MethodInfo& method : all_methods()) {
        learners.push_back({method.id, LearningTarget::ExpectedSarsa, method.name.data()});
        if (method.id != learning_method()) continue;
        learners.push_back({method.id, LearningTarget::Sarsa, "sarsa"});
        learners.push_back({method.id, LearningTarget::MonteCarlo, "monte-carlo"});
        learners.push_back({method.id, LearningTarget::ExpectedSarsa, "neural", Representation::Neural});
    }
    return learners;
}

void compare_all(Comparison& comparison, SceneShelf& scenes, const Options& options) {
    for (std::size_t i = 0; i < scenes.names().size(); ++i)
        for (const Learner& learner : all_learners())
            for (const bool next_event : {false, true}) {
                BackendCase compared{.scene = scenes[i], .settings = {}, .passes = options.passes};
                compared.settings.method = learner.method;
                compared.settings.next_event = next_event;
                compared.settings.width = compared.settings.height = options.side;
                compared.settings.camera = scenes[i]->camera;
                compared.settings.guiding = GuidingRule::Always;
                compared.settings.field.volumes = options.volumes;
                compared.settings.field.bins = 64;
                compared.settings.field.learning.target = learner.target;
                compared.settings.field.representation = learner.representation;
                comparison.add("compare", scenes.names()[i] + " " + learner.name + (next_event ? " nee" : ""),
                               compared);
            }
    comparison.print_summary("compared");
}

void compare_random(Comparison& comparison, SceneShelf& scenes, const Options& options) {
    for (std::uint32_t number = options.first; !comparison.is_over(); ++number)
        comparison.add("random", fmt::format("{}:{}", options.seed, number),
                       random_case(scenes, options.seed, number));
    comparison.print_summary("randoms");
}

int run(const Options& options) {
    SceneShelf scenes(options.scenes.empty() ? list_scenes(find_assets_dir()) : options.scenes);
    Comparison comparison(options);
    if (options.random)
        compare_random(comparison, scenes, options);
    else
        compare_all(comparison, scenes, options);
    return comparison.differing() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"CPU and CUDA compared to the bit, all cases in one process"};
    app.add_option("--scenes", options.scenes, "names of shipped scenes; default: all")->delimiter(',');
    app.add_option("--side", options.side, "pixels of the square pictures' sides")->check(CLI::Range(1, 4096));
    app.add_option("--passes", options.passes, "samples per pixel")->check(CLI::Range(1, 4096));
    app.add_option("--volumes", options.volumes, "radiance volumes")->check(CLI::Range(1, 100000));
    app.add_flag("--random", options.random, "random settings instead, for --seconds");
    app.add_option("--seconds", options.seconds, "time limit of --random")->check(CLI::PositiveNumber);
    app.add_option("--seed", options.seed, "of the random settings");
    app.add_option("--first", options.first, "number of the first random case, to repeat one");
    app.add_flag("--spoil", options.spoil, "raise a float of the first picture, to test that this is noticed");
    CLI11_PARSE(app, argc, argv);
    if (options.random && options.seconds <= 0.0) {
        std::fprintf(stderr, "compare_backends: --random needs --seconds, got none\n");
        return static_cast<int>(ErrorKind::Usage);
    }
    try {
        return run(options);
    } catch (const Error& error) {
        std::fprintf(stderr, "compare_backends: %s\n", error.what());
        return static_cast<int>(error.kind());
    }
}
