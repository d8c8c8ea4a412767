// The table of effects: which are needed and why, and measured costs.
#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/ui/fake_backend.h"
#include "ui/model/effects_model.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A frame of a scene whose floor is a mirror.
std::shared_ptr<PublishedFrame> frame_of_mirror() {
    auto scene = std::make_shared<SceneDescription>(*small_scene());
    scene->materials[0].kind = SurfaceKind::Conductor;
    auto frame = std::make_shared<PublishedFrame>();
    frame->description = scene;
    frame->scene = std::make_shared<const HostScene>(pack_scene(*scene));
    frame->backend.name = "cpu";
    frame->settings.next_event = false;
    return frame;
}

EffectTrialCost cost_of(const EffectsModel& model, FeatureSet forced, std::size_t pairs) {
    EffectTrialCost cost{
        .forced = forced, .base_kernel = model.kernel(), .kernel = model.kernel_with(forced), .result = {}};
    cost.result.pairs = pairs;
    return cost;
}

}  // namespace

TEST_CASE("Effects: what is needed has a reason, and the rest a kernel that would serve it") {
    const auto frame = frame_of_mirror();
    EffectsModel model;
    CHECK(model.rows().empty());
    model.update(*frame, std::nullopt);
    REQUIRE(model.rows().size() == std::size(kAllFeatures));
    for (const EffectRow& row : model.rows()) {
        INFO(row.name);
        CHECK(row.needed() == (row.feature == Feature::Specular));
        CHECK(row.kernel == model.kernel_with(row.with()));
        CHECK((row.kernel == model.kernel()) == (kPlainFeatures.with(kLobeFeatures).has(row.feature)));
    }
    const auto specular = std::ranges::find(model.rows(), "specular", &EffectRow::name);
    REQUIRE(specular != model.rows().end());
    CHECK(specular->reason == "of 1 material: floor");
}

TEST_CASE("Effects: a cost is that of a kernel, and is forgotten where it was not measured") {
    const auto frame = frame_of_mirror();
    EffectsModel model;
    model.update(*frame, std::nullopt);
    model.update(*frame, cost_of(model, kEveryFeature, 7));
    REQUIRE(model.cost_of(kEveryFeature) != nullptr);
    CHECK(model.cost_of(features(Feature::Instances)) == model.cost_of(kEveryFeature));
    CHECK(model.cost_of(features(Feature::Textures)) == nullptr);
    CHECK(model.cost_of({}) == nullptr);
    model.update(*frame, cost_of(model, kEveryFeature, 9));
    CHECK(model.cost_of(kEveryFeature)->result.pairs == 9);
    frame->settings.width = 99;
    model.update(*frame, std::nullopt);
    CHECK(model.cost_of(kEveryFeature) == nullptr);
    EffectTrialCost foreign = cost_of(model, kEveryFeature, 3);
    foreign.base_kernel = "cpu/default/other";
    model.update(*frame, foreign);
    CHECK(model.cost_of(kEveryFeature) == nullptr);
}
