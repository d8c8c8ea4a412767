// Tables of compiled kernels, [set of effects]. Back ends fill one row per method.
#pragma once

#include <array>
#include <utility>

#include "core/base/error.h"
#include "core/kernel/base/features.h"

namespace pl {

/// One kernel per entry of kCompiledSets.
template <class Kernel>
using KernelRow = std::array<Kernel, kCompiledSetCount>;

/// The row of choose.operator()<F>() for the compiled sets F of a range; every other set has the kernel of the next
/// larger one.
template <class Kernel, KernelRange range = KernelRange::Full, class Choose>
constexpr KernelRow<Kernel> make_kernel_row(Choose choose) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
        return KernelRow<Kernel>{
            choose.template operator()<kCompiledSets[smallest_superset(kCompiledSets[I], range)]>()...};
    }
    (std::make_index_sequence<kCompiledSetCount>{});
}

/// Index of the smallest compiled set of a range that covers the needed effects. Throws Error(Runtime) if there is
/// none.
inline std::size_t covering_set(FeatureSet needed, KernelRange range = KernelRange::Full) {
    const int set = smallest_superset(needed, range);
    if (!kCompiledSets[set].covers(needed))
        throw Error(ErrorKind::Runtime, "no kernel is compiled for the effects that the scene needs");
    return static_cast<std::size_t>(set);
}

}  // namespace pl
