#include "cpu/base/lane_kernels.h"

#include <vector>

namespace pl {
namespace {

struct CompiledKernels {
    LaneKernels kernels;
    bool run_here = true;  ///< whether this machine has their instructions
};

/// Narrowest vectors first.
std::vector<CompiledKernels> compiled_kernels() {
    std::vector<CompiledKernels> compiled{{kLaneKernelsBaseline}};
#ifdef PL_LANE_CLONES
    if (PL_WIDEST_LANES >= 1) compiled.push_back({kLaneKernelsAvx2, __builtin_cpu_supports("avx2") != 0});
    if (PL_WIDEST_LANES >= 2)
        compiled.push_back(
            {kLaneKernelsAvx512, __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                                     __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq")});
#endif
    return compiled;
}

std::vector<LaneKernels> find_usable_kernels() {
    std::vector<LaneKernels> usable;
    for (const CompiledKernels& compiled : compiled_kernels())
        if (compiled.run_here) usable.push_back(compiled.kernels);
    return usable;
}

}  // namespace

std::vector<std::string_view> compiled_lane_names() {
    std::vector<std::string_view> names;
    for (const CompiledKernels& compiled : compiled_kernels()) names.emplace_back(compiled.kernels.isa);
    return names;
}

std::string_view used_lane_name() { return best_lane_kernels().isa; }

std::span<const LaneKernels> usable_lane_kernels() {
    static const std::vector<LaneKernels> usable = find_usable_kernels();
    return usable;
}

}  // namespace pl
