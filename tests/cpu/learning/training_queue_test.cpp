// Pending sums of training samples from several threads equal the sums of a single thread.
#include "cpu/base/parallel_for.h"
#include "cpu/learning/training_queue.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"
#include "tests/support/field/guided_methods.h"

using namespace pl;
using namespace pl::test;

namespace {

using Record = ReinforcementMethod::Sample;

/// A field of `volumes` volumes with nonzero means, so that training samples add to all six sums.
TestField expecting_field(std::size_t volumes) {
    TestField field(2, std::vector<Vec3f>(volumes, Vec3f{0, 0, 1}));
    field.shape.extent = 1.0f;
    std::fill(field.tables.mean_radiance.begin(), field.tables.mean_radiance.end(), 0.5f);
    return field;
}

/// Training samples of all kinds, some without a volume.
std::vector<Record> any_records(std::size_t count, std::size_t volumes, Uniforms& random) {
    std::vector<Record> records(count);
    for (Record& record : records) {
        record.entry.volume = static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(volumes) + 1)) - 1;
        record.entry.cell = static_cast<std::int32_t>(random.below(4));
        record.bsdf_ratio = random.between(0.1f, 2.0f);
        record.distance = random.next();
        record.target = random.between(0.0f, 2.0f);
    }
    return records;
}

bool same_sums(const HostTables& a, const HostTables& b) {
    return a.pending_sum == b.pending_sum && a.pending_count == b.pending_count &&
           a.pending_slope == b.pending_slope && a.pending_curvature == b.pending_curvature &&
           a.pending_distance == b.pending_distance && a.pending_light == b.pending_light;
}

}  // namespace

TEST_CASE("Training samples of many threads give the sums of one, for any number of volumes") {
    constexpr int kThreads = 4;
    constexpr std::size_t kRecords = 5000;
    Uniforms random(11);
    for (const std::size_t volumes : {1, 2, 64, 65, 1000}) {
        INFO(volumes << " volumes");
        std::vector<std::vector<Record>> records;
        for (int thread = 0; thread < kThreads; ++thread) records.push_back(any_records(kRecords, volumes, random));

        TestField expected = expecting_field(volumes);
        const ReinforcementMethod alone = guided_by(expected.view());
        for (const std::vector<Record>& of_thread : records)
            for (const Record& record : of_thread) alone.record(record);

        TestField shared = expecting_field(volumes);
        const ReinforcementMethod method = guided_by(shared.view());
        VolumeLocks locks(static_cast<std::uint32_t>(volumes));
        run_on_plain_threads(kThreads, [&](int thread) {
            TrainingQueue<ReinforcementMethod, QueuedSample<ReinforcementMethod>> kept(method, locks);
            for (const Record& record : records[static_cast<std::size_t>(thread)]) kept.push(record);
            kept.flush();
        });
        CHECK(same_sums(shared.tables, expected.tables));
        CHECK(shared.tables.pending_light.front() > 0);
        CHECK(shared.tables.pending_curvature.front() > 0);
    }
}

TEST_CASE("Every volume has a lock, and volumes that have the same one are neighbours") {
    for (const std::uint32_t volumes : {0u, 1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u, 1u << 20, (1u << 31) - 1u}) {
        INFO(volumes << " volumes");
        const VolumeLocks locks(volumes);
        CHECK(locks.range_of(0) == 0);
        const auto last = static_cast<std::int32_t>(std::max(volumes, 1u) - 1u);
        CHECK(locks.range_of(last) < VolumeLocks::kRanges);
        if (volumes >= VolumeLocks::kRanges) CHECK(locks.range_of(last) >= VolumeLocks::kRanges / 2);
    }
}
