// CPU kernels: arguments and dispatch tables. picture_kernels.inc is compiled once per entry of MethodList, so that
// the kernels of all methods build in parallel.
#pragma once

#include "core/base/kernel_row.h"
#include "core/fields/field_model.h"
#include "core/kernel/methods/host_method_list.h"
#include "cpu/batch_tracer.h"
#include "cpu/path_work.h"
#include "cpu/run_paths.h"

namespace pl {

/// Arguments of a picture kernel. `field` is empty for methods without one.
struct PicturePass {
    PassSetup setup;
    const BatchTracer& tracer;
    AnyFieldView field;
    MixtureSettings mixture{};
    LearningSettings learning{};
    Camera camera;
    std::uint32_t sample = 0;
    FilmView film;
    SampleUse use = SampleUse::Film;
    PixelSubset subset{};
};

/// Arguments of a probe kernel.
struct ProbePass {
    PassSetup setup;
    const BatchTracer& tracer;
    TableView field;
    ProbeStratum stratum;
};

/// One kernel per compiled set of features.
template <class Pass>
using PassKernels = KernelRow<PassCounters (*)(const Pass&)>;

/// Picture kernels of an entry of MethodList.
template <int kEntry>
const PassKernels<PicturePass>& picture_kernels();
/// Picture kernels of an entry of HostMethodList.
template <int kEntry>
const PassKernels<PicturePass>& host_picture_kernels();
extern const PassKernels<ProbePass> kProbeKernels;

/// Maps a method to the type that run_paths() uses: methods guided by tables get their lookups ahead.
template <Method M>
struct RunMethod {
    using Type = M;
};
template <TableGuided M>
struct RunMethod<M> {
    using Type = LookedUpAhead<M>;
};

template <FeatureSet F, Method M>
PassCounters run_picture_pass(const PicturePass& pass) {
    typename RunMethod<M>::Type method;
    configure_method(method, pass.field, pass.mixture, pass.learning);
    const PictureWork<F, decltype(method)> work{pass.camera, pass.sample, pass.film, pass.use, pass.subset};
    return run_paths<F>(pass.setup, pass.tracer, method, work);
}

template <Method M>
constexpr PassKernels<PicturePass> make_picture_kernels() {
    return make_kernel_row<PassCounters (*)(const PicturePass&), M::kKernelRange>(
        []<FeatureSet F>() { return run_picture_pass<F, M>; });
}

/// Runs the kernel for the smallest compiled set of features that covers `needed`.
template <class Pass>
PassCounters launch(const PassKernels<Pass>& row, FeatureSet needed, const Pass& pass) {
    return row[covering_set(needed)](pass);
}

}  // namespace pl
