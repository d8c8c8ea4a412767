// Tables of compiled kernels: one column per set of effects, filled in methods/*.cpp so that builds run in parallel.
#pragma once

#include <array>
#include <type_traits>
#include <utility>

#include "core/base/error.h"
#include "core/kernel/methods/default.h"
#include "core/kernel/methods/precomputed.h"
#include "core/kernel/methods/reinforcement.h"
#include "cpu/batch_tracer.h"
#include "cpu/path_work.h"
#include "cpu/run_paths.h"

namespace pl {

/// What a kernel that makes pictures is called with. `field` is empty for methods without one.
struct PicturePass {
    PassSetup setup;
    const BatchTracer& tracer;
    FieldView field;
    float bsdf_fraction = 0.5f;
    PinholeCamera camera;
    std::uint32_t sample = 0;
    FilmView film;
};

/// What a kernel that fills radiance maps is called with.
struct ProbePass {
    PassSetup setup;
    const BatchTracer& tracer;
    FieldView field;
    std::uint32_t sample = 0;
    std::uint32_t strata_side = 1;
};

/// One kernel per entry of kCompiledSets.
template <class Pass>
using KernelRow = std::array<PassCounters (*)(const Pass&), kCompiledSetCount>;

extern const KernelRow<PicturePass> kDefaultKernels;
extern const KernelRow<PicturePass> kPrecomputedKernels;
extern const KernelRow<PicturePass> kReinforcementKernels;
extern const KernelRow<ProbePass> kProbeKernels;

template <FeatureSet F, Method M>
PassCounters run_picture_pass(const PicturePass& pass) {
    M method;
    if constexpr (std::is_base_of_v<GuidedSampling, M>) {
        method.field = pass.field;
        method.bsdf_fraction = pass.bsdf_fraction;
    }
    const PictureWork<M> work{pass.camera, pass.sample, pass.film};
    return run_paths<F>(pass.setup, pass.tracer, method, work);
}

/// The row of what kernel.operator()<F>() returns for every compiled set F.
template <class Pass, class Kernel>
constexpr KernelRow<Pass> make_kernel_row(Kernel kernel) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
        return KernelRow<Pass>{kernel.template operator()<kCompiledSets[I]>()...};
    }
    (std::make_index_sequence<kCompiledSetCount>{});
}

template <Method M>
constexpr KernelRow<PicturePass> make_picture_kernels() {
    return make_kernel_row<PicturePass>([]<FeatureSet F>() { return run_picture_pass<F, M>; });
}

/// The set that serves the needed effects: the smallest compiled one that covers them.
inline std::size_t covering_set(FeatureSet needed) {
    const int set = smallest_superset(needed);
    if (!kCompiledSets[set].covers(needed))
        throw Error(ErrorKind::Runtime, "no kernel is compiled for the effects that the scene needs");
    return static_cast<std::size_t>(set);
}

/// The kernel that serves the needed effects.
template <class Pass>
PassCounters launch(const KernelRow<Pass>& row, FeatureSet needed, const Pass& pass) {
    return row[covering_set(needed)](pass);
}

}  // namespace pl
