#include "cuda/kernels/trace.cuh"

namespace pl::cuda {

constinit const KernelRow<PictureKernel<DefaultMethod>> kDefaultKernels = make_picture_kernels<DefaultMethod>();

}  // namespace pl::cuda
