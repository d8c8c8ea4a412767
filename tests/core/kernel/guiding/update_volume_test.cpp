// Volumes without new training samples may be left out of an update.
#include "core/kernel/guiding/update_volume.h"

#include "tests/support/catch.hpp"
#include "tests/support/field/random_tables.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr LearningRate kRates[] = {LearningRate::SampleMean, LearningRate::Forgetful};

/// Updates the field twice, the second time without new training samples.
bool is_changed_by_second_update(TestField& field) {
    field.update();
    const HostTables updated = field.tables;
    field.update();
    return !same_tables(updated, field.tables);
}

}  // namespace

TEST_CASE("An update without new training samples keeps every bit") {
    Uniforms random(31);
    for (const LearningRate rate : kRates)
        for (const float floor : {0.0f, kUniformShare, 1.0f})
            for (const int side : {1, 2, 3, 8, 15, 16, 32}) {
                INFO("side " << side << ", floor " << floor << ", rate " << static_cast<int>(rate));
                TestField field = any_field(side, 12, random);
                field.shape.rate = rate;
                field.shape.uniform_floor = floor;
                REQUIRE_FALSE(is_changed_by_second_update(field));
                for (std::size_t volume = 0; volume < 12; ++volume) add_any_samples(field.tables, volume, 3, random);
                REQUIRE_FALSE(is_changed_by_second_update(field));
            }
}

TEST_CASE("The first update after a split changes tables without new training samples, the second does not") {
    Uniforms random(32);
    TestField field = any_field(16, 4, random);
    field.update();
    const HostTables learned = field.tables;
    const std::vector<std::uint32_t> parents{2, 0};
    TestField split(16, std::vector<Vec3f>(6, Vec3f{0, 0, 1}));
    split.shape = field.shape;
    split.tables = split_field(field.shape, learned, parents);
    const HostTables before = split.tables;
    split.update();
    CHECK_FALSE(same_tables(before, split.tables));
    const HostTables after = split.tables;
    split.update();
    CHECK(same_tables(after, split.tables));
}
