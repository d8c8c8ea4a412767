// The training samples of a path are complete: its radiance follows from them alone.
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"
#include "tests/support/field/guided_methods.h"
#include "tests/support/scenes/shipped_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Notes the first vertex, which has no training sample, and leaves the others to the method under test.
struct ReplayedMethod : MonteCarloMethod {
    struct Memory : MonteCarloMethod::Memory {
        bool has_met = false;
        bool has_left = false;
        bool first_light_waits = false;
        Vec3f brought{0.0f};  ///< emission of the first surface, and the part of its light sample that it reflects
        Vec3f first_light{0.0f};
        Vec3f weight{0.0f};  ///< of the direction scattered at the first vertex
    };

    Sample observe(Memory& memory, const Observation& observation, const Vertex& vertex,
                   MethodCounters& counters) const {
        if (!memory.has_met) memory.brought = observation.emitted;
        memory.has_met = true;
        memory.first_light_waits = false;
        return MonteCarloMethod::observe(memory, observation, vertex, counters);
    }
    Light light_sampled(Memory& memory, const Vertex& vertex, const LightEstimate& estimate) const {
        memory.first_light_waits = !memory.has_left;
        memory.first_light = estimate.reflected;
        return MonteCarloMethod::light_sampled(memory, vertex, estimate);
    }
    void light_received(Memory& memory, MethodCounters& counters) const {
        if (memory.first_light_waits) memory.brought += memory.first_light;
        MonteCarloMethod::light_received(memory, counters);
    }
    void scattered(Memory& memory, const Vertex& vertex, const ScatterEvent& event, MethodCounters& counters) const {
        if (!memory.has_left) memory.weight = event.weight;
        memory.has_left = true;
        MonteCarloMethod::scattered(memory, vertex, event, counters);
    }
    /// The steps are needed until the path has been judged.
    void finished(Memory&, MethodCounters&) const {}

    Vec3f replay(const Memory& memory) const {
        Vec3f brought{0.0f};
        for (std::int32_t i = memory.count - 1; i >= 0; --i)
            brought = memory.steps[i].brought + memory.steps[i].weight * brought;
        return memory.brought + memory.weight * brought;
    }
};
static_assert(Method<ReplayedMethod>);

/// Paths of a scene whose training samples give another radiance than the path; those cut for learning are left out.
template <FeatureSet F>
void check_replay(const std::string& name, bool next_event) {
    constexpr std::uint32_t kReplaySide = 32;
    constexpr std::uint32_t kReplaySamples = 4;
    const SceneDescription description = shipped_scene(name);
    const HostScene scene = pack_scene(description);
    const SceneView view = scene.view();
    FieldSettings settings;
    settings.volumes = 100;
    settings.bins = 64;
    const FieldShape shape = make_field_shape(scene, settings);
    HostVolumes volumes = place_volumes(scene, settings);
    HostTables tables = make_arrays<HostTables>(shape, volumes.sites.size());
    ReplayedMethod method;
    method.field = field_view(shape, volumes, tables);
    method.learning = {LearningTarget::MonteCarlo, LearnedLight::Indirect};
    const Camera camera = make_camera(description.camera, kReplaySide, kReplaySide);
    const PathSettings path{.seed = 1, .next_event = next_event ? 1u : 0u};

    double brightest = 0.0;
    int lit = 0;
    for (std::uint32_t i = 0; i < kReplaySide * kReplaySide * kReplaySamples; ++i) {
        auto state = begin_path<F, ReplayedMethod>(camera, path, {kReplaySide, kReplaySide, i % kReplaySamples},
                                                   i / kReplaySamples);
        ReplayedMethod::Store store;
        PathCounters counters;
        trace_path<F>(PathContext<ReplayedMethod>{view, method, path}, BvhIntersector{view}, state, store, counters);
        if (counters.method.cut_returns > 0) continue;
        const Vec3f replayed = method.replay(state.memory);
        lit += is_black(state.radiance) ? 0 : 1;
        brightest = std::max(brightest, static_cast<double>(max_component(state.radiance)));
        INFO(name << ", path " << i << ": " << state.radiance.x << " and " << replayed.x);
        // The same products and sums in another order: 16 vertices, some roundings each.
        REQUIRE(glm::length(replayed - state.radiance) <= 1e-5f * glm::length(state.radiance));
    }
    CHECK(lit > (next_event ? 1000 : 10));
    CHECK(brightest > 0.0);
}

}  // namespace

TEST_CASE("Training samples of whole paths give back the radiance of the paths") {
    for (const char* name : {"cornell", "open-box", "two-lights", "sky", "spheres"}) {
        check_replay<kCompiledSets[kCompiledSetCount - 1]>(name, false);
        check_replay<kCompiledSets[kCompiledSetCount - 1]>(name, true);
    }
    // Light samples at surfaces without tables are in the picture, but the vertex before learns from directions alone.
    for (const char* name : {"coats", "plates"}) check_replay<kCompiledSets[kCompiledSetCount - 1]>(name, false);
}
