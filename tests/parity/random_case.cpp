#include "tests/parity/random_case.h"

#include "core/fields/field_kernels.h"
#include "core/io/load_scene.h"
#include "core/kernel/base/rng.h"
#include "core/session/methods.h"

namespace pl::parity {
namespace {

/// Successive draws of one case.
class Draws {
public:
    Draws(std::uint64_t seed, std::uint32_t number) : rng_{.seed = seed, .pixel = number} {}

    std::uint32_t below(std::uint32_t count) {
        return std::min(static_cast<std::uint32_t>(uniform() * static_cast<float>(count)), count - 1);
    }
    int between(int least, int most) {
        return least + static_cast<int>(below(static_cast<std::uint32_t>(most - least + 1)));
    }
    bool chance(float probability) { return uniform() < probability; }
    float uniform() { return rng_.draw(drawn_++, Purpose::Scatter).x; }
    template <class T>
    T one_of(std::initializer_list<T> values) {
        return values.begin()[below(static_cast<std::uint32_t>(values.size()))];
    }

private:
    Rng rng_;
    std::uint32_t drawn_ = 0;
};

FieldSettings random_field(Draws& draws) {
    FieldSettings field;
    field.volumes = draws.between(1, 300);
    field.bins = draws.one_of({4, 16, 64, 256, 1024});
    field.rate = draws.one_of({LearningRate::SampleMean, LearningRate::Forgetful});
    field.learning.target =
        draws.one_of({LearningTarget::ExpectedSarsa, LearningTarget::Sarsa, LearningTarget::MonteCarlo});
    field.learning.light = draws.one_of({LearnedLight::All, LearnedLight::Indirect});
    field.representation = draws.one_of({Representation::Table, Representation::Table, Representation::Neural});
    if (!has_target(field.representation, field.learning.target))
        field.learning.target = LearningTarget::ExpectedSarsa;
    field.precompute_samples = draws.one_of({1, 4, 9});
    field.refine_share = draws.one_of({kRefineByRecords, 0.0f, 0.5f, 1.0f});
    return field;
}

}  // namespace

SceneShelf::SceneShelf(std::vector<std::string> names) : names_(std::move(names)), scenes_(names_.size()) {}

const std::shared_ptr<const SceneDescription>& SceneShelf::operator[](std::size_t index) {
    std::shared_ptr<const SceneDescription>& scene = scenes_.at(index);
    if (!scene) scene = std::make_shared<const SceneDescription>(load_scene(names_[index], find_assets_dir()));
    return scene;
}

BackendCase random_case(SceneShelf& scenes, std::uint64_t seed, std::uint32_t number) {
    Draws draws(seed, number);
    BackendCase drawn{.scene = scenes[draws.below(static_cast<std::uint32_t>(scenes.names().size()))],
                      .settings = {},
                      .passes = static_cast<std::uint32_t>(draws.between(1, 12))};
    RenderSettings& settings = drawn.settings;
    const auto methods = all_methods();
    const auto views = all_views();
    settings.method = methods[draws.below(static_cast<std::uint32_t>(methods.size()))].id;
    if (draws.chance(0.2f)) settings.view = views[draws.below(static_cast<std::uint32_t>(views.size()))].id;
    settings.width = draws.between(1, 96);
    settings.height = draws.between(1, 96);
    settings.camera = drawn.scene->camera;
    settings.seed = draws.below(1u << 20);
    settings.max_depth = draws.one_of({1, 2, 3, 8, 64, 64});
    settings.next_event = draws.chance(0.5f);
    settings.roulette = draws.one_of({RouletteRule::Spare, RouletteRule::Albedo});
    settings.guiding = draws.one_of({GuidingRule::Paying, GuidingRule::Always});
    settings.mixture.learned = draws.below(2);
    settings.mixture.bsdf_fraction = 0.1f + 0.9f * draws.uniform();
    settings.field = random_field(draws);
    if (draws.chance(0.25f)) settings.forced_effects.bits = draws.below(kEveryFeature.bits + 1);
    return drawn;
}

}  // namespace pl::parity
