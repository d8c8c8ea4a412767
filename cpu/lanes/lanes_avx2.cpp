// Lane kernels for AVX2.
#include "cpu/lanes/lanes_impl.h"

namespace pl {

constinit const LaneKernels kLaneKernelsAvx2 = lane_kernels_named("avx2");

}  // namespace pl
