// The kernels of passes: arguments and dispatch tables. picture_kernels.inc is compiled once per set of effects: the methods share what
// depends on the set alone, and the sets build in parallel.
#pragma once

#include "core/base/kernel_row.h"
#include "core/fields/field_kernels.h"
#include "core/kernel/film/sample_variance.h"
#include "core/kernel/inspect/views.h"
#include "core/kernel/integrator/lamp_borders.h"
#include "cpu/paths/pass_setup.h"
#include "cpu/paths/path_batch.h"
#include "cpu/rays/batch_tracer.h"

namespace pl {

/// Arguments of a picture kernel. `field` is empty for methods without one.
struct PicturePass {
    PassSetup setup;
    const BatchTracer& tracer;
    AnyFieldView field;
    MethodSettings settings{};
    Camera camera;
    std::uint32_t sample = 0;
    FilmView film;
    VarianceMeasure measure{};
};

/// Arguments of a probe kernel.
struct ProbePass {
    PassSetup setup;
    const BatchTracer& tracer;
    TableView field;
    ProbeStratum stratum;
};

/// Arguments of an emission kernel, which traces further camera rays for the emission of lamps whose border crosses a pixel, after a pass
/// has added its samples; setup.paths numbers the pixels that it visits.
struct EmissionPass {
    PassSetup setup;
    const BatchTracer& tracer;
    EmissionContext context;
    FilmView film;
};

/// Arguments of a view kernel, which traces one camera ray per pixel to the first surface. `shown` is empty for views without a field.
struct ViewPass {
    PassSetup setup;
    View view = View::Normal;
    ShownField shown;
    Camera camera;
    std::uint32_t sample = 0;
    FilmView film;
};

/// One kernel per compiled set of features.
template <class Pass>
using PassKernels = KernelRow<PassCounters (*)(const Pass&)>;

using PictureKernel = PassCounters (*)(const PicturePass&);
/// The picture kernels of a set of effects: [entry of HostMethodList]. Null where the set is not in the entry's range.
using PictureKernels = std::array<PictureKernel, HostMethodList::kCount>;
/// The picture kernels of kCompiledSets[kSet].
template <int kSet>
const PictureKernels& picture_kernels();
extern const PassKernels<ProbePass> kProbeKernels;
extern const PassKernels<EmissionPass> kEmissionKernels;
extern const PassKernels<ViewPass> kViewKernels;

template <FeatureSet F, Method M>
PassCounters run_picture_pass(const PicturePass& pass) {
    std::conditional_t<TableGuided<M>, LookedUpAhead<M>, M> method;
    configure_method(method, pass.field, pass.settings);
    const PictureWork<F, decltype(method)> work{pass.camera, pass.sample, pass.film, pass.measure};
    return run_paths<F>(pass.setup, pass.tracer, method, work);
}

template <int kSet>
constexpr PictureKernels make_picture_kernels() {
    PictureKernels kernels{};
    any_entry<HostMethodList>([&]<int kEntry>() {
        using Kernel = TypeAt<kEntry, HostMethodList>;
        if constexpr (is_compiled(kSet, Kernel::kRange))
            kernels[kEntry] = run_picture_pass<kCompiledSets[kSet], typename Kernel::Integrator>;
        return false;
    });
    return kernels;
}

/// The picture kernel of an entry for a pass that needs these effects.
template <int kEntry>
PictureKernel picture_kernel(FeatureSet needed) {
    static const auto kSets = []<int... kSet>(std::integer_sequence<int, kSet...>) {
        return std::array{picture_kernels<kSet>()[kEntry]...};
    }
    (std::make_integer_sequence<int, kCompiledSetCount>{});
    return kSets[covering_set(needed, TypeAt<kEntry, HostMethodList>::kRange)];
}

/// Runs the kernel for the smallest compiled set of features that covers `needed`.
template <class Pass>
PassCounters launch(const PassKernels<Pass>& row, FeatureSet needed, const Pass& pass) {
    return row[covering_set(needed)](pass);
}

}  // namespace pl
