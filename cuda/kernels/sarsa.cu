#include "cuda/kernels/trace.cuh"

namespace pl::cuda {

constinit const KernelRow<PictureKernel<SarsaMethod>> kSarsaKernels =
    make_picture_kernels<SarsaMethod, KernelRange::Sparse>();

}  // namespace pl::cuda
