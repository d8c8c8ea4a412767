#include "core/session/refinement_schedule.h"

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr std::size_t kVolumes = 100;

FieldProgress after(std::uint64_t passes, std::uint64_t samples = 1'000'000'000) {
    FieldProgress progress;
    progress.passes = passes;
    progress.records = samples;
    return progress;
}

}  // namespace

TEST_CASE("Refinement schedule: a given share is added in two rounds, after 8 and 16 passes") {
    const FieldSettings settings{.volumes = 100, .bins = 64, .refine_share = 0.5f};
    CHECK_FALSE(volumes_to_add(settings, kVolumes, {}, after(7)));
    CHECK(volumes_to_add(settings, kVolumes, {}, after(8)) == 25u);
    const Refinement once{.rounds = 1, .added = 25};
    CHECK_FALSE(volumes_to_add(settings, kVolumes + 25, once, after(15)));
    CHECK(volumes_to_add(settings, kVolumes + 25, once, after(16)) == 25u);
    CHECK_FALSE(volumes_to_add(settings, kVolumes + 50, {.rounds = 2, .added = 50}, after(1000)));
}

TEST_CASE("Refinement schedule: no share, no rounds") {
    const FieldSettings settings{.volumes = 100, .bins = 64, .refine_share = 0.0f};
    CHECK_FALSE(volumes_to_add(settings, kVolumes, {}, after(1000)));
}

TEST_CASE("Refinement schedule: without a share the training samples decide, and late rounds need more of them") {
    const FieldSettings settings{.volumes = 0, .bins = 64};
    REQUIRE(settings.refine_share == kRefineByRecords);
    CHECK(volumes_to_add(settings, kVolumes, {}, after(8, 0)) == 0u);  // due, but too early
    constexpr std::uint64_t kEnough = std::uint64_t{32} * 64 * (kVolumes + 10);
    CHECK(volumes_to_add(settings, kVolumes, {}, after(8, kEnough)) == 10u);
    CHECK(volumes_to_add(settings, kVolumes, {.rounds = 2, .added = 0}, after(48, kEnough)) == 0u);
    CHECK(volumes_to_add(settings, kVolumes, {.rounds = 2, .added = 0}, after(48, 3 * kEnough)) == 10u);
}
