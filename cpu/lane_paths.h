// The paths of a batch that stay in SIMD lanes, with all that the stages of the batch share.
#pragma once

#include "cpu/guided_memory.h"
#include "cpu/pass_setup.h"
#include "cpu/path_rows.h"

namespace pl {

template <FeatureSet F, Method M>
struct LanePaths {
    LanePaths(const PassSetup& arguments, const M& of, SharedByThreads<M>& shared)
        : setup(arguments), method(of), rows(setup.batch_paths, samples_lights(), splits()), guided(method, shared) {}
    LanePaths(const LanePaths&) = delete;
    LanePaths& operator=(const LanePaths&) = delete;

    bool samples_lights() const { return F.has(Feature::NextEventEstimation) && setup.path.next_event != 0; }
    /// Whether paths may be split: then roulette is played path by path.
    bool splits() const { return SplittingMethod<M> && splits_paths(setup.path); }
    /// The lookups of the block of path i, while those of the next one are under way.
    auto& lookups_of(std::uint32_t i) requires(TableGuided<M>) { return guided.lookups[i / kPathBlock % 2]; }
    StepOutput<M> output(typename M::Sample& sample) { return {sample, counters.path}; }

    const PassSetup& setup;
    M method;
    const PathContext<M> context{setup.scene, method, setup.path};
    PathRows<F, M> rows;
    GuidedMemory<M> guided;
    LaneKernels kernels = best_lane_kernels();
    PassCounters counters;
};

}  // namespace pl
