#include "cpu/launchers.h"

namespace pl {

constinit const KernelRow<PicturePass> kPrecomputedKernels = make_picture_kernels<PrecomputedMethod>();

}  // namespace pl
