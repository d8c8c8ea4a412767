#include "cpu/passes/pass_kernels.h"

namespace pl {
namespace {

template <FeatureSet F>
PassCounters run_probe_pass(const ProbePass& pass) {
    const ProbeWork<F> work{pass.field, pass.stratum};
    return run_paths<F>(pass.setup, pass.tracer, ProbeMethod{}, work);
}

}  // namespace

constinit const PassKernels<ProbePass> kProbeKernels =
    make_kernel_row<PassCounters (*)(const ProbePass&), kProbeRange>(
        []<FeatureSet F>() { return run_probe_pass<F>; });

}  // namespace pl
