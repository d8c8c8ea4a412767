#include "core/fields/nearest_sets.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/base/numbers.h"

namespace pl {
namespace {

/// A gather of more candidates ends in TooMany: clipping by all pairs of bisectors takes too long.
constexpr std::size_t kMostGathered = 160;

/// Nodes that are kept around the last search: more of them cost every side more time than the searches that they save.
constexpr std::size_t kMostKnown = 16;

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

/// An upper bound of the rounded squares of all distances up to this one.
float squared_above(double distance) {
    return next_float_up(static_cast<float>(distance * distance * kWiden + kUnderflow));
}

Ball ball_around(const FlatRegion& region) {
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
    return {center, (radius + region.thickness + glm::length(Vec3d{center} - exact)) * kWiden};
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

/// Result of a search for the nearest nodes, whatever their normals: a heap, the farthest first.
struct NearestSets::Surroundings {
    struct Found {
        float distance2;
        std::uint32_t volume;
    };
    std::array<Found, kMostKnown> heap;
    std::size_t count = 0;

    void consider(const KdNode& node, Vec3f position, Vec3f) {
        const float d2 = squared_distance(position, node.position);
        if (!(d2 < limit())) return;
        const auto is_nearer = [](const Found& a, const Found& b) { return a.distance2 < b.distance2; };
        if (count == kMostKnown)
            std::pop_heap(heap.begin(), heap.end(), is_nearer);
        else
            ++count;
        heap[count - 1] = {d2, node.volume};
        std::push_heap(heap.begin(), heap.begin() + static_cast<std::ptrdiff_t>(count), is_nearer);
    }
    float limit() const { return count == kMostKnown ? heap.front().distance2 : kInfinity; }
};

void NearestSets::restart() {
    for (Neighborhood& known : known_) {
        known.radius = -1.0;
        known.nodes.clear();
    }
}

/// Distance from the ball's center within which all candidates lie, by the triangle inequality: with d the distance from the center to
/// its nearest volume and r the ball's radius, the nearest volume of any point of the region lies within d + r of it, and within
/// d + 2 r of the center.
double NearestSets::reach_from(const Ball& ball) const {
    return (distance_above(nearest_.distance2) + 2.0 * ball.radius) * kWiden;
}

/// For points up to `farthest` from the volumes.
void NearestSets::set_margin(double farthest) {
    margin_ = 2.0 * (kDistanceError + kDoubleError) * farthest * farthest + kUnderflow;
}

/// Whether all candidates are among the known nodes; `nearest_` is the nearest of these.
bool NearestSets::covers(const Neighborhood& known, const Ball& ball) const {
    if (nearest_.volume == kNoVolume) return false;
    return reach_from(ball) + glm::length(Vec3d{ball.center} - Vec3d{known.center}) * kWiden <= known.radius;
}

/// Finds what is around a center.
void NearestSets::explore(const KdTreeView& tree, Vec3f center, Neighborhood& known) const {
    Surroundings around;
    search_kd_tree(tree, center, Vec3f{0.0f}, around);
    known.center = center;
    known.radius = std::sqrt(static_cast<double>(around.limit())) / kWiden;
    known.nodes.clear();
    for (std::size_t i = 0; i < around.count; ++i) known.nodes.push_back(trees_.node_at(around.heap[i].volume));
}

/// Finds the nearest volume where the known nodes do not show it.
NearestSets::Answer NearestSets::search(const KdTreeView& tree, const Ball& ball, Vec3f normal, Neighborhood& known) {
    const auto agrees = [&](const KdNode& node) { return normals_agree(normal, node.normal); };
    // Where none agrees a search visits every node; this loop does so in less time.
    if (nearest_.volume == kNoVolume && tree.nodes.count <= static_cast<std::uint32_t>(effort_) &&
        std::none_of(tree.nodes.begin(), tree.nodes.end(), agrees))
        return Answer::None;
    explore(tree, ball.center, known);
    if (finds_nearest(known, ball, normal)) return Answer::Few;
    Effort nearest{nearest_, effort_};
    search_kd_tree(tree, ball.center, normal, nearest);
    if (nearest.left <= 0) return Answer::GivenUp;
    return nearest_.volume == kNoVolume ? Answer::None : Answer::Few;
}

bool NearestSets::finds_nearest(const Neighborhood& known, const Ball& ball, Vec3f normal) {
    nearest_ = {};
    for (const KdNode& node : known.nodes) nearest_.consider(node, ball.center, normal);
    return covers(known, ball);
}

std::optional<std::uint32_t> NearestSets::find_only(const Ball& ball, Vec3f normal) {
    const std::size_t cell = NormalTrees::cell_of(normal);
    if (trees_.tree_of(cell).nodes.empty()) return VolumePlace::kNone;
    const Neighborhood& known = known_[cell];
    if (!finds_nearest(known, ball, normal)) return {};
    const KdNode& only = trees_.node_at(static_cast<std::uint32_t>(nearest_.volume));
    const double reach = reach_from(ball);
    const float limit2 = squared_above(reach);
    set_margin(reach + ball.radius);
    for (const KdNode& node : known.nodes)
        if (node.volume != only.volume && squared_distance(ball.center, node.position) <= limit2 &&
            normals_agree(normal, node.normal) && can_be_nearest_in(ball, node, only))
            return {};
    return trees_.node_of(only.volume);
}

/// Whether `node` may be as near as `other` to some point of the ball: the difference of squared distances is linear in the point.
bool NearestSets::can_be_nearest_in(const Ball& ball, const KdNode& node, const KdNode& other) const {
    const Vec3d center{ball.center};
    const Vec3d to_node = Vec3d{node.position} - center;
    const Vec3d to_other = Vec3d{other.position} - center;
    return glm::dot(to_node, to_node) - glm::dot(to_other, to_other) <=
           2.0 * ball.radius * glm::length(to_node - to_other) + margin_;
}

NearestSets::Answer NearestSets::gather(const FlatRegion& region, Vec3f normal) {
    candidates_.clear();
    const Ball ball = ball_around(region);
    const std::size_t cell = NormalTrees::cell_of(normal);
    const KdTreeView tree = trees_.tree_of(cell);
    Neighborhood& known = known_[cell];
    if (!finds_nearest(known, ball, normal))
        if (const Answer answer = search(tree, ball, normal, known); answer != Answer::Few) return answer;
    const double reach = reach_from(ball);
    Gather result{region, squared_above(reach), candidates_, effort_};
    if (covers(known, ball))
        for (const KdNode& node : known.nodes) result.consider(node, ball.center, normal);
    else
        search_kd_tree(tree, ball.center, normal, result);
    set_margin(reach + ball.radius);
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
    for (const Candidate& candidate : candidates_)
        if (can_be_nearest(candidate, region)) nodes_.push_back(candidate.node.volume);
    if (nodes_.size() > kMostListed) return Answer::TooMany;
    std::sort(nodes_.begin(), nodes_.end());
    for (std::uint32_t& node : nodes_) node = trees_.node_of(node);
    return Answer::Few;
}

}  // namespace pl
