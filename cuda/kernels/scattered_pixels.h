// The pixels of a warp if few pixels of a picture have much work: those that the border of a lamp crosses.
#pragma once

#include "core/kernel/base/platform.h"

namespace pl::cuda {

/// The number of a thread's item among `count`, in warps of `lanes` threads: no two threads have the same one below `count`. The items
/// of a warp are `count / lanes` apart and a step more, so that the items along a line of a picture, horizontal,
/// vertical or slanted, belong to different warps. `count` or more: the thread has none.
PL_HD inline std::uint32_t scattered_number(std::uint32_t thread, std::uint32_t lanes, std::uint32_t count) {
    constexpr std::uint32_t kStep = 40503;  // prime
    const std::uint32_t warps = (count + lanes - 1) / lanes;
    const std::uint32_t lane = thread % lanes;
    const std::uint32_t warp = thread / lanes;
    return warp < warps ? lane * warps + (warp + lane * kStep) % warps : count;
}

}  // namespace pl::cuda
