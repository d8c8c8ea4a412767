#include "cpu/launchers.h"

namespace pl {

constinit const PassKernels<PicturePass> kSarsaKernels =
    make_picture_kernels<SarsaMethod, range_of(LearningKernel::Late)>();

}  // namespace pl
