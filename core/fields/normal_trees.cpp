#include "core/fields/normal_trees.h"

#include <algorithm>
#include <cmath>

#include "core/fields/place_volumes.h"

namespace pl {
namespace {

/// Margin for the rounding of the product that normals_agree() compares, in radians.
constexpr double kRounding = 1e-5;

/// A cell of the cube [-1, 1]^3 whose faces have `side` x `side` cells.
struct CubeCell {
    int side;
    int face, row, column;

    static CubeCell of(Vec3f v, int side) {
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (std::fabs(v[i]) > std::fabs(v[axis])) axis = i;
        const auto cell = [&](int other) {
            const float x = v[other] / std::fabs(v[axis]);
            return std::clamp(static_cast<int>((0.5f * x + 0.5f) * static_cast<float>(side)), 0, side - 1);
        };
        return {side, 2 * axis + (v[axis] < 0.0f ? 1 : 0), cell((axis + 1) % 3), cell((axis + 2) % 3)};
    }
    static CubeCell at(std::size_t index, int side) {
        const auto i = static_cast<int>(index);
        return {side, i / (side * side), i / side % side, i % side};
    }
    std::size_t index() const { return static_cast<std::size_t>((face * side + row) * side + column); }

    Vec3f middle() const {
        const int axis = face / 2;
        const auto at = [&](int cell) {
            return (static_cast<float>(cell) + 0.5f) * (2.0f / static_cast<float>(side)) - 1.0f;
        };
        Vec3f v{0.0f};
        v[axis] = face % 2 == 0 ? 1.0f : -1.0f;
        v[(axis + 1) % 3] = at(row);
        v[(axis + 2) % 3] = at(column);
        return glm::normalize(v);
    }
    /// Bound of the angle between a direction of the cell and its middle, in radians: half of the diagonal of a cell that is seen from
    /// the distance 1, the least distance of the face.
    double radius() const { return std::sqrt(2.0) / side * 1.001; }
};

}  // namespace

NormalTrees::NormalTrees(Span<const KdNode> nodes) : nodes_(nodes) {
    std::uint32_t volumes = 0;
    for (const KdNode& node : nodes) volumes = std::max(volumes, node.volume + 1);
    node_of_volume_.resize(volumes);
    for (std::uint32_t i = 0; i < nodes.count; ++i) node_of_volume_[nodes[i].volume] = i;
}

std::size_t NormalTrees::cell_of(Vec3f normal) { return CubeCell::of(normal, kSide).index(); }

KdTreeView NormalTrees::tree_of(std::size_t cell) {
    Tree& tree = trees_[cell];
    std::call_once(tree.is_built, [&] {
        const CubeCell normals = CubeCell::at(cell, kSide);
        const Vec3f middle = normals.middle();
        const double angle = std::acos(static_cast<double>(kMinNormalCosine)) + normals.radius() + kRounding;
        const auto least = static_cast<float>(std::cos(angle));
        for (const KdNode& node : nodes_)
            if (glm::dot(middle, node.normal) > least) tree.nodes.push_back(node);
        tree.nodes = build_kd_tree(std::move(tree.nodes));
    });
    return {{tree.nodes.data(), static_cast<std::uint32_t>(tree.nodes.size())}};
}

}  // namespace pl
