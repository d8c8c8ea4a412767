// The sets of volumes that can be nearest to some point of a flat region, for points and distances as kernels round
// them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "core/fields/normal_trees.h"
#include "core/kernel/guiding/volume_grid.h"

namespace pl {

using Vec2d = glm::dvec2;

/// Convex; may shrink to a line or a point, or be empty.
class Polygon {
public:
    Polygon() = default;
    static Polygon rectangle(Vec2d low, Vec2d high) {
        Polygon polygon;
        for (const Vec2d p : {low, Vec2d{high.x, low.y}, high, Vec2d{low.x, high.y}}) polygon.add(p);
        return polygon;
    }

    bool empty() const { return count_ == 0; }
    const Vec2d* begin() const { return points_.data(); }
    const Vec2d* end() const { return points_.data() + count_; }

    /// Keeps the part with dot(n, p) <= limit. A polygon with no room for another corner may keep more.
    void clip(Vec2d n, double limit) {
        std::array<double, kCapacity> beyond;
        int outside = 0;
        for (int i = 0; i < count_; ++i) {
            beyond[i] = n.x * points_[i].x + n.y * points_[i].y - limit;
            outside += beyond[i] > 0.0 ? 1 : 0;
        }
        if (outside == 0 || (outside < count_ && count_ == kCapacity)) return;
        Polygon kept;
        for (int i = 0; i < count_ && outside < count_; ++i) {
            const int next = i + 1 < count_ ? i + 1 : 0;
            if (!(beyond[i] > 0.0)) kept.add(points_[i]);
            if ((beyond[i] > 0.0) != (beyond[next] > 0.0))
                kept.add(points_[i] + (points_[next] - points_[i]) * (beyond[i] / (beyond[i] - beyond[next])));
        }
        *this = kept;
    }

private:
    static constexpr int kCapacity = 16;

    void add(Vec2d point) { points_[static_cast<std::size_t>(count_++)] = point; }

    std::array<Vec2d, kCapacity> points_;
    int count_ = 0;
};

/// Points origin + x * x_axis + y * y_axis + z * normal with (x, y) in the polygon and |z| <= thickness, in double.
/// The axes are orthonormal.
struct FlatRegion {
    Vec3d origin;
    Vec3d x_axis, y_axis, normal;
    Polygon polygon;
    double thickness = 0.0;
};

/// A ball that contains a region; its center is rounded as the positions of searches are.
struct Ball {
    Vec3f center;
    double radius;
};

/// Coordinates up to this magnitude give squared distances in the range of float.
inline constexpr float kMaxCoordinate = 1e18f;

/// Finds these sets. One object per thread, because it reuses its memory.
class NearestSets {
public:
    enum class Answer {
        None,     ///< no volume has an agreeing normal
        Few,      ///< the set is in nodes()
        TooMany,  ///< the set is longer than kMostListed
        GivenUp,  ///< the limit of set_effort() is reached before the first candidate
    };
    /// Longest set that is stored as a list.
    static constexpr std::size_t kMostListed = 24;

    explicit NearestSets(NormalTrees& trees) : trees_(trees) {}

    /// The set of all volumes that the search from some point of the region, with this normal, can return. The
    /// polygon must not be empty. Sets are exact up to a margin of a few roundoffs of the distances.
    Answer find(const FlatRegion& region, Vec3f normal);
    /// The node of the only volume of that set for any region in the ball, VolumePlace::kNone if no volume has an agreeing normal. Empty
    /// if there are several, or a search would have to tell.
    std::optional<std::uint32_t> find_only(const Ball& ball, Vec3f normal);

    /// Drops the neighborhoods of earlier searches, at the start of each chunk of work: the searches that reach the effort
    /// limit then do not depend on the distribution of chunks over threads.
    void restart();
    /// Most nodes that one search may visit.
    void set_effort(int nodes) { effort_ = nodes; }

    /// Nodes of the last set, as numbers of nodes of NormalTrees, by ascending volume.
    const std::vector<std::uint32_t>& nodes() const { return nodes_; }

private:
    /// A volume near the region, in the region's frame.
    struct Candidate {
        KdNode node;
        float distance2;  ///< from the center of the region
        double x, y, z;
        double length2;
    };
    /// The nodes of a tree near a center: regions there, with normals of the same cell, need no search.
    struct Neighborhood {
        Vec3f center{0.0f};
        double radius = -1.0;  ///< no other node of the tree is within it; negative before the first search
        std::vector<KdNode> nodes;
    };
    struct Effort;
    struct Gather;
    struct Surroundings;

    Answer gather(const FlatRegion& region, Vec3f normal);
    double reach_from(const Ball& ball) const;
    /// Whether the nodes known so far hold the nearest volume and all candidates.
    bool finds_nearest(const Neighborhood& known, const Ball& ball, Vec3f normal);
    bool covers(const Neighborhood& known, const Ball& ball) const;
    void explore(const KdTreeView& tree, Vec3f center, Neighborhood& known) const;
    Answer search(const KdTreeView& tree, const Ball& ball, Vec3f normal, Neighborhood& known);
    void set_margin(double farthest);
    bool can_be_nearest_in(const Ball& ball, const KdNode& node, const KdNode& other) const;
    void drop_duplicates();
    bool can_be_nearest(const Candidate& candidate, const FlatRegion& region) const;

    NormalTrees& trees_;
    std::array<Neighborhood, NormalTrees::kCells> known_;
    Nearest nearest_;  ///< to the center of the region
    int effort_ = 0;
    double margin_ = 0.0;  ///< differences of squared distances up to this may be due to rounding
    std::vector<Candidate> candidates_;
    std::vector<std::uint32_t> nodes_;
};

}  // namespace pl
