#include "cuda/kernels/trace.cuh"

namespace pl::cuda {

constinit const KernelRow<PictureKernel<PrecomputedMethod>> kPrecomputedKernels =
    make_picture_kernels<PrecomputedMethod>();

}  // namespace pl::cuda
