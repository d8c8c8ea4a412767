#include "cpu/launchers.h"

namespace pl {

constinit const PassKernels<PicturePass> kPrecomputedKernels = make_picture_kernels<PrecomputedMethod>();

}  // namespace pl
