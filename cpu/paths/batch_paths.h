// The part of a batch of paths that does not depend on the kind of its paths.
#pragma once

#include "cpu/paths/guided_memory.h"
#include "cpu/paths/pass_setup.h"

namespace pl {

/// Base of LanePaths and StatePaths.
template <FeatureSet F, Method M>
struct BatchPaths {
    BatchPaths(const PassSetup& arguments, const M& of, SharedByThreads<M>& shared)
        : setup(arguments), method(of), guided(method, shared) {}
    BatchPaths(const BatchPaths&) = delete;
    BatchPaths& operator=(const BatchPaths&) = delete;

    bool samples_lights() const { return F.has(Feature::NextEventEstimation) && setup.path.next_event != 0; }
    /// The lookups of the block of path i, while those of the next one are under way.
    auto& lookups_of(std::uint32_t i) requires(TableGuided<M>) { return guided.lookups[i / kPathBlock % 2]; }
    StepOutput<M> output(typename M::Sample& sample) { return {sample, counters.path}; }

    const PassSetup& setup;
    M method;
    const PathContext<M> context{setup.scene, method, setup.path};
    GuidedMemory<M> guided;
    LaneKernels kernels = best_lane_kernels();
    PassCounters counters;
};

}  // namespace pl
