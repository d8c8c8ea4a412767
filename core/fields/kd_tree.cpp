// Building the balanced tree that core/kernel/guiding/volume_lookup.h searches.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fields/place_volumes.h"

namespace pl {
namespace {

using NodeIterator = std::vector<KdNode>::iterator;

std::uint32_t longest_axis(NodeIterator begin, NodeIterator end) {
    Vec3f low{kInfinity};
    Vec3f high{-kInfinity};
    for (auto node = begin; node != end; ++node) {
        low = glm::min(low, node->position);
        high = glm::max(high, node->position);
    }
    const Vec3f extent = high - low;
    const std::uint32_t axis = extent.y > extent.x ? 1 : 0;
    return extent.z > extent[static_cast<int>(axis)] ? 2 : axis;
}

/// Puts the median along the longest axis in the middle, lesser entries before it and greater ones behind. Equal
/// coordinates are ordered by number, so that the order is total. Ranges halve, so the recursion is at most 32 deep.
void arrange(NodeIterator begin, NodeIterator end) {
    if (begin == end) return;
    const std::uint32_t axis = longest_axis(begin, end);
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [axis](const KdNode& a, const KdNode& b) {
        const float x = a.position[static_cast<int>(axis)];
        const float y = b.position[static_cast<int>(axis)];
        return x != y ? x < y : a.volume < b.volume;
    });
    middle->axis = axis;
    arrange(begin, middle);
    arrange(middle + 1, end);
}

}  // namespace

std::vector<KdNode> build_kd_tree(Span<const SurfacePoint> sites) {
    std::vector<KdNode> nodes;
    nodes.reserve(sites.count);
    for (std::uint32_t i = 0; i < sites.count; ++i)
        if (is_finite(sites[i].position)) nodes.push_back({sites[i].position, i, sites[i].geometric_normal, 0});
    return build_kd_tree(std::move(nodes));
}

std::vector<KdNode> build_kd_tree(std::vector<KdNode> nodes) {
    arrange(nodes.begin(), nodes.end());
    return nodes;
}

}  // namespace pl
