#include "cuda/kernels/trace.cuh"

namespace pl::cuda {

constinit const KernelRow<ProbeKernel> kProbeKernels = make_kernel_row<ProbeKernel, kProbeRange>(
    []<FeatureSet F>() { return trace_paths<F.bits, ProbeMethod, ProbePaths>; });

}  // namespace pl::cuda
