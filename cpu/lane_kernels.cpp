#include "cpu/lane_kernels.h"

#include <vector>

#include "cpu/lane_names.h"

namespace pl {
namespace {

std::vector<LaneKernels> find_usable_kernels() {
    std::vector<LaneKernels> usable{kLaneKernelsBaseline};
#ifdef PL_LANE_CLONES
    if (PL_WIDEST_LANES >= 1 && __builtin_cpu_supports("avx2")) usable.push_back(kLaneKernelsAvx2);
    if (PL_WIDEST_LANES >= 2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
        usable.push_back(kLaneKernelsAvx512);
#endif
    return usable;
}

}  // namespace

std::vector<std::string_view> compiled_lane_names() {
    std::vector<std::string_view> names{kLaneKernelsBaseline.isa};
#ifdef PL_LANE_CLONES
    if (PL_WIDEST_LANES >= 1) names.emplace_back(kLaneKernelsAvx2.isa);
    if (PL_WIDEST_LANES >= 2) names.emplace_back(kLaneKernelsAvx512.isa);
#endif
    return names;
}

std::string_view used_lane_name() { return best_lane_kernels().isa; }

std::span<const LaneKernels> usable_lane_kernels() {
    static const std::vector<LaneKernels> usable = find_usable_kernels();
    return usable;
}

}  // namespace pl
