#include "cuda/kernels/trace.cuh"

namespace pl::cuda {

constinit const KernelRow<PictureKernel<MonteCarloMethod>> kMonteCarloKernels =
    make_picture_kernels<MonteCarloMethod, KernelRange::Sparse>();

}  // namespace pl::cuda
