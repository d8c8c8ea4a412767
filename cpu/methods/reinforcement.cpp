#include "cpu/launchers.h"

namespace pl {

constinit const PassKernels<PicturePass> kReinforcementKernels = make_picture_kernels<ReinforcementMethod>();

}  // namespace pl
