// Neural kernels for the instruction set that the program is compiled for.
#include "cpu/neural_lanes.h"

namespace pl {

constinit const NeuralKernels kNeuralKernelsBaseline = neural_kernels_named("baseline");

}  // namespace pl
