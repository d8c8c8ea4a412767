// Building the balanced tree that core/kernel/guiding/volume_lookup.h searches.
#include <algorithm>
#include <span>
#include <utility>

#include "core/fields/extent.h"
#include "core/fields/place_volumes.h"

namespace pl {
namespace {

using NodeIterator = std::vector<KdNode>::iterator;

/// Puts the median along the longest axis in the middle, lesser entries before it and greater ones behind. Equal
/// coordinates are ordered by number, so that the order is total. Ranges halve, so the recursion is at most 32 deep.
void arrange(NodeIterator begin, NodeIterator end) {
    if (begin == end) return;
    const int axis = longest_axis(extent_of(std::span(begin, end), &KdNode::position));
    const auto middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [axis](const KdNode& a, const KdNode& b) {
        const float x = a.position[axis];
        const float y = b.position[axis];
        return x != y ? x < y : a.volume < b.volume;
    });
    middle->axis = static_cast<std::uint32_t>(axis);
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
