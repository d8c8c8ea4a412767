// Lane kernels for the baseline instruction set of the architecture.
#include "cpu/lanes/lanes_impl.h"

namespace pl {

constinit const LaneKernels kLaneKernelsBaseline = lane_kernels_named("baseline");

}  // namespace pl
