// Lane kernels for AVX-512 (F, VL, BW, DQ).
#include "cpu/lanes/lanes_impl.h"

namespace pl {

constinit const LaneKernels kLaneKernelsAvx512 = lane_kernels_named("avx512");

}  // namespace pl
