#include "cpu/launchers.h"

namespace pl {
namespace {

template <FeatureSet F>
PassCounters run_probe_pass(const ProbePass& pass) {
    const ProbeWork work{pass.field, pass.sample, pass.strata_side};
    return run_paths<F>(pass.setup, pass.tracer, DefaultMethod{}, work);
}

}  // namespace

constinit const KernelRow<PicturePass> kDefaultKernels = make_picture_kernels<DefaultMethod>();
constinit const KernelRow<ProbePass> kProbeKernels =
    make_kernel_row<ProbePass>([]<FeatureSet F>() { return run_probe_pass<F>; });

}  // namespace pl
