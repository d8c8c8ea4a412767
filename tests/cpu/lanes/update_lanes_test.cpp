// The update in SIMD lanes is the scalar one, bit by bit.
#include "cpu/learning/field_update.h"
#include "tests/cpu/small_room.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/random_tables.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr LearningRate kRates[] = {LearningRate::SampleMean, LearningRate::Forgetful};
constexpr std::uint32_t kUpdatedVolumes = 9;

void update_in_lanes(const LaneKernels& kernels, TestField& field, bool skips) {
    const TableUpdateView view = field.update_view();
    for (std::uint32_t volume = 0; volume < kUpdatedVolumes; ++volume)
        if (!skips || has_new_samples(kernels, view, volume)) update_volume_in_lanes(kernels, view, volume);
}

/// Updates copies of a field by lanes and by scalars, then again with new training samples in some of the volumes.
void check_field(const LaneKernels& kernels, const TestField& start, Uniforms& random) {
    TestField lanes = start;
    TestField scalar = start;
    update_in_lanes(kernels, lanes, false);
    scalar.update();
    REQUIRE(same_tables(scalar.tables, lanes.tables));
    for (int round = 0; round < 2; ++round) {
        for (std::size_t volume = 0; volume < kUpdatedVolumes; volume += 1 + random.below(3))
            add_any_samples(scalar.tables, volume, 1 + random.below(300), random);
        lanes.tables = scalar.tables;
        update_in_lanes(kernels, lanes, true);
        scalar.update();
        REQUIRE(same_tables(scalar.tables, lanes.tables));
    }
}

}  // namespace

TEST_CASE("Every instruction set updates tables to the bits of the scalar update") {
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        Uniforms random(41);
        for (const LearningRate rate : kRates)
            for (const float floor : {0.0f, kUniformShare, 1.0f})
                for (const int side : {1, 2, 3, 4, 8, 12, 15, 16, 24, 32}) {
                    INFO(kernels.isa << ", side " << side << ", floor " << floor << ", rate "
                                     << static_cast<int>(rate));
                    TestField field = any_field(side, kUpdatedVolumes, random);
                    field.shape.rate = rate;
                    field.shape.uniform_floor = floor;
                    field.shape.radiance_unit = std::exp2(static_cast<float>(random.below(40)) - 20.0f);
                    check_field(kernels, field, random);
                }
    }
}

TEST_CASE("Lanes update tables whose side is a multiple of their number") {
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        INFO(kernels.isa);
        CHECK(kernels.update_table(TestField(16).update_view(), 0));
        CHECK_FALSE(kernels.update_table(TestField(15).update_view(), 0));
    }
}

TEST_CASE("One training sample in any cell is found, and any sum of a volume") {
    for (const LaneKernels& kernels : usable_lane_kernels())
        for (const int side : {1, 3, 16}) {
            TestField field(side, std::vector<Vec3f>(3, Vec3f{0, 0, 1}));
            const auto cells = static_cast<std::size_t>(side * side);
            const auto found = [&](std::uint32_t volume) {
                return has_new_samples(kernels, field.update_view(), volume);
            };
            for (std::size_t cell = 0; cell < cells; ++cell) {
                field.tables.pending_count[cells + cell] = 1;
                REQUIRE(found(1));
                REQUIRE_FALSE(found(0));
                REQUIRE_FALSE(found(2));
                field.tables.pending_count[cells + cell] = 0;
            }
            for (LargeArray<std::int64_t>* sums : {&field.tables.pending_slope, &field.tables.pending_curvature,
                                                   &field.tables.pending_distance, &field.tables.pending_light}) {
                (*sums)[1] = -1;
                CHECK(found(1));
                CHECK_FALSE(found(2));
                (*sums)[1] = 0;
            }
        }
}

TEST_CASE("The back end updates every volume of new tables, and later those with new training samples") {
    const Room room;
    for (const int threads : {1, 2}) {
        const auto backend = make_backend(room, {.threads = threads});
        TestField field(room.shape.cells.side, std::vector<Vec3f>(room.volumes->normals.size(), Vec3f{0, 0, 1}));
        field.shape = room.shape;
        Uniforms random(43);
        for (std::size_t volume = 0; volume < volume_count(field.tables); ++volume)
            learn_anything(field.tables, volume, false, random);
        for (int round = 0; round < 3; ++round) {
            INFO(threads << " threads, round " << round);
            backend->upload_field(MethodId::Reinforcement, field.tables);
            backend->update_field(MethodId::Reinforcement);
            field.update();
            REQUIRE(same_tables(field.tables, tables_of(backend->download_field(MethodId::Reinforcement))));
            backend->update_field(MethodId::Reinforcement);
            REQUIRE(same_tables(field.tables, tables_of(backend->download_field(MethodId::Reinforcement))));
            for (std::size_t volume = 0; volume < volume_count(field.tables); volume += 3)
                add_any_samples(field.tables, volume, 3, random);
        }
    }
}

TEST_CASE("Passes of the back end train as an update of every volume would") {
    const Room room;
    for (const int threads : {1, 2}) {
        const auto backend = make_backend(room, {.threads = threads});
        const FilmSlot slot{MethodId::Reinforcement, View::Beauty};
        backend->upload_field(slot.method, room.empty_tables());
        backend->reset_film(slot, kWidth, kHeight);
        for (std::uint32_t sample = 0; sample < 3; ++sample) {
            // Few paths, so that some volumes have no new training samples.
            backend->run_pass({.slot = slot,
                               .features = needed_effects(*room.scene),
                               .path = {.seed = 3},
                               .camera = room.camera,
                               .sample = sample,
                               .end_pixel = sample == 0 ? kToTheLast : 4});
            TestField field(room.shape.cells.side, std::vector<Vec3f>(room.volumes->normals.size(), Vec3f{0, 0, 1}));
            field.shape = room.shape;
            field.tables = tables_of(backend->download_field(slot.method));
            backend->update_field(slot.method);
            field.update();
            REQUIRE(same_tables(field.tables, tables_of(backend->download_field(slot.method))));
        }
    }
}
