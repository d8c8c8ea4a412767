// The time of an update of a field, one cell after the other and in SIMD lanes of every instruction set of this machine.
// Usage: update_bench [VOLUMES [BINS [ROUNDS]]]. Processor time of one thread; the versions take turns, each on its own copy of
// the field with the same training samples, and have to agree to the bit.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "cpu/learning/field_update.h"
#include "tests/bench/machine_load.h"
#include "tests/bench/quartiles.h"
#include "tests/support/field/random_tables.h"

namespace pl::benchmarks {
namespace {

using UpdateFn = std::function<void(const TableUpdateView&, std::uint32_t volume)>;

/// One version of the update with its own field.
struct Version {
    std::string name;
    UpdateFn update;
    HostTables tables;
    std::vector<double> ns;  ///< per volume. [round]
};

/// Training samples of one pass in a third of the cells.
void add_samples(HostTables& tables, std::uint32_t seed) {
    test::Uniforms random(seed);
    for (std::size_t cell = 0; cell < tables.pending_count.size(); ++cell) {
        if (random.below(3) != 0) continue;
        tables.pending_count[cell] = 1 + random.below(4);
        tables.pending_sum[cell] = static_cast<std::int64_t>(random.below(1u << 24)) * tables.pending_count[cell];
    }
}

double time_update(const FieldShape& shape, Version& version) {
    const TableUpdateView field = update_view(shape, version.tables);
    const std::uint32_t volumes = field.mean_radiance.count;
    const std::clock_t start = std::clock();
    for (std::uint32_t volume = 0; volume < volumes; ++volume) version.update(field, volume);
    return 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / volumes;
}

std::vector<Version> all_versions(const HostTables& empty) {
    std::vector<Version> versions{{"scalar", update_volume, empty, {}}};
    for (const LaneKernels& kernels : usable_lane_kernels()) {
        versions.push_back({kernels.isa,
                            [&kernels](const TableUpdateView& field, std::uint32_t volume) {
                                update_volume_in_lanes(kernels, field, volume);
                            },
                            empty,
                            {}});
    }
    const LaneKernels& best = best_lane_kernels();
    versions.push_back({"skipped",
                        [&best](const TableUpdateView& field, std::uint32_t volume) {
                            if (has_new_samples(best, field, volume)) std::abort();
                        },
                        empty,
                        {}});
    return versions;
}

/// Returns whether all versions agree.
bool measure(std::size_t volumes, int bins, int rounds) {
    const FieldShape shape{.cells = {static_cast<int>(std::lround(std::sqrt(bins)))}};
    std::vector<Version> versions = all_versions(make_arrays<HostTables>(shape, volumes));
    for (int round = 0; round < rounds; ++round)
        for (Version& version : versions) {
            if (version.name != "skipped") add_samples(version.tables, static_cast<std::uint32_t>(round));
            version.ns.push_back(time_update(shape, version));
        }
    bool same = true;
    for (const Version& version : versions) {
        std::vector<double> gain;
        for (std::size_t round = 0; round < version.ns.size(); ++round)
            gain.push_back(versions.front().ns[round] / std::max(version.ns[round], 1e-3));
        const Quartiles ns = quartiles_of(version.ns);
        const Quartiles ratio = quartiles_of(gain);
        std::printf("%-9s %8.0f [%.0f, %.0f] %8.2f [%.2f, %.2f]\n", version.name.c_str(), ns.median, ns.lower,
                    ns.upper, ratio.median, ratio.lower, ratio.upper);
        if (version.name != "skipped") same = same && test::same_tables(version.tables, versions.front().tables);
    }
    return same;
}

}  // namespace
}  // namespace pl::benchmarks

int main(int count, char** arguments) {
    const int volumes = count > 1 ? std::max(1, std::atoi(arguments[1])) : 1000;
    const int bins = count > 2 ? std::max(1, std::atoi(arguments[2])) : 256;
    const int rounds = count > 3 ? std::max(1, std::atoi(arguments[3])) : 101;
    const pl::benchmarks::MachineLoad load;
    std::printf("%d volumes of %d cells: ns per volume, times as fast as scalar\n", volumes, bins);
    const bool same = pl::benchmarks::measure(static_cast<std::size_t>(volumes), bins, rounds);
    const pl::benchmarks::MachineLoad::Shares shares = load.shares();
    std::printf("processors busy: %.2f with this, %.2f with other work, %.2f stolen\n", shares.own, shares.foreign,
                shares.stolen);
    if (!same) std::printf("the versions disagree\n");
    return same ? 0 : 1;
}
