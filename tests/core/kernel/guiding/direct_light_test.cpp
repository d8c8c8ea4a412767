// The learned choice of lights: cumulative probabilities in proportion to the irradiance by the clusters' light samples.
#include "core/kernel/guiding/direct_light.h"

#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"

using namespace pl;
using namespace pl::test;

namespace {

/// One volume of a scene whose light tree has four clusters.
struct LightField : TestField {
    LightField() : TestField(4) {
        shape.light_clusters = 4;
        tables = make_arrays<HostTables>(shape, 1);
    }
    void sample(std::uint32_t cluster, float irradiance, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i)
            view().record_light({.location = {.volume = 0}, .irradiance = irradiance, .cluster = cluster});
    }
    void absorb() { absorb_light_samples(update_view(), 0); }
    LearnedLights learned() { return view().lights_at({.volume = 0}); }
};

}  // namespace

TEST_CASE("Lights are chosen in proportion to the irradiance by their cluster, occluded samples included") {
    LightField field;
    field.sample(0, 6.0f, 10);
    field.sample(1, 0.0f, 60);  // occluded
    field.sample(3, 2.0f, 10);
    CHECK(field.learned().empty());
    field.absorb();
    const LearnedLights learned = field.learned();
    REQUIRE_FALSE(learned.empty());
    CHECK(learned.probability(0) == Approx(0.75f));
    CHECK(learned.probability(1) == 0.0f);
    CHECK(learned.probability(2) == 0.0f);
    CHECK(learned.probability(3) == Approx(0.25f));
    CHECK(learned.cdf[3] == 1.0f);
    CHECK(field.tables.cluster_light[0] == Approx(60.0f / 80.0f));
    CHECK(field.tables.direct[0] == Approx(80.0f / 80.0f));
    for (const std::int64_t pending : field.tables.pending_cluster) CHECK(pending == 0);
}

TEST_CASE("Nothing is learned of lights before enough light samples, and from darkness") {
    LightField field;
    field.sample(2, 1.0f, kFewestLightSamples - 1);
    field.absorb();
    CHECK(field.learned().empty());
    field.sample(2, 1.0f, 1);
    field.absorb();
    CHECK_FALSE(field.learned().empty());

    LightField dark;
    dark.sample(0, 0.0f, 1000);
    dark.absorb();
    CHECK(dark.learned().empty());
}

TEST_CASE("Light samples of far lights have no cluster, and scenes with few lights have none") {
    LightField field;
    field.sample(kNoCluster, 1.0f, 100);
    field.absorb();
    CHECK(field.tables.direct[0] == Approx(1.0f));
    CHECK(field.learned().empty());

    TestField few(4);
    few.view().record_light({.location = {.volume = 0}, .irradiance = 1.0f});
    absorb_light_samples(few.update_view(), 0);
    CHECK(few.tables.direct[0] == Approx(1.0f));
    CHECK(few.tables.light_cdf.empty());
    CHECK(few.view().lights_at({.volume = 0}).empty());
}

TEST_CASE("The choice of lights goes on from what was learned, and follows new light samples") {
    LightField field;
    field.sample(0, 4.0f, 100);
    field.absorb();
    CHECK(field.learned().probability(0) == 1.0f);
    field.sample(1, 4.0f, 100);
    field.absorb();
    const float second = field.learned().probability(1);
    CHECK(second > 0.5f);  // newer samples weigh more
    CHECK(second < 1.0f);
    CHECK(field.learned().probability(0) == Approx(1.0f - second));
}
