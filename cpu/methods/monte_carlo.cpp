#include "cpu/launchers.h"

namespace pl {

constinit const PassKernels<PicturePass> kMonteCarloKernels =
    make_picture_kernels<MonteCarloMethod, range_of(LearningKernel::WholePath)>();

}  // namespace pl
