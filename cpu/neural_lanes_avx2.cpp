// Neural kernels for AVX2.
#include "cpu/neural_lanes.h"

namespace pl {

constinit const NeuralKernels kNeuralKernelsAvx2 = neural_kernels_named("avx2");

}  // namespace pl
