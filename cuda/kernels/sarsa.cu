#include "cuda/kernels/trace.cuh"

namespace pl::cuda {

constinit const KernelRow<PictureKernel<SarsaMethod>> kSarsaKernels =
    make_picture_kernels<SarsaMethod, range_of(LearningKernel::Late)>();

}  // namespace pl::cuda
