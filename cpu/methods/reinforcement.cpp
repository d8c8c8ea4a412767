#include "cpu/launchers.h"

namespace pl {

constinit const KernelRow<PicturePass> kReinforcementKernels = make_picture_kernels<ReinforcementMethod>();

}  // namespace pl
