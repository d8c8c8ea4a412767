#include "cuda/kernels/trace.cuh"

namespace pl::cuda {

constinit const KernelRow<PictureKernel<MonteCarloMethod>> kMonteCarloKernels =
    make_picture_kernels<MonteCarloMethod, range_of(LearningKernel::WholePath)>();

}  // namespace pl::cuda
