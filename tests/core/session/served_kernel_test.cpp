// The named kernel is the one that runs: the compiled sets of each row, of methods, targets and views.
#include "core/session/served_kernel.h"

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

const FeatureSet kLarge = kCompiledSets[kCompiledSetCount - 1];

ServedKernel served(const RenderSettings& settings, const HostScene& scene = {}) {
    return served_kernel("cpu", needed_features(scene, settings), settings);
}

}  // namespace

TEST_CASE("Kernels are named after method or view and effects") {
    CHECK(served({}).name == "cpu/default/next-event-estimation");
    CHECK(served({.next_event = false}).name == "cpu/default/base");
    CHECK(served({.method = MethodId::Reinforcement, .next_event = true}).name ==
          "cpu/reinforcement/next-event-estimation");
    CHECK(served({.method = MethodId::Precomputed, .forced_effects = features(Feature::SmoothNormals)}).name ==
          "cpu/precomputed/smooth-normals+environment+next-event-estimation");
    CHECK(served({.view = View::Depth}).name == "cpu/depth/smooth-normals+environment+next-event-estimation");
}

TEST_CASE("Kernels that exist for fewer sets are named after the one that runs") {
    RenderSettings settings{.method = MethodId::Reinforcement, .next_event = true};
    CHECK(served(settings).compiled == kCompiledSets[1]);
    settings.field.learning.target = LearningTarget::Sarsa;
    CHECK(served(settings).compiled == kCompiledSets[2]);
    settings.field.learning.target = LearningTarget::MonteCarlo;
    settings.forced_effects = features(Feature::Rough);
    CHECK(served(settings).compiled == kLarge);
    settings = {.view = View::Direct, .forced_effects = features(Feature::Rough)};
    CHECK(served(settings).compiled == kLarge);
    settings = {.method = MethodId::Reinforcement, .next_event = true};
    settings.field.representation = Representation::SdTree;
    CHECK(served(settings).compiled == kPlainFeatures);
    settings = {.method = MethodId::Default, .forced_effects = features(Feature::Rough)};
    CHECK(served(settings).compiled == kPlainFeatures.with(kLobeFeatures));
    settings.forced_effects = features(Feature::Textures, Feature::ManyLights);
    CHECK_FALSE(served(settings).compiled.has_any(kLobeFeatures));
    settings.forced_effects = features(Feature::Textures, Feature::Rough);
    CHECK(served(settings).compiled == kCompiledSets[kCompiledSetCount - 2]);
}

TEST_CASE("Needed and forced effects are both served") {
    HostScene scene;
    scene.environment = Vec3f{1.0f};
    const ServedKernel kernel = served({.forced_effects = features(Feature::NextEventEstimation)}, scene);
    CHECK(kernel.served == features(Feature::Environment, Feature::NextEventEstimation));
    CHECK(kernel.compiled.covers(kernel.served));
    CHECK(needed_features(scene, {.next_event = false}) == features(Feature::Environment));
}
