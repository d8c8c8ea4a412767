// Lane kernels for the instructions that every machine of this architecture has.
#include "cpu/lanes_impl.h"

namespace pl {

constinit const LaneKernels kLaneKernelsBaseline = lane_kernels_named("baseline");

}  // namespace pl
