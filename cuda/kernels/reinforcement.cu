#include "cuda/kernels/trace.cuh"

namespace pl::cuda {

constinit const KernelRow<PictureKernel<ReinforcementMethod>> kReinforcementKernels =
    make_picture_kernels<ReinforcementMethod>();

}  // namespace pl::cuda
