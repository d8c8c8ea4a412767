// Targets of reinforcement learning, one call at a time: their training samples for a path of known radiance.
#include "core/kernel/methods/learning_target.h"

#include <type_traits>

#include "core/fields/field_kernels.h"
#include "core/kernel/guiding/update_volume.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"
#include "tests/support/field/guided_methods.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kTableSide = 2;
constexpr TableLocation kVertex{0};

/// Two volumes of four cells with learned values.
struct Learner {
    TestField field{kTableSide, {Vec3f{0, 0, 1}, Vec3f{0, 0, 1}}};
    MethodCounters counters;

    Learner() {
        field.tables.mean_radiance = {0.5f, 2.0f};
        for (std::size_t i = 0; i < 4; ++i) {
            field.tables.radiance[i] = 1.0f + static_cast<float>(i);
            field.tables.visits[i] = i == 3 ? 0 : 1;
        }
    }
    template <class M>
    M method(LearningTarget target, LearnedLight light) {
        M method;
        method.field = field.view();
        method.mixture.learned = 0;
        method.learning = {target, light};
        return method;
    }
    float recorded(std::size_t cell) const {
        return from_fixed_point(field.tables.pending_sum[cell], 1, field.shape.radiance_unit);
    }
    std::uint32_t count(std::size_t cell) const { return field.tables.pending_count[cell]; }
};

DirectionSample towards(std::int32_t cell) {
    DirectionSample direction;
    direction.pdf_sa = direction.bsdf_pdf_sa = 1.0f;
    direction.bin = cell;
    return direction;
}
ScatterEvent going(float weight, std::int32_t cell) { return {Vec3f{weight}, Vec3f{0.5f}, towards(cell)}; }
Observation meeting(float emitted, float share = 1.0f, float albedo = 0.5f) {
    return {.emitted = Vec3f{emitted}, .albedo = Vec3f{albedo}, .direction_share = share};
}

}  // namespace

TEST_CASE("Each target is served by its integrator, passes that train nothing by one whose field stays constant") {
    const auto serving = []<class F>(std::type_identity<F>, MethodId method, LearningTarget target, bool trains) {
        int served = -1;
        with_method_kernel<F, HostMethodList>(method, {.target = target}, trains,
                                              [&]<int kEntry>() { served = kEntry; });
        return served;
    };
    constexpr std::type_identity<TableField> kTable;
    constexpr std::type_identity<SdTreeField> kTree;
    constexpr auto kReinforcement = MethodId::Reinforcement;
    using enum LearningTarget;
    constexpr int kDefault = 0, kFrozen = 1, kExpectedSarsa = 2, kSarsa = 3, kMonteCarlo = 4, kOfTree = 6;
    CHECK(serving(kTable, kReinforcement, ExpectedSarsa, true) == kExpectedSarsa);
    CHECK(serving(kTable, kReinforcement, Sarsa, true) == kSarsa);
    CHECK(serving(kTable, kReinforcement, MonteCarlo, true) == kMonteCarlo);
    for (const LearningTarget target : {ExpectedSarsa, Sarsa, MonteCarlo}) {
        CHECK(serving(kTable, kReinforcement, target, false) == kFrozen);
        for (const bool trains : {false, true}) {
            CHECK(serving(kTable, MethodId::Precomputed, target, trains) == kFrozen);
            CHECK(serving(kTable, MethodId::Default, target, trains) == kDefault);
        }
    }
    // Other representations have one kernel for passes that train and for those that do not, and one target.
    for (const bool trains : {false, true}) {
        CHECK(serving(kTree, kReinforcement, ExpectedSarsa, trains) == kOfTree);
        CHECK(serving(kTree, kReinforcement, Sarsa, trains) == -1);
    }
}

TEST_CASE("Sarsa takes the learned radiance of the sampled direction") {
    Learner learner;
    const auto method = learner.method<SarsaMethod>(LearningTarget::Sarsa, LearnedLight::All);
    SarsaMethod::Memory memory;
    method.scattered(memory, kVertex, going(1.0f, 1), learner.counters);  // from the first vertex: nothing to record
    CHECK(learner.counters.records == 0);
    method.observe(memory, meeting(3.0f, 0.25f), kVertex, learner.counters);
    CHECK(learner.counters.records == 0);  // not before the next direction is known
    method.light_sampled(memory, kVertex, {.reflected = Vec3f{7.0f}});
    method.scattered(memory, kVertex, going(0.5f, 2), learner.counters);
    method.light_received(memory, learner.counters);  // all light: it is in the table
    CHECK(learner.recorded(1) == Approx(3.0f + 0.5f * 3.0f));
    method.observe(memory, meeting(0.0f), {1}, learner.counters);
    method.terminated(memory, learner.counters);
    CHECK(learner.recorded(2) == 0.0f);
    CHECK(learner.count(2) == 1);
    CHECK(learner.counters.records == 2);
}

TEST_CASE("Training samples that are too bright for the sums are counted by every target") {
    Learner late;
    const auto sarsa = late.method<SarsaMethod>(LearningTarget::Sarsa, LearnedLight::All);
    const float most = kMaxRecordedUnits * sarsa.field.radiance_unit;
    Learner whole;
    const auto monte_carlo = whole.method<MonteCarloMethod>(LearningTarget::MonteCarlo, LearnedLight::All);
    const auto walk = [&](const auto& method, auto&& memory, Learner& learner) {
        for (const float emitted : {most, 1.01f * most}) {
            method.scattered(memory, kVertex, going(1.0f, 1), learner.counters);
            method.observe(memory, meeting(emitted, 1.0f, 0.0f), {kNoVolume}, learner.counters);
            method.terminated(memory, learner.counters);
            method.finished(memory, learner.counters);
        }
        CHECK(learner.counters.records == 2);
        CHECK(learner.counters.clamped_records == 1);
    };
    walk(sarsa, SarsaMethod::Memory{}, late);
    walk(monte_carlo, OwnMemory<MonteCarloMethod>{}, whole);
}

TEST_CASE("Sarsa takes the volume's mean for a cell without visits, and has no sample without a volume") {
    Learner learner;
    const auto method = learner.method<SarsaMethod>(LearningTarget::Sarsa, LearnedLight::All);
    for (const std::int32_t unknown : {3, -1}) {  // never visited, below the volume's horizon
        SarsaMethod::Memory memory{.scattered = method.open_sample(kVertex, towards(0)), .lit = {}};
        method.observe(memory, meeting(1.0f), kVertex, learner.counters);
        method.scattered(memory, kVertex, going(2.0f, unknown), learner.counters);
    }
    CHECK(learner.recorded(0) == Approx(2.0f * (1.0f + 2.0f * 0.5f)));
    SarsaMethod::Memory memory{.scattered = method.open_sample(kVertex, towards(1)), .lit = {}};
    method.observe(memory, meeting(1.0f), {kNoVolume}, learner.counters);
    method.scattered(memory, {kNoVolume}, going(1.0f, -1), learner.counters);
    CHECK(learner.count(1) == 0);
    memory = {.scattered = method.open_sample(kVertex, towards(2)), .lit = {}};
    method.observe(memory, meeting(4.0f, 1.0f, 0.0f), {}, learner.counters);  // a lamp that reflects nothing
    CHECK(learner.recorded(2) == Approx(4.0f));
}

TEST_CASE("Sarsa of indirect light: emission by its share, and the reflected light sample of the next vertex") {
    Learner learner;
    const auto method = learner.method<SarsaMethod>(LearningTarget::Sarsa, LearnedLight::Indirect);
    SarsaMethod::Memory memory{.scattered = method.open_sample(kVertex, towards(0)), .lit = {}};
    method.observe(memory, meeting(4.0f, 0.25f), {1}, learner.counters);
    method.light_sampled(memory, kVertex, {.reflected = Vec3f{7.0f}});
    method.scattered(memory, {1}, going(0.5f, 0), learner.counters);
    method.light_received(memory, learner.counters);
    // Volume 1 has a mean of 2 and no visits.
    CHECK(learner.recorded(0) == Approx(1.0f + 0.5f * 2.0f + 7.0f));
    CHECK(learner.count(0) == 1);
    // A blocked light sample adds nothing, neither now nor at a later vertex.
    method.observe(memory, meeting(0.0f), {1}, learner.counters);
    method.light_sampled(memory, kVertex, {.reflected = Vec3f{7.0f}});
    method.terminated(memory, learner.counters);
    const float before = learner.recorded(4);
    method.observe(memory, meeting(0.0f), {1}, learner.counters);
    method.light_received(memory, learner.counters);
    CHECK(learner.recorded(4) == before);
}

TEST_CASE("Expected Sarsa of indirect light: emission by its share, and the light of learned light samples") {
    for (const LearnedLight light : {LearnedLight::All, LearnedLight::Indirect}) {
        Learner learner;
        learner.field.tables.direct = {3.0f, 8.0f};
        const auto method = learner.method<ReinforcementMethod>(LearningTarget::ExpectedSarsa, light);
        ReinforcementMethod::Memory memory = method.open_sample(kVertex, towards(0));
        method.record(method.observe(memory, meeting(4.0f, 0.25f), {1}, learner.counters));
        const bool all = light == LearnedLight::All;
        CHECK(learner.recorded(0) == Approx((all ? 4.0f : 1.0f) + 0.5f * (2.0f + (all ? 0.0f : 8.0f))));
        // Light samples of a vertex train its volume; blocked ones count as 0, those without a volume not at all.
        const auto lit = method.light_sampled(memory, {1}, {.irradiance = 6.0f});
        method.record_light(lit, true);
        method.record_light(lit, false);
        method.record_light(method.light_sampled(memory, {}, {.irradiance = 6.0f}), true);
        const HostTables& tables = learner.field.tables;
        CHECK(tables.pending_direct_count[1] == (all ? 0u : 2u));
        CHECK(tables.pending_direct_count[0] == 0u);
        absorb_light_samples(learner.field.update_view(), 1);
        CHECK(tables.direct[1] == Approx(all ? 8.0f : 3.0f));
        CHECK(tables.direct_count[1] == (all ? 0u : 2u));
    }
}

TEST_CASE("Monte-Carlo targets are the radiance of the path") {
    for (const LearnedLight light : {LearnedLight::All, LearnedLight::Indirect}) {
        Learner learner;
        const auto method = learner.method<MonteCarloMethod>(LearningTarget::MonteCarlo, light);
        OwnMemory<MonteCarloMethod> memory;
        method.observe(memory, meeting(9.0f), kVertex, learner.counters);  // the camera learns nothing
        method.light_sampled(memory, kVertex, {.reflected = Vec3f{9.0f}});
        method.scattered(memory, kVertex, going(1.0f, 0), learner.counters);
        method.light_received(memory, learner.counters);
        method.observe(memory, meeting(4.0f, 0.25f), kVertex, learner.counters);
        method.light_sampled(memory, kVertex, {.reflected = Vec3f{2.0f}});
        method.scattered(memory, kVertex, going(0.5f, 1), learner.counters);
        method.light_received(memory, learner.counters);
        method.observe(memory, meeting(0.0f), {kNoVolume}, learner.counters);
        method.light_sampled(memory, kVertex, {.reflected = Vec3f{100.0f}});  // blocked
        method.scattered(memory, {kNoVolume}, going(0.25f, -1), learner.counters);
        method.observe(memory, meeting(8.0f, 0.5f, 0.0f), {}, learner.counters);
        CHECK(learner.counters.records == 0);
        method.finished(memory, learner.counters);
        CHECK(learner.counters.records == 2);
        const float third = 0.5f * 8.0f;
        const float second = 0.25f * third;
        const float first = 0.25f * 4.0f + 2.0f + 0.5f * second;
        const bool all = light == LearnedLight::All;
        CHECK(learner.recorded(0) == Approx(first + (all ? 3.0f : 0.0f)));
        CHECK(learner.recorded(1) == Approx(second));
        CHECK(learner.counters.cut_returns == 0);
        method.finished(memory, learner.counters);  // nothing is left
        CHECK(learner.counters.records == 2);
    }
}

TEST_CASE("Monte Carlo cuts paths that are too long, takes the table for the rest, and counts them") {
    for (const LearnedLight light : {LearnedLight::All, LearnedLight::Indirect}) {
        Learner learner;
        const auto method = learner.method<MonteCarloMethod>(LearningTarget::MonteCarlo, light);
        OwnMemory<MonteCarloMethod> memory;
        for (int i = 0; i < 3 * MonteCarloMethod::kMostSteps; ++i) {
            method.observe(memory, meeting(0.0f), kVertex, learner.counters);
            method.light_sampled(memory, kVertex,
                                 {.reflected = Vec3f{i == MonteCarloMethod::kMostSteps ? 3.0f : 0.0f}});
            method.scattered(memory, kVertex, going(1.0f, i == MonteCarloMethod::kMostSteps - 1 ? 1 : 0),
                             learner.counters);
            method.light_received(memory, learner.counters);
        }
        method.finished(memory, learner.counters);
        CHECK(learner.counters.cut_returns == 1);
        CHECK(learner.counters.records == MonteCarloMethod::kMostSteps);
        // rho V of the vertex where it was cut, and its light sample unless V holds it.
        CHECK(learner.recorded(1) == Approx(0.5f * 0.5f + (light == LearnedLight::Indirect ? 3.0f : 0.0f)));
    }
}
