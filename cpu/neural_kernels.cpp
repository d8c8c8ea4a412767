#include "cpu/neural_kernels.h"

#include <vector>

#include "cpu/lane_kernels.h"

namespace pl {
namespace {

std::vector<NeuralKernels> find_usable_kernels() {
    std::vector<NeuralKernels> usable{kNeuralKernelsBaseline};
#ifdef PL_LANE_CLONES
    if (usable_lane_kernels().size() > 1) usable.push_back(kNeuralKernelsAvx2);
    if (usable_lane_kernels().size() > 2) usable.push_back(kNeuralKernelsAvx512);
#endif
    return usable;
}

}  // namespace

std::span<const NeuralKernels> usable_neural_kernels() {
    static const std::vector<NeuralKernels> usable = find_usable_kernels();
    return usable;
}

}  // namespace pl
