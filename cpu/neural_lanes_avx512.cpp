// Neural kernels for AVX512.
#include "cpu/neural_lanes.h"

namespace pl {

constinit const NeuralKernels kNeuralKernelsAvx512 = neural_kernels_named("avx512");

}  // namespace pl
