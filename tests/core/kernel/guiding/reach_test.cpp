// The learned reach of a volume: a weighted mean of distances, in any order of samples and for numbers that are not
// finite.
#include "core/kernel/guiding/reach.h"

#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"
#include "tests/support/field/guided_methods.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr float kExtent = 10.0f;

struct ReachField : TestField {
    ReachField() : TestField(4) {
        shape.extent = kExtent;
        tables = make_arrays<HostTables>(shape, 1);
        tables.mean_radiance[0] = 1.0f;
    }
    void add(float weight, float distance) { record_reach(view(), 0, weight, distance); }
    double reach() {
        move_reach(update_view(), 0);
        return 1.0 / static_cast<double>(tables.inverse_reach[0]);
    }
};

/// Mean distance of training samples and of the prior.
double expected_reach(double distance, double weight) {
    const double unknown = static_cast<double>(kUnknownWeight);
    const double mean =
        (weight * distance + unknown * static_cast<double>(kUnknownDistance * kExtent)) / (weight + unknown);
    return static_cast<double>(kReachPerDistance) * mean;
}

/// A path that scatters at the volume, hits a light at a distance, and ends there.
template <class M>
double reach_after_one_path(LearningSettings learning) {
    ReachField field;
    M method;
    method.field = field.view();
    if constexpr (requires { method.learning = learning; }) method.learning = learning;
    MethodCounters counters;
    DirectionSample direction;
    direction.pdf_sa = direction.bsdf_pdf_sa = 1.0f;
    direction.bin = 3;
    for (int path = 0; path < 100; ++path) {
        OwnMemory<M> memory;
        method.scattered(memory, {0}, {.direction = direction}, counters);
        method.record(method.observe(memory, {.emitted = Vec3f{1.0f}, .distance = 2.0f}, {kNoVolume}, counters));
        method.finished(memory, counters);
    }
    return field.reach();
}

}  // namespace

TEST_CASE("The reach follows the mean distance, by how much light came from there") {
    ReachField field;
    CHECK(field.reach() == Approx(expected_reach(0.0, 0.0)));
    field.add(100.0f, 2.0f);
    field.add(300.0f, 6.0f);
    CHECK(field.reach() == Approx(expected_reach(5.0, 400.0)).epsilon(1e-4));
    field.add(4000.0f, 1.0f);  // of all passes, not of the last
    CHECK(field.reach() == Approx(expected_reach((400.0 * 5.0 + 4000.0) / 4400.0, 4400.0)).epsilon(1e-4));
    CHECK(field.tables.pending_distance[0] == 0);
    CHECK(field.tables.pending_light[0] == 0);
}

TEST_CASE("Light from beyond the scene is as far as the scene is large") {
    ReachField field;
    field.add(1e6f, kInfinity);
    CHECK(field.reach() == Approx(expected_reach(static_cast<double>(kExtent), 1e6)).epsilon(1e-4));
}

TEST_CASE("The order of training samples does not move the reach by a bit") {
    Uniforms random(1);
    std::vector<Vec2f> records;
    for (int i = 0; i < 1000; ++i) records.push_back({random.between(0.0f, 100.0f), random.between(0.0f, 20.0f)});
    ReachField forward;
    ReachField backward;
    for (std::size_t i = 0; i < records.size(); ++i) {
        forward.add(records[i].x, records[i].y);
        backward.add(records[records.size() - 1 - i].x, records[records.size() - 1 - i].y);
    }
    CHECK(forward.reach() == backward.reach());
}

TEST_CASE("Bad and huge numbers leave a finite reach") {
    for (const float weight : {0.0f, -1.0f, kNan, kInfinity, 3e38f, 1e-38f})
        for (const float distance : {0.0f, -1.0f, kNan, kInfinity, 3e38f, 1e-38f}) {
            ReachField field;
            for (int i = 0; i < 10000; ++i) field.add(weight, distance);
            INFO("weight " << weight << ", distance " << distance);
            const double reach = field.reach();
            CHECK(reach >= static_cast<double>(kLeastReach * kExtent) * 0.999);
            CHECK(reach <= static_cast<double>(kReachPerDistance * kExtent) * 1.001);
        }
    for (const float extent : {0.0f, 1e-44f, kInfinity, kNan}) {
        const float inverse = inverse_reach_of(extent, kUnknownDistance);
        INFO("extent " << extent);
        CHECK(inverse == 0.0f);
    }
}

TEST_CASE("Every target updates the reach with the distance of its direction") {
    const double expected = expected_reach(2.0, 100.0);
    CHECK(reach_after_one_path<ReinforcementMethod>({}) == Approx(expected).epsilon(1e-4));
    CHECK(reach_after_one_path<SarsaMethod>({LearningTarget::Sarsa, LearnedLight::All}) ==
          Approx(expected).epsilon(1e-4));
    CHECK(reach_after_one_path<MonteCarloMethod>({LearningTarget::MonteCarlo, LearnedLight::All}) ==
          Approx(expected).epsilon(1e-4));
}
