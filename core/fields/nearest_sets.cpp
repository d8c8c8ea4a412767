#include "core/fields/nearest_sets.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/base/numbers.h"

namespace pl {
namespace {

/// A gather of more candidates ends in TooMany: clipping by all pairs of bisectors takes too long.
constexpr std::size_t kMostGathered = 160;

/// Relative error of squared_distance() in roundoffs: difference 1, doubled by the square, product 1, two sums 2;
/// with a margin.
constexpr double kDistanceError = gamma_bound(8);

/// Relative error of the double arithmetic here, with a margin.
constexpr double kDoubleError = 1e-13;

/// Absolute error by underflow of squares: three times half of the smallest positive float, with a margin.
constexpr double kUnderflow = 1e-40;

/// Factor that covers kDistanceError and roundings to float in comparisons of distances, with a margin.
constexpr double kWiden = 1.0 + 1e-6;

/// An upper bound of the exact distance.
double distance_above(float distance2) {
    return std::sqrt(static_cast<double>(distance2) * kWiden + kUnderflow) * kWiden;
}

}  // namespace

/// Result of a nearest search that stops after `left` nodes.
struct NearestSets::Effort {
    Nearest& nearest;
    int left;

    void consider(const KdNode& node, Vec3f position, Vec3f normal) {
        --left;
        nearest.consider(node, position, normal);
    }
    float limit() const { return left > 0 ? nearest.limit() : -1.0f; }
};

/// Result of a search for all candidates within a distance.
struct NearestSets::Gather {
    const FlatRegion& region;
    float limit2;
    std::vector<Candidate>& found;
    int left;

    void consider(const KdNode& node, Vec3f position, Vec3f normal) {
        if (--left <= 0) limit2 = -1.0f;
        const float d2 = squared_distance(position, node.position);
        if (!(d2 <= limit2) || !normals_agree(normal, node.normal)) return;
        const Vec3d v = Vec3d{node.position} - region.origin;
        const double x = glm::dot(v, region.x_axis);
        const double y = glm::dot(v, region.y_axis);
        const double z = glm::dot(v, region.normal);
        found.push_back({node, d2, x, y, z, x * x + y * y + z * z});
        if (found.size() > kMostGathered) limit2 = -1.0f;  // ends the search
    }
    float limit() const { return limit2; }
};

/// Radius of the gather, by the triangle inequality: with d the distance from the region's center to its nearest
/// volume and r the region's radius, the nearest volume of any point of the region lies within d + r of it, and
/// within d + 2 r of the center.
NearestSets::Answer NearestSets::gather(const FlatRegion& region, Vec3f normal) {
    candidates_.clear();
    tree_ = trees_.tree_for(normal);
    Vec2d middle{0.0};
    int corners = 0;
    for (const Vec2d p : region.polygon) {
        middle += p;
        ++corners;
    }
    middle /= corners;
    const Vec3d exact = region.origin + middle.x * region.x_axis + middle.y * region.y_axis;
    const Vec3f center{exact};
    double radius = 0.0;
    for (const Vec2d p : region.polygon) radius = std::max(radius, glm::length(p - middle));
    radius = (radius + region.thickness + glm::length(Vec3d{center} - exact)) * kWiden;

    nearest_ = {};
    if (hint_) nearest_.consider(*hint_, center, normal);
    Effort search{nearest_, effort_};
    search_kd_tree(tree_, center, normal, search);
    if (search.left <= 0) return Answer::GivenUp;
    if (nearest_.volume == kNoVolume) return Answer::None;
    const double reach = (distance_above(nearest_.distance2) + 2.0 * radius) * kWiden;
    const auto limit2 = static_cast<float>(reach * reach * kWiden + kUnderflow);
    Gather result{region, next_float_up(limit2), candidates_, effort_};
    search_kd_tree(tree_, center, normal, result);
    const double farthest = reach + radius;
    margin_ = 2.0 * (kDistanceError + kDoubleError) * farthest * farthest + kUnderflow;
    return result.left > 0 && candidates_.size() <= kMostGathered ? Answer::Few : Answer::TooMany;
}

/// Sorts candidates, nearest to the center first. Of several at the same position keeps the one of the lowest number,
/// the result of all searches.
void NearestSets::drop_duplicates() {
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
        return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.node.volume < b.node.volume;
    });
    std::size_t kept = 0;
    for (const Candidate& candidate : candidates_) {
        bool duplicate = false;
        for (std::size_t i = kept; i-- > 0 && candidates_[i].distance2 == candidate.distance2;)
            duplicate = duplicate || candidates_[i].node.position == candidate.node.position;
        if (!duplicate) candidates_[kept++] = candidate;
    }
    candidates_.resize(kept);
}

/// Clips the region by the bisectors with all other candidates, moved outwards by the margin for rounding; the
/// candidate can be nearest if anything is left. A difference of squared distances is linear in the point, so the
/// rest is a polygon; the thickness of the region moves each bisector a little.
bool NearestSets::can_be_nearest(const Candidate& candidate, const FlatRegion& region) const {
    Polygon left = region.polygon;
    for (const Candidate& other : candidates_) {
        if (other.node.volume == candidate.node.volume) continue;
        const Vec2d difference{candidate.x - other.x, candidate.y - other.y};
        const double off_plane = 2.0 * region.thickness * std::fabs(candidate.z - other.z);
        left.clip(-2.0 * difference, margin_ + off_plane - (candidate.length2 - other.length2));
        if (left.empty()) return false;
    }
    return true;
}

NearestSets::Answer NearestSets::find(const FlatRegion& region, Vec3f normal) {
    nodes_.clear();
    if (const Answer answer = gather(region, normal); answer != Answer::Few) return answer;
    drop_duplicates();
    hint_ = candidates_.front().node;
    for (const Candidate& candidate : candidates_)
        if (can_be_nearest(candidate, region)) nodes_.push_back(candidate.node.volume);
    if (nodes_.size() > kMostListed) return Answer::TooMany;
    std::sort(nodes_.begin(), nodes_.end());
    for (std::uint32_t& node : nodes_) node = trees_.node_of(node);
    return Answer::Few;
}

}  // namespace pl
