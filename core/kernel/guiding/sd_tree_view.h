// An SD-tree: its arrays, and how kernels read them: lookup in its two kinds of trees, sampling and density of directions.
// [Mueller et al. 2017, "Practical Path Guiding for Efficient Light-Transport Simulation"]
#pragma once

#include "core/kernel/base/equal_area_sphere.h"
#include "core/kernel/guiding/field_view.h"

namespace pl {

/// A binary tree over space, each of whose leaves has a quadtree over directions; and the irradiance of the radiance volumes.
/// BSDF fractions belong to leaves.
/// A slot is one quadrant of a node of a quadtree: slot = 4 node + quadrant.
template <template <class> class Learned, template <class> class Pending>
struct SdTreeArrays : MixtureSums<Learned, Pending>,
                      VolumeIrradiance<Learned, Pending>,
                      LightSampleSums<Learned, Pending> {
    Learned<std::uint32_t> spatial;     ///< SpatialNode::word. [spatial node]
    Learned<std::uint32_t> first_node;  ///< root of the quadtree, whose nodes follow one another. [leaf]

    Learned<float> energy;                 ///< integral of incident radiance over the quadrant, in steradians. [slot]
    Learned<std::uint32_t> child;          ///< node that divides the quadrant, counted from the root; 0: none. [slot]
    Pending<std::int64_t> pending_energy;  ///< of target / density, fixed point. [slot]

    Learned<std::uint32_t> visits;         ///< training samples so far; divided where a leaf is split. [leaf]
    Pending<std::uint32_t> pending_count;  ///< of training samples. [leaf]
};

/// Deepest node of a quadtree; the root has depth 0. Quadrants then have sides of at least 2^-20.
inline constexpr std::uint32_t kMostQuadDepth = 19;
/// Most divisions of space on the way to a leaf: 16 of each axis.
inline constexpr std::uint32_t kMostSpatialDepth = 48;
/// Slots are numbered by so many bits in FieldDensity::bin, below the depth of their node.
inline constexpr std::uint32_t kSlotBits = 26;
/// Most nodes of all quadtrees.
inline constexpr std::uint32_t kMostQuadNodes = 1u << (kSlotBits - 2);

/// A node of the binary tree over space: a leaf, or the first of two children, which follow one another.
struct SpatialNode {
    static constexpr std::uint32_t kIsLeaf = 0x80000000u;

    std::uint32_t word = kIsLeaf;

    PL_HD constexpr bool is_leaf() const { return (word & kIsLeaf) != 0; }
    PL_HD constexpr std::uint32_t number() const { return word & ~kIsLeaf; }  ///< of the leaf, or of the first child
};

/// A leaf of the tree over space, and the number of divisions on the way to it.
struct SpatialLeaf {
    std::uint32_t leaf = 0;
    std::uint32_t depth = 0;
};

/// A slot without children, and the depth of its node.
struct QuadSlot {
    std::uint32_t slot = 0;
    std::uint32_t depth = 0;

    /// Side of the slot's quadrant; the square has side 1.
    PL_HD float side() const { return 1.0f / static_cast<float>(2u << depth); }
};

/// Sum over the quadrants of a node, exact for four equal ones: then a node that was divided evenly keeps its sum.
PL_HD inline float sum_of_quadrants(const float* energy) { return (energy[0] + energy[1]) + (energy[2] + energy[3]); }

struct SdTreeView : FieldView, SdTreeArrays<ConstSpan, Span> {
    Vec3f corner{0.0f};         ///< lowest corner of the cube that the tree divides
    float inverse_edge = 1.0f;  ///< one over the edge of the cube

    /// A position in units of the cube, moved into it: [0,1)^3.
    PL_HD Vec3f in_cube(Vec3f position) const {
        const Vec3f p = (position - corner) * inverse_edge;
        return {clamp_to(p.x, 0.0f, kBelowOne), clamp_to(p.y, 0.0f, kBelowOne), clamp_to(p.z, 0.0f, kBelowOne)};
    }
    /// The leaf of a point in units of the cube. Axes take turns; each division halves.
    PL_HD SpatialLeaf leaf_at(Vec3f point) const {
        SpatialNode node{spatial[0]};
        for (std::uint32_t depth = 0;; ++depth) {
            if (node.is_leaf()) return {node.number(), depth};
            const float twice = 2.0f * point.x;
            const std::uint32_t upper = twice >= 1.0f ? 1 : 0;
            point = {point.y, point.z, twice - static_cast<float>(upper)};
            node = {spatial[node.number() + upper]};
        }
    }
    /// The slot of a leaf's quadtree that holds a point of [0,1)^2. Quadrants: x in the lower bit, y in the higher one.
    PL_HD QuadSlot slot_at(std::uint32_t leaf, Vec2f square) const {
        const std::uint32_t root = first_node[leaf];
        std::uint32_t node = root;
        for (std::uint32_t depth = 0;; ++depth) {
            square = 2.0f * square;
            const std::uint32_t right = square.x >= 1.0f ? 1 : 0;
            const std::uint32_t upper = square.y >= 1.0f ? 1 : 0;
            const std::uint32_t slot = 4 * node + 2 * upper + right;
            const std::uint32_t below = child[slot];
            if (below == 0) return {slot, depth};
            node = root + below;
            square = {square.x - static_cast<float>(right), square.y - static_cast<float>(upper)};
        }
    }
    PL_HD float total_energy(std::uint32_t leaf) const {
        return sum_of_quadrants(energy.data + 4 * first_node[leaf]);
    }
    /// Density of a slot's directions per steradian; uniform before the leaf has learned.
    PL_HD float slot_pdf_sa(std::uint32_t leaf, const QuadSlot& slot) const {
        const float total = total_energy(leaf);
        if (!(total > 0.0f)) return kUniformSpherePdf;
        const float side = slot.side();
        return energy[slot.slot] / (total * side * side) * kUniformSpherePdf;
    }
    PL_HD float direction_pdf_sa(std::uint32_t leaf, Vec3f wi) const {
        return slot_pdf_sa(leaf, slot_at(leaf, sphere_to_square(wi)));
    }

    /// A point of the square with the distribution of a leaf's quadtree; u in [0,1)^2. Each of the numbers chooses one coordinate of
    /// the quadrants on the way down; its rest, uniform again, goes on.
    PL_HD Vec2f sample_square(std::uint32_t leaf, Vec2f u) const {
        const std::uint32_t root = first_node[leaf];
        std::uint32_t node = root;
        Vec2f low{0.0f};
        float side = 1.0f;
        while (true) {
            const float* quadrant = energy.data + 4 * node;
            const float left = quadrant[0] + quadrant[2];
            const float right = quadrant[1] + quadrant[3];
            if (!(left + right > 0.0f)) break;  // uniform
            const std::uint32_t column = choose(left / (left + right), u.x);
            const float below = quadrant[column];
            const float above = quadrant[column + 2];
            const std::uint32_t row = choose(below / (below + above), u.y);
            side *= 0.5f;
            low = low + side * Vec2f{static_cast<float>(column), static_cast<float>(row)};
            const std::uint32_t next = child[4 * node + 2 * row + column];
            if (next == 0) break;
            node = root + next;
        }
        return {min_of(low.x + side * u.x, kBelowOne), min_of(low.y + side * u.y, kBelowOne)};
    }

private:
    /// 0 with probability p, else 1; u becomes the uniform rest of the number, in [0,1).
    static PL_HD std::uint32_t choose(float p, float& u) {
        const bool is_first = u < p;
        u = is_first ? u / p : (u - p) / (1.0f - p);
        u = clamp_to(u, 0.0f, kBelowOne);
        return is_first ? 0 : 1;
    }
};

}  // namespace pl
