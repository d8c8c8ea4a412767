// Extents of sets of points, which trees and partitions split along the longest one.
#pragma once

#include <functional>

#include "core/kernel/base/math.h"

namespace pl {

/// Difference of the largest and the smallest coordinates of one vector of each element: `vector` is its member.
template <class Range, class Member>
Vec3f extent_of(const Range& elements, Member vector) {
    Vec3f low{kInfinity};
    Vec3f high{-kInfinity};
    for (const auto& element : elements) {
        low = glm::min(low, std::invoke(vector, element));
        high = glm::max(high, std::invoke(vector, element));
    }
    return high - low;
}

/// The first one of equally long axes.
inline int longest_axis(Vec3f extent) {
    const int axis = extent.y > extent.x ? 1 : 0;
    return extent.z > extent[axis] ? 2 : axis;
}

}  // namespace pl
