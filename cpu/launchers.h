// What kernels are called with, and the tables of compiled ones, filled in methods/*.cpp so that builds run in parallel.
#pragma once

#include <type_traits>

#include "core/base/kernel_row.h"
#include "core/kernel/methods/default.h"
#include "core/kernel/methods/monte_carlo.h"
#include "core/kernel/methods/precomputed.h"
#include "core/kernel/methods/reinforcement.h"
#include "core/kernel/methods/sarsa.h"
#include "cpu/batch_tracer.h"
#include "cpu/path_work.h"
#include "cpu/run_paths.h"

namespace pl {

/// What a kernel that makes pictures is called with. `field` is empty for methods without one.
struct PicturePass {
    PassSetup setup;
    const BatchTracer& tracer;
    TableField field;
    MixtureSettings mixture{};
    LearningSettings learning{};
    Camera camera;
    std::uint32_t sample = 0;
    FilmView film;
};

/// What a kernel that fills radiance maps is called with.
struct ProbePass {
    PassSetup setup;
    const BatchTracer& tracer;
    TableField field;
    std::uint32_t sample = 0;
    std::uint32_t strata_side = 1;
};

/// One kernel per compiled set of effects.
template <class Pass>
using PassKernels = KernelRow<PassCounters (*)(const Pass&)>;

extern const PassKernels<PicturePass> kDefaultKernels;
extern const PassKernels<PicturePass> kPrecomputedKernels;
extern const PassKernels<PicturePass> kReinforcementKernels;
extern const PassKernels<PicturePass> kSarsaKernels;
extern const PassKernels<PicturePass> kMonteCarloKernels;
extern const PassKernels<ProbePass> kProbeKernels;

/// A method as run_paths() wants it.
template <Method M>
struct RunMethod {
    using Type = M;
};
template <Method M>
requires std::derived_from<M, GuidedSampling>
struct RunMethod<M> {
    using Type = LookedUpAhead<M>;
};

template <FeatureSet F, Method M>
PassCounters run_picture_pass(const PicturePass& pass) {
    typename RunMethod<M>::Type method;
    if constexpr (std::is_base_of_v<GuidedSampling, M>) {
        method.field = pass.field;
        method.mixture = pass.mixture;
    }
    if constexpr (FollowingMethod<M>) method.learning = pass.learning;
    const PictureWork<F, decltype(method)> work{pass.camera, pass.sample, pass.film};
    return run_paths<F>(pass.setup, pass.tracer, method, work);
}

template <Method M, KernelRange range = KernelRange::Full>
constexpr PassKernels<PicturePass> make_picture_kernels() {
    return make_kernel_row<PassCounters (*)(const PicturePass&), range>(
        []<FeatureSet F>() { return run_picture_pass<F, M>; });
}

/// The kernel that serves the needed effects.
template <class Pass>
PassCounters launch(const PassKernels<Pass>& row, FeatureSet needed, const Pass& pass) {
    return row[covering_set(needed)](pass);
}

}  // namespace pl
