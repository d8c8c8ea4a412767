// The part of a batch of paths that does not depend on the kind of its paths, and what methods guided by tables keep in memory for each
// thread of a pass: volumes that are looked up before the paths reach their vertices, and queues of training samples.
#pragma once

#include "cpu/learning/lookups_ahead.h"
#include "cpu/learning/training_queue.h"
#include "cpu/paths/pass_setup.h"

namespace pl {

/// State shared by the threads of a pass; empty for methods not guided by tables.
template <class M>
struct SharedByThreads {
    explicit SharedByThreads(const M&) {}
};
template <TableGuided M>
struct SharedByThreads<M> {
    VolumeLocks locks;

    explicit SharedByThreads(const M& method) : locks(method.field.normals.count) {}
};

/// Lookups and training samples of one thread. Methods not guided by tables look up and record path by path.
template <class M>
struct GuidedMemory {
    GuidedMemory(const M& method, SharedByThreads<M>&) : method_(method) {}
    void record(const typename M::Sample& sample) { method_.record(sample); }
    void record_light(const typename M::Light& light, bool is_visible) { method_.record_light(light, is_visible); }
    void flush() {}

private:
    const M& method_;
};
template <TableGuided M>
struct GuidedMemory<M> {
    LookupsAhead lookups[2];  ///< of the current and the next block

    GuidedMemory(const M& method, SharedByThreads<M>& shared)
        : training_(method, shared.locks), lights_(method, shared.locks) {}
    void record(const typename M::Sample& sample) { training_.push(sample); }
    void record_light(const typename M::Light& light, bool is_visible) { lights_.push(light, is_visible); }
    void flush() {
        training_.flush();
        lights_.flush();
    }

private:
    TrainingQueue<M, QueuedSample<M>> training_;
    TrainingQueue<M, QueuedLight<M>> lights_;
};

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
