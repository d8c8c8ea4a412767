#include "cpu/launchers.h"

namespace pl {

constinit const PassKernels<PicturePass> kMonteCarloKernels =
    make_picture_kernels<MonteCarloMethod, KernelRange::Sparse>();

}  // namespace pl
